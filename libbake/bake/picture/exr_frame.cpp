#include "bake/picture/exr_frame.h"
#include "bake/base/parallel.h"
#include <OpenEXR/ImfThreading.h>
#include <mutex>

namespace bake {

int exr_helpers() {
    static std::mutex once_at_a_time;
    const std::lock_guard lock(once_at_a_time);
    const int wanted = thread_count() > 1 ? thread_count() : 0;
    if (Imf::globalThreadCount() != wanted) Imf::setGlobalThreadCount(wanted);
    return wanted;
}

} // namespace bake
