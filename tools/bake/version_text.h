// What --version prints.
#pragma once
#include <string>

namespace bake {

/// Version and commit, the licence of this binary, and the libraries that it was built with.
std::string version_text();

/// The commit that the sources are of, "-modified" behind it if they were changed since, or "unknown".
extern const char* const source_commit;

} // namespace bake
