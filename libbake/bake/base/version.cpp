#include "bake/base/version.h"

namespace bake {
const char* version() noexcept { return BAKE_VERSION; }
} // namespace bake
