// Tests in a headless Chromium, which scripts/three_viewer --install installs with what drives it.
#pragma once
#include "folders.h"

namespace bake::test {

/// Whether the tests are skipped: the browser is not installed, and $BAKE_NEEDS_THREE does not ask for them. They are skipped
/// under sanitizers too, where pictures would take minutes.
inline bool no_browser() {
#ifdef __SANITIZE_ADDRESS__
    return true;
#endif
    const std::filesystem::path packages = source_folder() / "build/three_viewer/node_modules";
    return !std::getenv("BAKE_NEEDS_THREE") &&
           !(std::filesystem::exists("/usr/bin/chromium") && std::filesystem::exists(packages / "three") &&
             std::filesystem::exists(packages / "playwright-core"));
}

} // namespace bake::test
