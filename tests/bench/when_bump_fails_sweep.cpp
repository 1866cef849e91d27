// when_bump_fails_sweep: how wrong every way of showing a relief is, against a displaced mesh that is fine enough, over bases,
// reliefs, distances, view angles, sun heights and materials. scripts/when_bump_fails makes docs/when-bump-fails.md of it.
//
//   when_bump_fails_sweep [--check | --quick | --show SHEET.png] [CAGE.obj]     one row of csv per configuration on stdout
//
// All methods of a configuration take the same samples. Squared errors are products of the differences of two independent
// halves. Pixels count in which the method or the reference shows the object. Pictures are exposed as the reference and
// clamped to [0, 1] first. FLIP sees the mean of both halves.
#include "bake/preview/passes.h"
#include "bake/verdict/compare/picture_errors.h"
#include "relief_scenes.h"
#include <algorithm>
#include <cstdio>
#include <cstring>

using namespace bench;

namespace {

constexpr const char* method_names[] = {"plain",      "roughness",  "constant-scale",    "blinn",
                                        "exact",      "bump",       "bump+roughness",    "normal",
                                        "displace:4", "displace:8", "displace+normal:4", "displace+normal:8"};
constexpr int method_count = int(std::size(method_names));
constexpr const char *reference_name = "displace:32", *half_reference_name = "displace:16";

constexpr double slopes[] = {0.08, 0.25, 0.6};
constexpr double views_deg[] = {25, 70};    ///< from the vertical
constexpr double suns_deg[] = {10, 30, 65}; ///< above the horizon
struct Distance {
    const char* name;
    double sizes;      ///< in sizes of the object
    double image_size; ///< of the part of the scene in the picture, in sizes of the object
    int pixels;
};
constexpr Distance distances[] = {{"near", 3, 1.5, 100}, {"far", 10, 1.5, 36}};

struct Configuration {
    int finish, view, sun, distance;
};

/// Every material and sun with two of the four pairs of view and distance, in turn, so that each value of one appears as
/// often as another with every value of the others.
std::vector<Configuration> configurations(int turn) {
    std::vector<Configuration> list;
    for (int finish = 0; finish < int(std::size(finishes)); ++finish)
        for (int view = 0; view < int(std::size(views_deg)); ++view)
            for (int sun = 0; sun < int(std::size(suns_deg)); ++sun)
                list.push_back({finish, view, sun, (turn + finish + view + sun) % 2});
    return list;
}

/// What one method shows.
struct Shot {
    Halves halves;
    Image<float> alpha;
};

Shot shoot(Scene& scene, const Base& base, const Configuration& c, std::vector<Sky>& skies, std::uint32_t seed,
           int pixels = 0) {
    const Distance& distance = distances[c.distance];
    if (pixels == 0) pixels = distance.pixels;
    for (const auto& material : scene.materials)
        if (c.finish >= 0) set_finish(material->reflectance, material->reflect, finishes[c.finish]);
    std::swap(scene.sky, skies[c.sun]); // skies are not copied
    scene.textured = true;              // the sky has mips
    Light<float> sun;
    sun.from = direction(suns_deg[c.sun], -60);
    sun.colour = Vec3f(1.2f, 1.15f, 1.05f);
    scene.lights = {sun};
    const glm::dvec3 centre = Vec3d(scene.instances[0].linear * base.centre);
    scene.camera = {};
    scene.camera.position = Vec3f(centre + distance.sizes * base.size * Vec3d(direction(90 - views_deg[c.view], 0)));
    scene.camera.target = Vec3f(centre);
    scene.camera.fov_deg = float(2 * std::atan(distance.image_size / (2 * distance.sizes)) * 180 / pi);
    RenderSettings settings = scene.settings;
    settings.width = settings.height = pixels;
    // Pixels of a mirror are noisier, and there are few pixels of what is far.
    settings.spp = (c.distance == 0 ? 8 : 32) * (scene.materials.back()->reflect.x > 0 ? 4 : 1);
    settings.seed = seed;
    Passes passes(scene, settings, {.layers = true, .halves = true, .first = settings.spp});
    passes.next();
    std::swap(scene.sky, skies[c.sun]);
    const Image<float> layers = passes.layers();
    Shot shot{{passes.half(0), passes.half(1)}, Image<float>(pixels, pixels, 1)};
    for (int y = 0; y < layers.height(); ++y)
        for (int x = 0; x < layers.width(); ++x) shot.alpha.at(x, y) = (&layers.at(x, y))[3];
    return shot;
}

void expose(Image<float>& picture, float exposure) {
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture.data()[i] = std::clamp(picture.data()[i] * std::exp2(exposure), 0.f, 1.f);
}

void expose(Shot& shot, float exposure) { expose(shot.halves.a, exposure), expose(shot.halves.b, exposure); }

struct Errors {
    double rmse = 0, flip = 0, silhouette = 0; ///< silhouette: mean difference of coverage
    double noise = 0;                          ///< standard error of the RMSE
};

/// Of exposed pictures.
Errors errors_of(const Shot& reference, const Shot& shot) {
    const Image<float> flips = flip(mean_picture(reference.halves), mean_picture(shot.halves));
    std::vector<std::uint8_t> object(flips.size());
    double flip_sum = 0, cover = 0, count = 0;
    for (std::size_t i = 0; i < object.size(); ++i) {
        const float a = reference.alpha.data()[i], b = shot.alpha.data()[i];
        object[i] = a > 0 || b > 0;
        if (object[i]) flip_sum += double(flips.data()[i]), cover += double(std::abs(a - b)), ++count;
    }
    const Estimate rmse = root(square_error(reference.halves, shot.halves, 0, object));
    count = std::max(count, 1.0);
    return {rmse.value, flip_sum / count, cover / count, rmse.error};
}

/// Mean distance, in pixels, from the pixels of the object to those that are not covered by half.
double distance_to_contour(const Image<float>& alpha) {
    std::vector<Vec2d> outside, inside;
    const auto covered = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < alpha.width() && y < alpha.height() && alpha.at(x, y) >= 0.5f;
    };
    for (int y = -1; y <= alpha.height(); ++y)
        for (int x = -1; x <= alpha.width(); ++x) {
            if (covered(x, y)) inside.emplace_back(x, y);
            else if (covered(x - 1, y) || covered(x + 1, y) || covered(x, y - 1) || covered(x, y + 1))
                outside.emplace_back(x, y);
        }
    double sum = 0;
    for (const Vec2d& p : inside) {
        double nearest = 1e30;
        for (const Vec2d& q : outside) nearest = std::min(nearest, glm::dot(p - q, p - q));
        sum += std::sqrt(nearest);
    }
    return inside.empty() ? 0 : sum / double(inside.size());
}

