// Objects far from the origin, very small and very large, and triangles as thin as needles.
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/origin.h"
#include "bake/picture/image_io.h"
#include "bake/preview/relief_method.h"
#include "bake/preview/shape_mesh.h"
#include "folders.h"
#include "preview/little_scenes.h"
#include "stability/commands.h"
#include "stability/themes.h"
#include <algorithm>
#include <cstdlib>

using namespace bake;
using namespace bake::test;

namespace stability {
namespace {

/// Where the object of size 3.5 is, x away from the origin along no axis.
Vec3d place(double x) { return x * Vec3d(0.64, -0.48, 0.6); }

std::vector<Row> stored_rows(int steps) {
    const Mesh ball = sphere_mesh(32, 16);
    const double size = diagonal(bounds(ball));
    std::vector<Row> rows;
    for (const bool wide : {true, false})
        for (const double x : geometric_steps(1, 1e12, steps)) {
            Mesh mesh = ball;
            std::vector<Vec3d> points;
            for (const Vec3f& p : ball.positions) points.push_back(Vec3d(p) + place(x));
            if (wide) {
                set_positions(mesh, points);
            } else {
                for (std::size_t i = 0; i < points.size(); ++i) mesh.positions[i] = Vec3f(points[i]);
                find_origin(mesh);
            }
            double worst = 0;
            for (std::size_t i = 0; i < points.size(); ++i)
                worst = std::max(
                    worst, glm::length(mesh.origin - place(x) + Vec3d(mesh.positions[i]) - Vec3d(ball.positions[i])));
            const double step = wide ? 0x1p-53 : 0x1p-24;
            rows.push_back({wide ? "64-bit positions" : "32-bit positions", x, worst / size,
                            std::max(0x1p-25, 0.64 * x * step / size),
                            wide ? "kept relative to an origin of the mesh"
                            : mesh.notes.empty()
                                ? "as they are"
                                : "a note: positions are rounded by ..., export near zero or with 64 bits"});
        }
    return rows;
}

/// The mesh of the verbs: a torus, whose chart has no poles; x away.
Mesh ring(double x) {
    Mesh mesh = shape_mesh("torus:R=1,r=0.4", 24, 12);
    mesh.origin = place(x);
    return mesh;
}

/// Root mean square difference over root mean square.
double picture_error(const Image<float>& a, const Image<float>& truth) {
    if (a.size() != truth.size()) return 1;
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double t = double(truth.data()[i]);
        sum += (double(a.data()[i]) - t) * (double(a.data()[i]) - t), all += t * t;
    }
    return all > 0 ? std::sqrt(sum / all) : 1;
}

double mesh_error(const Mesh& a, const Mesh& truth, const Vec3d& by) {
    if (a.positions.size() != truth.positions.size()) return 1;
    double worst = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        worst = std::max(worst,
                         glm::length(a.origin - by - truth.origin + Vec3d(a.positions[i]) - Vec3d(truth.positions[i])));
    return std::min(1.0, worst / diagonal(bounds(truth)));
}

/// What the commands make of the ring at x.
struct Made {
    Mesh displaced;
    Image<float> surface, normals, picture;
    double area = 0;
    std::string answer, rendered;
};

Made make_all(const CommandFolder& folder, double x) {
    const std::string bricks = "'" + (own_meshes() / "bricks.png").string() + "'";
    write_mesh(folder / "ring.obj", ring(x));
    Made made;
    int codes = 0;
    const auto run = [&](const std::string& arguments) {
        const CommandFolder::Answer answer = folder.run(arguments);
        codes = std::max(codes, answer.code);
        return answer;
    };
    run("displace ring.obj --height " + bricks + " --amplitude 2% --levels 1 -o displaced.obj --quiet");
    run("surface ring.obj --maps normal --size 64 --maps-out surface --quiet");
    run("normal-map ring.obj --height " + bricks + " --amplitude 2% --size 64 --depth float -o normals.exr --quiet");
    const CommandFolder::Answer rendered = run("render ring.obj --size 48 --spp 1 -o picture.exr --depth float");
    made.rendered = rendered.err.find("move the mesh near the origin") != std::string::npos
                        ? "a note: coordinates of a scene are rounded by ..., move the mesh near the origin"
                        : "exit 0";
    const std::string report = run("check --json ring.obj").out;
    if (const auto at = report.find("\"area\":"); at != std::string::npos)
        made.area = std::atof(report.c_str() + at + 7);
    made.answer = "exit " + std::to_string(codes);
    if (codes != 0) return made;
    made.displaced = read_mesh(folder / "displaced.obj");
    made.surface = read_image(folder / "surface_normal.exr");
    made.normals = read_image(folder / "normals.exr"), made.picture = read_image(folder / "picture.exr");
    return made;
}

std::vector<Row> verb_rows(int steps) {
    const CommandFolder folder;
    const Made near = make_all(folder, 0);
    std::vector<Row> all[5];
    const char* const names[5] = {"check: area", "surface", "displace", "normal-map", "render"};
    for (const double x : geometric_steps(1, 1e16, std::min(steps, 17))) {
        const Made far = make_all(folder, x);
        const double errors[5] = {std::min(1.0, std::abs(far.area / near.area - 1)),
                                  picture_error(far.surface, near.surface),
                                  mesh_error(far.displaced, near.displaced, place(x)),
                                  picture_error(far.normals, near.normals), picture_error(far.picture, near.picture)};
        for (int i = 0; i < 5; ++i) {
            const bool scene = i == 4; // in 32-bit floats; a slope of brightness of about one over a tenth of the size
            const double predicted = std::max(1e-6, std::min(1.0, scene ? 10 * 0.64 * x * 0x1p-24 / 3 : x * 0x1p-53));
            all[i].push_back({names[i], x, errors[i], predicted, scene ? far.rendered : far.answer});
        }
    }
    std::vector<Row> rows;
    for (const std::vector<Row>& some : all) rows.insert(rows.end(), some.begin(), some.end());
    return rows;
}

HeightTexture bumps() {
    HeightTexture height;
    height.info.type = SampleType::float32;
    height.values = Image<float>(64, 32, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            height.values.at(x, y) = float(0.5 + 0.5 * std::sin(2 * pi * 4 * x / 64) * std::sin(pi * (y + 0.5) / 32));
    return height;
}

Image<float> sized_picture(const std::string& method, double size, std::string* note = nullptr) {
    Mesh mesh = sphere_mesh(24, 12);
    for (Vec3f& p : mesh.positions) p = Vec3f(size * Vec3d(p));
    auto shape = make_shape(std::move(mesh));
    ReliefOptions options{.method = parse_shade(method).value(), .height = {.amplitude = 0.05 * size}};
    ReliefModel model = with_relief(Material{}, *shape, bumps(), options);
    Scene scene;
    scene.shapes.push_back(model.shape ? std::move(model.shape) : std::move(shape));
    scene.materials.push_back(std::make_unique<Material>(model.material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    scene.lights = {directional({1, 1, 1})};
    scene.camera = framing_camera(bounds(scene), 40, 1);
    scene.settings.width = scene.settings.height = 32, scene.settings.spp = 1;
    build(scene);
    if (note && !scene.notes.empty()) *note = scene.notes.back().substr(scene.notes.back().find(':') + 2);
    return render(scene, scene.settings);
}

/// Sizes from 1 to `end`.
std::vector<Row> size_rows(int steps, double end) {
    std::vector<Row> rows;
    for (const char* method : {"plain", "exact", "normal", "displace:4"}) {
        const Image<float> truth = sized_picture(method, 1);
        for (const double x : geometric_steps(1, end, steps)) {
            // Cross products of p_u and p_v, and their squares: x^4 has to stay above the smallest float.
            const bool relief = std::string(method) == "exact" || std::string(method) == "normal";
            Row row{method, x, 1, x < (relief ? 1e-12 : 1e-30) || x > 9e17 ? 1.0 : 0.0, "exit 0"};
            try {
                std::string note;
                row.measured = picture_error(sized_picture(method, x, &note), truth);
                if (!note.empty()) row.program = "a note: " + note;
            } catch (const Error& error) {
                row.program = std::string("refused: ") + error.what();
            }
            rows.push_back(row);
        }
    }
    return rows;
}

/// Turned so that no edge is along an axis.
Vec3f turned(const Vec3d& p) {
    return Vec3f(glm::dot(p, Vec3d(0.36, 0.48, -0.8)), glm::dot(p, Vec3d(-0.8, 0.6, 0)),
                 glm::dot(p, Vec3d(0.48, 0.64, 0.6)));
}

std::vector<Row> needle_rows(int steps) {
    std::vector<Row> angles, lost;
    for (const double x : geometric_steps(1, 1e9, steps)) {
        // A unit square around a point that is 1 / x above the middle of its lower edge: one needle, two thin neighbours.
        const Vec3d corners[5] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 1 / x, 0}};
        BvhMesh mesh;
        for (const Vec3d& p : corners) mesh.positions.push_back(turned(p));
        mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
        const Bvh bvh({mesh});
        const Vec3f normal = turned({0, 0, 1});
        int rays = 0, misses = 0;
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const double across = (i + 0.5) / 2000, height = (i % 40 + 0.5) / 40 * 2 / x;
            if (!(height < 1)) continue;
            const Vec3f to = turned({0.05 + 0.9 * across, std::max(height, 1e-6), 0});
            const Hit hit = bvh.intersect({to + 2.0f * normal, -normal});
            ++rays, misses += !hit;
            if (hit) {
                const Vec3f n = bvh.point(hit).normal;
                worst = std::max(worst, n == Vec3f(0) ? 90.0 : std::min(angle_deg(n, normal), angle_deg(-n, normal)));
            }
        }
        const char* const told = x < 1.5e6 ? "hit" : "thinner than the step of floats: hit by its neighbours";
        angles.push_back({"normal of the facet (deg)", x, worst, std::min(90.0, x * 0x1p-26 * 180 / pi), told});
        lost.push_back({"share of rays lost", x, double(misses) / rays, 0.0, told});
    }
    angles.insert(angles.end(), lost.begin(), lost.end());
    return angles;
}

/// Those of the distance.
std::vector<Sweep> far_sweeps() {
    const char* const test = "stability/distance_test";
    return {
        {.name = "far_positions",
         .construction = "a ball of the diagonal 3.5, x away from the origin: error of its positions over the diagonal",
         .x_label = "distance from the origin",
         .y_label = "relative error",
         .log_x = true,
         .log_y = true,
         .limit = 1e-3,
         .closed_form = "half a step of 32-bit or 64-bit floats at x",
         .test = test,
         .rows = stored_rows},
        {.name = "far_verbs",
         .construction = "what the verbs make of a torus of the diagonal 3 as text (OBJ), x away, against what they "
                         "make of it at the origin",
         .x_label = "distance from the origin",
         .y_label = "relative difference",
         .log_x = true,
         .log_y = true,
         .limit = 0.02,
         .closed_form = "half a step of 64-bit floats, of 32-bit floats for scenes",
         .test = test,
         .rows = verb_rows}};
}

} // namespace

