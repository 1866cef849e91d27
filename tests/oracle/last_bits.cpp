// What differs in the last bits between two processors.
//
//   last_bits OUT           computes results of most rooms and writes them to a file
//   last_bits FILE OTHER    compares two such files: values that differ, and by how many floats at the most
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/prefilter.h"
#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/test_sky.h"
#include "bake/light/lobe.h"
#include "bake/preview/render.h"
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_io.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/normal_map.h"
#include <bit>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>

using namespace bake;

namespace {

using Values = std::vector<float>;
struct Result {
    std::string name;
    Values values;
};

void append(Values& to, const Image<float>& image) { to.insert(to.end(), image.data(), image.data() + image.size()); }
Values values_of(const Image<float>& image) {
    Values out;
    append(out, image);
    return out;
}
Values values_of(const Cube& cube) {
    Values out;
    for (const Image<float>& face : cube.faces) append(out, face);
    return out;
}
Values values_of(const std::vector<Vec3f>& vectors) {
    Values out;
    for (const Vec3f& v : vectors) out.insert(out.end(), {v.x, v.y, v.z});
    return out;
}

/// A function of the library of C, of single precision, over a range.
template <class F> Values over(double from, double to, const F& f) {
    Values out;
    for (int i = 0; i < 20000; ++i) out.push_back(f(float(from + (to - from) * i / 19999)));
    return out;
}
/// Likewise of double precision: the last 23 bits of each result, as a whole number.
template <class F> Values over_double(double from, double to, const F& f) {
    Values out;
    for (int i = 0; i < 20000; ++i) {
        const auto bits = std::bit_cast<std::uint64_t>(double(f(from + (to - from) * i / 19999)));
        out.push_back(float(bits & 0x7fffff));
    }
    return out;
}

void add_functions(std::vector<Result>& out) {
    out.push_back({"sin, float", over(-30, 30, [](float x) { return std::sin(x); })});
    out.push_back({"cos, float", over(-30, 30, [](float x) { return std::cos(x); })});
    out.push_back({"exp, float", over(-20, 20, [](float x) { return std::exp(x); })});
    out.push_back({"log, float", over(1e-3, 1e3, [](float x) { return std::log(x); })});
    out.push_back({"pow, float", over(0, 4, [](float x) { return std::pow(x, 2.2f); })});
    out.push_back({"atan2, float", over(-4, 4, [](float x) { return std::atan2(x, 0.7f); })});
    out.push_back({"tan, float", over(-1.5, 1.5, [](float x) { return std::tan(x); })});
    out.push_back({"acos, float", over(-1, 1, [](float x) { return std::acos(x); })});
    out.push_back({"expm1, float", over(-3, 3, [](float x) { return std::expm1(x); })});
    out.push_back({"log1p, float", over(0, 9, [](float x) { return std::log1p(x); })});
    out.push_back({"sin, double", over_double(-30, 30, [](double x) { return std::sin(x); })});
    out.push_back({"exp, double", over_double(-20, 20, [](double x) { return std::exp(x); })});
    out.push_back({"log, double", over_double(1e-3, 1e3, [](double x) { return std::log(x); })});
    out.push_back({"pow, double", over_double(0, 4, [](double x) { return std::pow(x, 2.2); })});
    out.push_back({"atan2, double", over_double(-4, 4, [](double x) { return std::atan2(x, 0.7); })});
    out.push_back({"tan, double", over_double(-1.5, 1.5, [](double x) { return std::tan(x); })});
    out.push_back({"acos, double", over_double(-1, 1, [](double x) { return std::acos(x); })});
    out.push_back({"exp2, double", over_double(-9, 9, [](double x) { return std::exp2(x); })});
    out.push_back({"cbrt, double", over_double(0, 9, [](double x) { return std::cbrt(x); })});
    out.push_back({"hypot, double", over_double(0, 9, [](double x) { return std::hypot(x, 1.3); })});
    out.push_back({"log1p, double", over_double(0, 9, [](double x) { return std::log1p(x); })});
}

HeightTexture noise(int size) {
    std::mt19937 random(7);
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    for (std::size_t i = 0; i < height.values.size(); ++i)
        height.values.data()[i] = float(random() >> 8) / float(1 << 24);
    height.info.type = SampleType::float32;
    return height;
}

void add_maps(std::vector<Result>& out) {
    HeightTexture height = noise(128);
    out.push_back({"bump table", values_of(bump_table(height, {}))});
    NormalMapOptions options;
    options.height_options.amplitude = 0.05;
    out.push_back(
        {"normal map of a rectangle",
         values_of(normal_map(HeightField(height, options.height_options, Filter::c2, 128, 128), Vec2d(1), options))});
    Relief relief;
    relief.values = std::move(height.values);
    relief.height.amplitude = 0.05;
    DisplaceOptions displacement;
    displacement.rates.levels = 2;
    const Displaced shape = displace(BaseSurface(ParametricSurface("torus:R=1,r=0.4"), 16, 8), relief, displacement);
    out.push_back({"displaced torus, positions", values_of(shape.mesh.positions)});
    out.push_back({"displaced torus, normals", values_of(shape.mesh.normals)});
}

void add_skies(std::vector<Result>& out) {
    const Cube sky = label_sky(64);
    out.push_back({"label sky", values_of(sky)});
    Environment environment;
    environment.cube = label_sky(64);
    Environment picture;
    picture.picture = to_picture(environment, Projection::latlong, 128, 64);
    out.push_back({"cube to lat-long", values_of(picture.picture)});
    out.push_back({"lat-long to cube", values_of(to_cube(picture, FaceGrid{32, false}))});
    out.push_back({"irradiance", values_of(irradiance(sky, {.size = 8}))});
    out.push_back({"irradiance by harmonics", values_of(irradiance(sky, {.method = IrradianceMethod::sh, .size = 8}))});
    out.push_back({"prefiltered, ggx 0.3", values_of(prefilter(sky, {.roughness = {0.3}, .size = 16})[0])});
}

void add_light(std::vector<Result>& out, const std::string& scene) {
    const Bsdf bsdf = metallic_roughness(Vec3f(0.8f, 0.5f, 0.2f), 0.3f, 0.4f);
    Values lobe;
    for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 50; ++j) {
            const float a = 0.0077f * float(i), b = 0.0301f * float(j);
            const BsdfValue value =
                evaluate(bsdf, Vec3f(0, 0, 1), Vec3f(std::sin(a), 0, std::cos(a)), Vec3f(0, std::sin(b), std::cos(b)));
            lobe.insert(lobe.end(), {value.diffuse.x, value.specular.x});
        }
    out.push_back({"reflection model", std::move(lobe)});
    if (scene.empty()) return;
    SceneEntries entries = read_scene(scene);
    Scene loaded = load(entries);
    build(loaded);
    loaded.settings.width = 48, loaded.settings.height = 36, loaded.settings.spp = 4;
    out.push_back({"render of a scene", values_of(render(loaded, loaded.settings))});
}

