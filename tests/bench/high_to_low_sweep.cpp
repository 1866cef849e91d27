// high_to_low_sweep: the meshes of the reference job of high-poly to low-poly, and how wrong a map of it is.
//
//   high_to_low_sweep --write FOLDER [--asset relief|aliasing] [--triangles 1M|4M]    low.obj, high.ply, high.obj
//   high_to_low_sweep --judge MAP... [--asset relief|aliasing]
//
// A row per map and truth: file, truth, texels, then mean, 95th percentile and largest angle in degrees, then the share of texels
// that are wrong by more than one degree, in percent. The truths are those of relief/transfer/relief_torus.h: one_ray and
// box. A map holds (n + 1) / 2, and angles are those of the normals that a shader decodes at the centres of the texels. Of
// several maps, all of the same size, the truths are computed once.
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "relief/transfer/relief_torus.h"
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace bake;
using oracle::TorusRelief;

namespace {

struct Arguments {
    std::string write;
    std::vector<std::string> judge;
    TorusRelief relief;
    int columns = 1000;
};

constexpr const char* usage = "high_to_low_sweep --write FOLDER | --judge MAP...  [--asset relief|aliasing] "
                              "[--triangles 1M|4M]\n";

/// False for a command line that is not in the usage.
bool parse(int argc, char** argv, Arguments& args) {
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
        if (name == "--judge") {
            while (i + 1 < argc && std::strncmp(argv[i + 1], "--", 2) != 0) args.judge.emplace_back(argv[++i]);
            continue;
        }
        if (name == "--write") args.write = value;
        else if (name == "--asset" && value == "relief") args.relief = {};
        else if (name == "--asset" && value == "aliasing") args.relief = {.A = 0.002, .k = 96, .m = 48};
        else if (name == "--triangles" && value == "1M") args.columns = 1000;
        else if (name == "--triangles" && value == "4M") args.columns = 2000;
        else return false;
        ++i;
    }
    return args.write.empty() != args.judge.empty();
}

/// Blender takes faces of an OBJ file that has no smoothing groups as flat, and then uses no normal of LOW's corners.
void make_smooth(const std::string& obj) {
    std::stringstream faces;
    faces << std::ifstream(obj, std::ios::binary).rdbuf();
    std::ofstream(obj, std::ios::binary) << "s 1\n" << faces.rdbuf();
}

void write_meshes(const Arguments& args) {
    const std::filesystem::path folder = args.write;
    std::filesystem::create_directories(folder);
    write_mesh((folder / "low.obj").string(), oracle::LowTorus().mesh());
    const Mesh high = oracle::relief_mesh(args.relief, args.columns, args.columns / 2);
    for (const char* name : {"high.ply", "high.obj"}) write_mesh((folder / name).string(), high);
    for (const char* name : {"low.obj", "high.obj"}) make_smooth((folder / name).string());
}

Image<float> read_map(const std::string& file) {
    Image<float> map = read_image(file);
    if (map.channels() < 3) throw Error(Refusal::unsuitable, file + ": a normal map has three channels");
    return map;
}

/// Angles of all texels of a map against both truths.
struct Angles {
    std::vector<double> one_ray, box;
};

std::vector<Angles> angles_of(const std::vector<Image<float>>& maps, const TorusRelief& relief) {
    const int width = maps[0].width(), height = maps[0].height();
    const oracle::LowTorus low;
    // So many nodes give the mean to a thousandth of a degree, also where a triangle of LOW ends inside the texel.
    const oracle::GaussRule rule(width >= 20 * relief.k && height >= 20 * relief.m ? 4 : 8);
    std::vector<Angles> angles(maps.size());
    const std::size_t texels = std::size_t(width) * height;
    for (Angles& a : angles) a.one_ray.resize(texels), a.box.resize(texels);
    for_rows(height, 1, [&](std::int64_t row, std::int64_t) {
        for (int x = 0; x < width; ++x) {
            const double u = (x + 0.5) / width, v = 1 - (double(row) + 0.5) / height;
            const oracle::LowPoint at = low.at(u, v);
            const Vec3d one_ray = at.to_object(oracle::one_ray_normal(low, relief, u, v));
            const Vec3d box = at.to_object(oracle::box_normal(low, relief, rule, u, v, 1.0 / width, 1.0 / height));
            for (std::size_t m = 0; m < maps.size(); ++m) {
                const float* rgb = maps[m].row(int(row)) + std::size_t(x) * maps[m].channels();
                const Vec3d n = at.to_object(2.0 * Vec3d(rgb[0], rgb[1], rgb[2]) - 1.0);
                angles[m].one_ray[std::size_t(row) * width + x] = oracle::angle_deg(n, one_ray);
                angles[m].box[std::size_t(row) * width + x] = oracle::angle_deg(n, box);
            }
        }
    });
    return angles;
}

void print_row(const std::string& file, const char* truth, const std::vector<double>& angles) {
    const auto wrong = std::count_if(angles.begin(), angles.end(), [](double a) { return !(a <= 1); });
    const oracle::Spread s = oracle::spread(angles);
    std::printf("%s %s %zu %.5f %.5f %.5f %.4f\n", file.c_str(), truth, angles.size(), s.mean, s.p95, s.max,
                100.0 * double(wrong) / double(angles.size()));
}

void judge(const Arguments& args) {
    std::vector<Image<float>> maps;
    for (const std::string& file : args.judge) maps.push_back(read_map(file));
    for (const Image<float>& map : maps)
        if (map.width() != maps[0].width() || map.height() != maps[0].height())
            throw Error(Refusal::unsuitable, "maps of different sizes");
    const std::vector<Angles> angles = angles_of(maps, args.relief);
    for (std::size_t m = 0; m < maps.size(); ++m) {
        print_row(args.judge[m], "one_ray", angles[m].one_ray);
        print_row(args.judge[m], "box", angles[m].box);
    }
}

} // namespace

int main(int argc, char** argv) try {
    Arguments args;
    if (!parse(argc, argv, args)) {
        std::fputs(usage, stderr);
        return 2;
    }
    if (args.write.empty()) judge(args);
    else write_meshes(args);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "high_to_low_sweep: %s\n", e.what());
    return 1;
}