std::vector<Sweep> distance_sweeps() {
    const char* const test = "stability/distance_test";
    const std::vector<Sweep> others = {
        {.name = "large_objects",
         .construction =
             "a ball with relief, x times as large with camera and amplitude: difference of its picture from that "
             "at size 1",
         .x_label = "size",
         .y_label = "relative difference",
         .log_x = true,
         .log_y = true,
         .limit = 0.01,
         .closed_form = "the tracer takes coordinates up to 1e18",
         .test = test,
         .rows = [](int steps) { return size_rows(steps, 1e30); }},
        {.name = "small_objects",
         .construction = "the same ball, smaller and smaller",
         .x_label = "size",
         .y_label = "relative difference",
         .log_x = true,
         .log_y = true,
         .limit = 0.01,
         .closed_form =
             "normals of relief are squares of areas: x^4 has to stay above 1e-48; meshes have no limit here",
         .test = test,
         .rows = [](int steps) { return size_rows(steps, 1e-30); }},
        {.name = "needles",
         .construction =
             "a square with a point 1 / x above the middle of an edge: a needle of the aspect x and its neighbours, "
             "not along an axis",
         .x_label = "aspect",
         .y_label = "degrees, share",
         .log_x = true,
         .log_y = true,
         .limit = 0.1,
         .closed_form = "the normal turns by x 2^-26; no ray gets through",
         .test = test,
         .rows = needle_rows},
    };
    std::vector<Sweep> all = far_sweeps();
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

} // namespace stability
