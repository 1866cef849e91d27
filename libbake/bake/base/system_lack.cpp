#include "bake/base/system_lack.h"
#include <cerrno>
#include <new>
#include <string_view>
#include <system_error>

namespace bake {

std::string mend_of_lack(int reason) {
    switch (reason) {
    case EMFILE: return "raise ulimit -n";
    case ENFILE: return "end other programs, or raise fs.file-max";
    case EAGAIN: return "raise ulimit -u, or end other programs";
    case ENOMEM: return "end other programs, or allow more memory";
    default: return {};
    }
}

bool lacks_threads(const std::exception& error) noexcept {
    // oneTBB has no type for it: "pthread_create has failed: Resource temporarily unavailable".
    if (std::string_view(error.what()).starts_with("pthread_create")) return true;
    const auto* const system = dynamic_cast<const std::system_error*>(&error);
    return system && system->code() == std::errc::resource_unavailable_try_again;
}

bool lacks_memory(const std::exception& error) noexcept {
    return dynamic_cast<const std::bad_alloc*>(&error) ||
           std::string_view(error.what()).find("bad_alloc") != std::string_view::npos;
}

} // namespace bake
