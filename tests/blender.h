// Tests in Blender without its window, which are skipped where it is not installed.
#pragma once
#include "bake/picture/image.h"
#include "cli/command.h"
#include <cstring>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace bake::test {

/// They are skipped under sanitizers too, which see nothing of Blender.
inline bool no_blender() {
#ifdef __SANITIZE_ADDRESS__
    return true;
#endif
    return !fs::exists("/usr/bin/blender");
}

/// Runs scripts/blender_viewer, which describes the job: the pictures of its outputs.
inline std::vector<Image<float>> blender(const Folder& folder, const nlohmann::json& job) {
    write_file(folder / "blender.json", job.dump());
    const std::string log = folder / "blender.log";
    const int status = std::system(("'" + (source_folder() / "scripts/blender_viewer").string() + "' '" +
                                    (folder / "blender.json") + "' >'" + log + "' 2>&1")
                                       .c_str());
    REQUIRE_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), contents(log));
    std::vector<Image<float>> images;
    for (const nlohmann::json& output : job["outputs"]) {
        const std::string bytes = contents(folder / output["file"].get<std::string>());
        images.emplace_back(job["size"][0].get<int>(), job["size"][1].get<int>(), 4);
        REQUIRE(bytes.size() == images.back().size() * sizeof(float));
        std::memcpy(images.back().data(), bytes.data(), bytes.size());
    }
    return images;
}

} // namespace bake::test
