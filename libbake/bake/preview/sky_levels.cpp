#include "bake/preview/sky_levels.h"
#include "bake/base/error.h"
#include "bake/environment/file/cube_levels.h"
#include "bake/environment/file/environment_io.h"
#include "bake/environment/file/sky_cube.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/prefilter.h"
#include "bake/light/split_sum.h"
#include "bake/picture/exr_levels.h"
#include <bit>

namespace bake {
namespace {

constexpr int steps = 10; ///< of roughness, from 0 to 1; alpha is its square

/// Texels along an edge that hold a lobe of width 2 alpha: four across it.
int size_for(double alpha, int sky) {
    constexpr int least = 32, most = 256;
    return std::clamp(int(std::bit_ceil(unsigned(pi / std::max(alpha, 1e-3)))), least,
                      std::min(most, std::max(least, sky)));
}

/// The sky filtered with the lobe of an alpha between two levels, which are mixed by roughness.
Vec3f glossy_light(const SkyLevels& levels, const Cube& sky, const Vec3f& d, float roughness) noexcept {
    const auto& alphas = levels.alphas;
    const auto at = [&](std::size_t level) {
        return fast_lookup(levels.glossy[level].empty() ? sky : levels.glossy[level], d);
    };
    const std::size_t last = alphas.size() - 1;
    std::size_t i = 0;
    while (i < last && std::sqrt(alphas[i + 1]) < roughness) ++i;
    const Vec3f sharp = at(i);
    if (i == last) return sharp;
    const float low = std::sqrt(alphas[i]), high = std::sqrt(alphas[i + 1]);
    const float share = high > low ? std::clamp((roughness - low) / (high - low), 0.f, 1.f) : 0.f;
    return share > 0 ? glm::mix(sharp, at(i + 1), share) : sharp;
}

} // namespace

void complete(SkyLevels& levels, const Cube& sky) {
    if (levels.irradiance.empty() || levels.own_irradiance) {
        levels.irradiance = irradiance(sky);
        levels.own_irradiance = true;
    }
    if (!levels.glossy.empty() && !levels.own_glossy) return;
    levels.glossy.clear(), levels.alphas.clear();
    levels.own_glossy = true;
    for (int i = 0; i <= steps; ++i) {
        const double roughness = double(i) / steps, alpha = roughness * roughness;
        levels.alphas.push_back(float(alpha));
        levels.glossy.emplace_back();
        if (i == 0) continue;
        const PrefilterOptions options{.roughness = {alpha}, .size = size_for(alpha, sky.size())};
        levels.glossy.back() = std::move(prefilter(sky, options).front());
    }
}

Cube read_irradiance(const std::string& file) { return sky_cube(read_environment({file}, {.check_seams = false})); }

namespace {

void check_count(const std::string& file, std::size_t found, std::size_t levels) {
    if (found < levels)
        throw Error(Refusal::unsuitable, file + ": has " + std::to_string(found) + " levels for " +
                                             std::to_string(levels) + " values of alpha; give as many values");
}

} // namespace

std::vector<Cube> read_glossy(const std::string& file, std::size_t levels) {
    if (names_cube_levels(file)) {
        std::vector<Cube> cubes = read_cube_levels(file);
        check_count(file, cubes.size(), levels);
        cubes.resize(levels);
        return cubes;
    }
    const std::array<std::string, 6> files = find_faces(file).files;
    std::vector<Cube> cubes(levels);
    for (std::size_t f = 0; f < 6; ++f) {
        std::vector<Image<float>> chain = read_exr_levels(files[f]);
        check_count(files[f], chain.size(), levels);
        for (std::size_t k = 0; k < levels; ++k) {
            const Image<float>& face = chain[k];
            const Image<float>& first = f > 0 ? cubes[k].faces[0] : face;
            if (face.width() != face.height() || face.width() != first.width())
                throw Error(Refusal::unsuitable, files[f] + ": is not square, or of another size than " + files[0] +
                                                     "; give six faces of one size");
            mend(chain[k], BadPolicy::refuse, files[f]);
            cubes[k].faces[f] = face.channels() == 3 ? std::move(chain[k]) : to_rgb(face);
        }
    }
    return cubes;
}

BsdfValue reflected(const SkyLevels& levels, const Sky& sky, const Bsdf& bsdf, const Vec3f& n,
                    const Vec3f& v) noexcept {
    const SplitSum sum = split_sum(bsdf, n, v);
    BsdfValue out;
    if (sum.diffuse + sum.scattered != Vec3f(0)) {
        const Vec3f even = fast_lookup(levels.irradiance, sky.yaw.to_cube(n)) * float(1 / pi);
        out.diffuse = sum.diffuse * even, out.specular = sum.scattered * even;
    }
    for (int i = 0; i < sum.count; ++i) {
        const SplitSum::Gloss& gloss = sum.gloss[std::size_t(i)];
        out.specular += gloss.factor * glossy_light(levels, sky.cube, sky.yaw.to_cube(gloss.axis), gloss.roughness);
    }
    out.diffuse *= sky.scale, out.specular *= sky.scale;
    return out;
}

} // namespace bake
