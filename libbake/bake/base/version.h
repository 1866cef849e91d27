// The version of this library and command.
#pragma once

namespace bake {
/// "major.minor.patch"
const char* version() noexcept;
} // namespace bake
