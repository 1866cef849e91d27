// The Khronos validator, as scripts/gltf_validator runs it.
#pragma once
#include "cli/command.h"
#include <cstdlib>
#include <sys/wait.h>

namespace bake::test {

/// Whether tests of the Khronos validator are skipped: it is not installed, and $BAKE_NEEDS_VALIDATOR does not ask for it.
inline bool no_validator() {
    return !std::getenv("BAKE_NEEDS_VALIDATOR") &&
           !fs::exists(source_folder() / "build/gltf_validator/node_modules/gltf-validator");
}

/// What the Khronos validator finds wrong with all .glb and .gltf of the folder: "" for nothing.
inline std::string validator_says(const fs::path& folder) {
    const std::string out = (folder / "validator.txt").string();
    const std::string command = "cd '" + folder.string() + "' && '" +
                                (source_folder() / "scripts/gltf_validator").string() +
                                "' $(ls | grep -E '[.](glb|gltf)$') > '" + out + "' 2>&1";
    const int status = std::system(command.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 255;
    const std::string text = contents(out);
    return code == 0 ? text : "code " + std::to_string(code) + ": " + text;
}

} // namespace bake::test
