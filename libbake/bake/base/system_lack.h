// What the system did not have for a call or for a library.
#pragma once
#include <exception>
#include <string>

namespace bake {

/// How to mend a call that failed with `reason` (an errno) because a limit was reached: "raise ulimit -n". Empty for all other
/// reasons.
std::string mend_of_lack(int reason);

/// Whether a library says by this exception that a thread could not be started.
bool lacks_threads(const std::exception& error) noexcept;

/// Whether it says that there was no memory: std::bad_alloc, or an exception that passes on its text.
bool lacks_memory(const std::exception& error) noexcept;

} // namespace bake