/// The scenes of one relief on one base, by method; roughness, which widens the highlight of its material, has one for each.
struct Scenes {
    std::vector<Scene> methods, roughness;
    Scene reference;
};

Scenes scenes_of(const Base& base, const ReliefField& field, double slope) {
    const auto scene = [&](const char* word, const Finish& finish) {
        return relief_scene(base, field, slope, parse_shade(word).value(), finish);
    };
    Scenes scenes;
    for (const char* word : method_names) scenes.methods.push_back(scene(word, finishes[0]));
    for (const Finish& finish : finishes) scenes.roughness.push_back(scene("roughness", finish));
    scenes.reference = scene(reference_name, finishes[0]);
    return scenes;
}

Shot shoot_method(Scenes& scenes, int method, const Base& base, Configuration c, std::vector<Sky>& skies,
                  std::uint32_t seed) {
    if (std::strcmp(method_names[method], "roughness") != 0) return shoot(scenes.methods[method], base, c, skies, seed);
    Scene& scene = scenes.roughness[c.finish];
    c.finish = -1; // as loaded
    return shoot(scene, base, c, skies, seed);
}

void print_head() {
    std::printf(
        "base,spectrum,shortest,rms_slope,height,height_px,contour_px,distance,view_deg,sun_deg,material,pixels");
    for (const char* name : method_names) std::printf(",rmse %s", name);
    for (const char* name : method_names) std::printf(",flip %s", name);
    std::printf(",silhouette plain\n");
}

void print_row(const Base& base, const Spectrum& spectrum, double slope, const ReliefField& field,
               const Configuration& c, Scenes& scenes, std::vector<Sky>& skies) {
    Shot reference = shoot(scenes.reference, base, c, skies, 0);
    const float exposure = automatic_exposure(mean_picture(reference.halves));
    expose(reference, exposure);
    std::vector<Errors> errors;
    for (int method = 0; method < method_count; ++method) {
        Shot shot = shoot_method(scenes, method, base, c, skies, 0);
        expose(shot, exposure);
        errors.push_back(errors_of(reference, shot));
    }
    const Distance& distance = distances[c.distance];
    const auto covered = std::count_if(reference.alpha.data(), reference.alpha.data() + reference.alpha.size(),
                                       [](float a) { return a > 0; });
    std::printf("%s,%s,%.3g,%.3g,%.3g,%.3g,%.3g,%s,%g,%g,%s,%lld", base.name, spectrum.name, spectrum.shortest, slope,
                slope * field.range, slope * field.range * distance.pixels / distance.image_size,
                distance_to_contour(reference.alpha), distance.name, views_deg[c.view], suns_deg[c.sun],
                finishes[c.finish].name, static_cast<long long>(covered));
    for (const Errors& e : errors) std::printf(",%.3g", e.rmse);
    for (const Errors& e : errors) std::printf(",%.3g", e.flip);
    std::printf(",%.3g\n", errors[0].silhouette);
    std::fflush(stdout);
}

