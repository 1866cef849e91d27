// bc5_bench [SIZE]
//
// Time and error of a normal map in BC5, at SIZE^2 (1024 unless given): its largest level, and its whole chain with the box
// filter that makes it. The map has 5 x 4 smooth waves of slope .3. Errors are angles between its float normals and those that
// are decoded without rounding, over the largest level. The limit is a pass that reads 8 bytes per texel and writes 1. If
// nvcompress is installed (libnvtt-bin), it is timed in turn on the same map as an 8-bit PNG, from file to file, and its file is
// decoded in the same way.
#include "bake/base/vec.h"
#include "bake/picture/bc5.h"
#include "bake/picture/image_io.h"
#include "bake/relief/map/normal_mips.h"
#include "bake/relief/map/stored_error.h"
#include "bench.h"
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

using namespace bake;

namespace {

/// Unit normals as colours.
Image<float> wave_map(int size) {
    constexpr double slope = 0.3, along_u = 5, along_v = 4;
    Image<float> map(size, size, 3);
    for_rows(size, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < size; ++x) {
                const double u = 2 * pi * along_u * (x + 0.5) / size, v = 2 * pi * along_v * (1 - (y + 0.5) / size);
                const Vec3d n = glm::normalize(Vec3d(-slope * std::cos(u) * std::sin(v),
                                                     -slope * along_v / along_u * std::sin(u) * std::cos(v), 1));
                for (int c = 0; c < 3; ++c) map.at(x, y, c) = float(0.5 * n[c] + 0.5);
            }
    });
    return map;
}

/// Errors of blocks, and their root mean square.
bench::Errors block_errors(const char* blocks, const Image<float>& map, double& rms) {
    Image<float> decoded(map.width(), map.height(), 3), normals(map.width(), map.height(), 3);
    bc5_decode(blocks, decoded);
    for (std::size_t i = 0; i < map.size(); ++i) {
        decoded.data()[i] = 0.5f * decoded.data()[i] + 0.5f;
        normals.data()[i] = 2 * map.data()[i] - 1;
    }
    const StoredError error = stored_error(decoded, normals);
    rms = error.rms_deg;
    return {error.mean_deg, error.p95_deg, error.max_deg, map.size() / 3};
}

std::string by_nvcompress(const std::string& folder) {
    const std::string command =
        "nvcompress -bc5 -nomips -normal -nocuda '" + folder + "/n.png' '" + folder + "/n.dds' >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) return {};
    std::ifstream in(folder + "/n.dds", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const std::size_t header = bytes.compare(84, 4, "DX10") == 0 ? 148 : 128;
    return bytes.substr(std::min(bytes.size(), header));
}

/// What the limit reads and writes.
void read_8_write_1(const Image<float>& map, std::string& to) {
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        const auto texels = std::size_t(map.width());
        for (std::size_t i = std::size_t(begin) * texels; i < std::size_t(end) * texels; ++i)
            to[i] = char(int(map.data()[3 * i] + map.data()[3 * i + 1]));
    });
}

} // namespace

int main(int argc, char** argv) {
    const int size = argc > 1 ? std::atoi(argv[1]) : 1024;
    const double texels = double(size) * size;
    const Image<float> map = wave_map(size);
    const std::vector<NormalLevel> mips = normal_mips(map);
    double rms[3] = {};
    const auto errors = [&](double& to) {
        return [&](const std::string& blocks) { return block_errors(blocks.data(), map, to); };
    };
    std::vector<bench::Work> works = {{[&] { return bc5_encode(mips[0].normal); }, errors(rms[0])},
                                      {[&] {
                                           std::string first;
                                           for (const NormalLevel& level : normal_mips(map)) {
                                               const std::string blocks = bc5_encode(level.normal);
                                               if (first.empty()) first = blocks;
                                           }
                                           return first;
                                       },
                                       errors(rms[1])}};
    const std::string folder = std::filesystem::temp_directory_path() / ("bc5_bench." + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    write_image(folder + "/n.png", map, {.depth = Depth::u8});
    const bool peer = by_nvcompress(folder).size() == bc5_bytes(size, size);
    if (peer) works.push_back({[&] { return by_nvcompress(folder); }, errors(rms[2])});
    std::string room(std::size_t(texels), '\0');
    const auto turns = bench::in_turn(5, {[&] { read_8_write_1(map, room); }}, works);
    std::filesystem::remove_all(folder);
    const char* names[] = {"level", "chain", "nvcompress"};
    for (std::size_t i = 0; i < works.size(); ++i) {
        const bench::Measured& work = turns.works[i];
        const bool against_peer = peer && i < 2;
        bench::print_row(work, {"bc5", names[i], size, texels,
                                against_peer ? work.ratio_to(turns.works[2]) : work.ratio_to(turns.limits[0]),
                                against_peer ? "nvcompress from PNG to DDS without mips" : "read+write pass",
                                bench::text("rms %.4f deg; %.0f ms in all", rms[i], 1e3 * work.median())});
    }
}