/// Floats between two values, both zeros being one.
std::int64_t apart(float a, float b) {
    const auto order = [](float v) {
        const auto bits = std::bit_cast<std::int32_t>(v);
        return std::int64_t(bits < 0 ? -std::int64_t(bits & 0x7fffffff) : bits);
    };
    return std::abs(order(a) - order(b));
}

std::vector<Result> read(const char* path) {
    std::ifstream in(path, std::ios::binary);
    std::vector<Result> out;
    std::size_t count = 0;
    for (std::string name; std::getline(in, name) && in.read(reinterpret_cast<char*>(&count), sizeof count);) {
        out.push_back({name, Values(count)});
        in.read(reinterpret_cast<char*>(out.back().values.data()), std::streamsize(4 * count));
    }
    return out;
}

int compare(const char* path, const char* other_path) {
    const std::vector<Result> one = read(path), other = read(other_path);
    if (one.empty() || one.size() != other.size()) return 1;
    std::printf("| result | values | different | at most, floats |\n|---|---|---|---|\n");
    for (std::size_t i = 0; i < one.size(); ++i) {
        const Values &a = one[i].values, &b = other[i].values;
        if (a.size() != b.size()) return 1;
        std::int64_t most = 0, different = 0;
        for (std::size_t k = 0; k < a.size(); ++k) {
            const std::int64_t distance = apart(a[k], b[k]);
            different += distance > 0, most = std::max(most, distance);
        }
        std::printf("| %s | %zu | %lld | %lld |\n", one[i].name.c_str(), a.size(), static_cast<long long>(different),
                    static_cast<long long>(most));
    }
    return 0;
}

} // namespace

int main(int count, char** words) {
    if (count == 3) return compare(words[1], words[2]);
    if (count != 2) return 2;
    std::vector<Result> all;
    add_functions(all);
    add_maps(all);
    add_skies(all);
    const char* source = std::getenv("BAKE_SOURCE");
    add_light(all, source ? std::string(source) + "/meshes/scene.toml" : "");
    std::ofstream out(words[1], std::ios::binary);
    for (const Result& result : all) {
        const std::size_t size = result.values.size();
        out << result.name << '\n';
        out.write(reinterpret_cast<const char*>(&size), sizeof size);
        out.write(reinterpret_cast<const char*>(result.values.data()), std::streamsize(4 * size));
    }
    return out.good() ? 0 : 1;
}