std::vector<Sky> skies_of_suns() {
    std::vector<Sky> skies;
    for (const double sun : suns_deg) skies.push_back(sky_with_sun(direction(sun, -60)));
    return skies;
}

void sweep(const std::vector<Base>& all, bool quick) {
    std::vector<Sky> skies = skies_of_suns();
    print_head();
    int turn = 0;
    for (const Base& base : all)
        for (const Spectrum& spectrum : spectra) {
            const ReliefField field = relief_field(base, spectrum, 1024);
            for (const double slope : slopes) {
                if (quick && slope != slopes[1]) continue;
                Scenes scenes = scenes_of(base, field, slope);
                for (const Configuration& c : configurations(turn++))
                    print_row(base, spectrum, slope, field, c, scenes, skies);
                std::fprintf(stderr, "when_bump_fails_sweep: %s, %s waves, slope %g\n", base.name, spectrum.name,
                             slope);
            }
        }
}

/// How far the reference is from one of half its resolution, and how much errors change with the seed, where the relief is
/// hardest: the shortest waves and the steepest slope.
void check(const std::vector<Base>& all) {
    std::vector<Sky> skies = skies_of_suns();
    std::printf(
        "base,material,distance,view_deg,sun_deg,rmse of half the reference,flip of half the reference,rmse bump,"
        "bump with another seed,standard error,rmse displace:8,displace:8 with another seed\n");
    for (const Base& base : all) {
        const Spectrum& spectrum = spectra[std::size(spectra) - 1];
        const ReliefField field = relief_field(base, spectrum, 1024);
        Scenes scenes = scenes_of(base, field, slopes[2]);
        Scene half = relief_scene(base, field, slopes[2], parse_shade(half_reference_name).value(), finishes[0]);
        for (const Configuration& c : configurations(0)) {
            if (c.sun != 1) continue;
            Errors coarse, bump[2], displaced[2];
            for (const int seed : {0, 1}) {
                Shot reference = shoot(scenes.reference, base, c, skies, std::uint32_t(seed));
                const float exposure = automatic_exposure(mean_picture(reference.halves));
                expose(reference, exposure);
                const auto errors = [&](Scene& scene) {
                    Shot shot = shoot(scene, base, c, skies, std::uint32_t(seed));
                    expose(shot, exposure);
                    return errors_of(reference, shot);
                };
                if (seed == 0) coarse = errors(half);
                bump[seed] = errors(scenes.methods[5]), displaced[seed] = errors(scenes.methods[9]);
            }
            std::printf("%s,%s,%s,%g,%g,%.2g,%.2g,%.3g,%.3g,%.2g,%.3g,%.3g\n", base.name, finishes[c.finish].name,
                        distances[c.distance].name, views_deg[c.view], suns_deg[c.sun], coarse.rmse, coarse.flip,
                        bump[0].rmse, bump[1].rmse, bump[0].noise, displaced[0].rmse, displaced[1].rmse);
            std::fflush(stdout);
        }
    }
}

/// A row for each base, of different materials: plain, bump, normal, displace:8 and the reference.
void show(const std::vector<Base>& all, const std::string& file) {
    constexpr int pixels = 160, columns[] = {0, 5, 7, 9};
    std::vector<Sky> skies = skies_of_suns();
    Image<float> sheet(5 * pixels, int(all.size()) * pixels, 3);
    for (int row = 0; row < int(all.size()); ++row) {
        const Base& base = all[std::size_t(row)];
        const Spectrum& spectrum = spectra[row % 2];
        Scenes scenes = scenes_of(base, relief_field(base, spectrum, 1024), slopes[1 + row % 2]);
        const Configuration c{row % 3, 1, 1, 0};
        const auto put = [&](Scene& scene, int column, float exposure) {
            const Image<float> picture = mean_picture(shoot(scene, base, c, skies, 0, pixels).halves);
            for (int y = 0; y < pixels; ++y)
                for (int x = 0; x < 3 * pixels; ++x)
                    sheet.row(row * pixels + y)[3 * column * pixels + x] =
                        shown_value(picture.row(y)[x], exposure, Tone::srgb);
            return automatic_exposure(picture);
        };
        const float exposure = put(scenes.reference, 4, 0);
        put(scenes.reference, 4, exposure);
        for (int i = 0; i < 4; ++i) put(scenes.methods[std::size_t(columns[i])], i, exposure);
    }
    write_image(file, sheet, {.depth = Depth::u8});
}

} // namespace

int main(int argc, char** argv) {
    bool quick = false, only_check = false;
    std::string cage = "meshes/torus.obj", sheet;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--quick") == 0) quick = true;
        else if (std::strcmp(argv[i], "--check") == 0) only_check = true;
        else if (std::strcmp(argv[i], "--show") == 0 && i + 1 < argc) sheet = argv[++i];
        else cage = argv[i];
    }
    const std::vector<Base> all = bases(cage);
    if (!sheet.empty()) show(all, sheet);
    else only_check ? check(all) : sweep(all, quick);
}
