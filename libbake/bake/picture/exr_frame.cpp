#include "bake/picture/exr_frame.h"
#include "bake/base/parallel.h"
#include "bake/base/system_lack.h"
#include <OpenEXR/ImfThreading.h>
#include <mutex>

namespace bake {

int exr_helpers() {
    static std::mutex once_at_a_time;
    const std::lock_guard lock(once_at_a_time);
    const int wanted = thread_count() > 1 ? thread_count() : 0;
    // Never fewer: another command of the process may have work for them, and OpenEXR would not do it.
    if (Imf::globalThreadCount() >= wanted) return wanted;
    try {
        // A pool that fails while it is made leaves behind the threads that it has started; one with a thread keeps them.
        if (wanted > 1 && Imf::globalThreadCount() == 0) Imf::setGlobalThreadCount(1);
        Imf::setGlobalThreadCount(wanted);
        return wanted;
    } catch (const std::exception& error) {
        if (!lacks_threads(error)) throw;
    }
    Imf::setGlobalThreadCount(0); // ends those that were started
    return 0;
}

} // namespace bake
