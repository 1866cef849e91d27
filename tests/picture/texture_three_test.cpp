// What we write as KTX2, read by three.js in a headless Chromium.
#include "bake/base/vec.h"
#include "bake/picture/bc5.h"
#include "bake/picture/texture_file.h"
#include "browser.h"
#include "cli/command.h"
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

using namespace bake;
using namespace bake::test;

namespace {

Image<float> waves(int size) {
    Image<float> normals(size, size, 3);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = 2 * pi * (x + 0.5) / size, v = 2 * pi * (y + 0.5) / size;
            const Vec3d n = glm::normalize(Vec3d(0.3 * std::sin(u + 2 * v), 0.2 * std::cos(3 * v), 1));
            for (int c = 0; c < 3; ++c) normals.at(x, y, c) = float(n[c]);
        }
    return normals;
}

/// A level of a texture as three.js shows it.
Image<float> by_three(const Folder& folder, const std::string& texture, int level, int size) {
    const nlohmann::json output = {{"what", "texture"}, {"texture", texture}, {"level", level}, {"file", "t.f32"}};
    write_file(folder / "job.json", nlohmann::json{{"size", {size, size}}, {"outputs", {output}}}.dump());
    const std::string log = folder / "three.log";
    const int status = std::system(("'" + (source_folder() / "scripts/three_viewer").string() + "' '" +
                                    (folder / "job.json") + "' >'" + log + "' 2>&1")
                                       .c_str());
    REQUIRE_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), contents(log));
    CHECK(contents(log) == ""); // three.js and the browser complain of nothing
    const std::string bytes = contents(folder / "t.f32");
    Image<float> image(size, size, 4);
    REQUIRE(bytes.size() == image.size() * sizeof(float));
    std::memcpy(image.data(), bytes.data(), bytes.size());
    return image;
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("write_texture: three.js reads all levels of a KTX2, the right way up" * doctest::skip(no_browser())) {
        const Folder folder;
        std::vector<TextureLevel> blocks, bytes;
        for (int size = 64; size > 0; size /= 2) {
            Image<float> normals = waves(size);
            blocks.push_back(pack_level(normals, TexelFormat::bc5));
            for (std::size_t i = 0; i < normals.size(); ++i) normals.data()[i] = 0.5f * normals.data()[i] + 0.5f;
            bytes.push_back(pack_level(normals, TexelFormat::rgba8));
        }
        for (const TexelFormat format : {TexelFormat::bc5, TexelFormat::rgba8}) {
            BlockWriter out(folder / "n.ktx2");
            write_texture(out, TextureContainer::ktx2, format, format == TexelFormat::bc5 ? blocks : bytes);
            out.commit();
            for (const int level : {0, 2, 5}) {
                CAPTURE(level);
                const int size = 64 >> level;
                const Image<float> theirs = by_three(folder, "n.ktx2", level, size);
                const Image<float> truth = waves(size);
                Image<float> ours(size, size, 2);
                bc5_decode(blocks[std::size_t(level)].bytes.data(), ours);
                double most = 0;
                for (int y = 0; y < size; ++y)
                    for (int x = 0; x < size; ++x)
                        for (int c = 0; c < 2; ++c) {
                            const float n = format == TexelFormat::bc5 ? ours.at(x, y, c) : truth.at(x, y, c);
                            most = std::max(most, std::abs(255 * double(theirs.at(x, y, c) - (0.5f * n + 0.5f))));
                        }
                // Chromium's software renderer rounds what it interpolates to 8 bits; graphics cards do not.
                CHECK(most < (format == TexelFormat::bc5 ? 1.01 : 0.51));
            }
        }
    }
}
