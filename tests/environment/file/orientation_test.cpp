#include "bake/environment/file/environment_io.h"
#include "bake/environment/file/orientation.h"
#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/layout.h"
#include "cli/command.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

using namespace bake;

namespace {

/// A sky without symmetry: smooth, with some noise so that the inside has steps.
Cube uneven_sky(int n, float noise = 0.01f) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0, noise);
    Cube cube = make_cube(n, 3);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3d d = glm::normalize(cube_direction(CubePoint<double>{face, (x + 0.5) / n, (y + 0.5) / n}));
                for (int c = 0; c < 3; ++c)
                    cube[face].at(x, y, c) =
                        float(1 + 0.5 * std::sin(3 * d.x + d.y + c) + 0.4 * std::cos(2 * d.y - 2 * d.z + 1) * d.z) +
                        uniform(random);
            }
    return cube;
}

/// Strong detail everywhere but towards -Z, where there is only a gentle slope: the mean over all seams shows nothing of a
/// mistake at that face.
Cube smooth_behind(int n) {
    Cube cube = uneven_sky(n, 0);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3d d = glm::normalize(cube_direction(CubePoint<double>{face, (x + 0.5) / n, (y + 0.5) / n}));
                const double detail = std::clamp((d.z + 0.45) / 0.5, 0.0, 1.0),
                             lines = std::sin(11 * d.x + 1) * std::sin(9 * d.y + 2) * std::cos(10 * d.z);
                for (int c = 0; c < 3; ++c)
                    cube[face].at(x, y, c) = float(0.3 + 0.02 * d.x + 0.06 * d.y + 0.2 * detail * lines);
            }
    return cube;
}

/// The reverse: how faces must be mistaken so that `o` mends them.
Orientation inverse(const Orientation& o) {
    Orientation back;
    for (int k = 0; k < 6; ++k) {
        back.source[o.source[k]] = k;
        back.turns[o.source[k]] = (4 - o.turns[k]) % 4;
    }
    return back;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("orientation: a sky that is right is left alone") {
        const OrientationCheck check = check_orientation(uneven_sky(32));
        CHECK(check.given < 1.2);
        CHECK(check.closes.as_given());
        CHECK(!check.wrong);
    }

    TEST_CASE("orientation: any swap and turn that does not turn the cube as a whole is found and mended") {
        const Cube sky = uneven_sky(24);
        std::mt19937 random(5);
        const Orientation mistakes[] = {{{0, 1, 2, 3, 5, 4}, {}},                 // +Z and -Z swapped
                                        {{0, 1, 2, 3, 4, 5}, {0, 0, 1, 3, 0, 0}}, // up and down turned
                                        {{0, 1, 3, 2, 4, 5}, {}},                 // up and down swapped
                                        {{0, 1, 2, 3, 4, 5}, {0, 0, 0, 0, 0, 2}}, // one upside down
                                        {{1, 0, 2, 3, 4, 5}, {0, 0, 2, 0, 0, 0}}};
        for (const Orientation& mistake : mistakes) {
            const Cube wrong = reorient(sky, mistake);
            const OrientationCheck check = check_orientation(wrong);
            CHECK(check.wrong);
            CHECK(check.given > 2);
            CHECK(check.best < 1.2);
            const Cube mended = reorient(wrong, check.closes);
            CHECK(check_orientation(mended).given == doctest::Approx(check.best));
            CHECK(check.best == doctest::Approx(check_orientation(sky).given).epsilon(0.01));
        }
        // Where few faces are wrong, the least change is the answer, not a turn of the whole cube.
        for (const int i : {0, 1, 2, 3})
            CHECK(check_orientation(reorient(sky, mistakes[i])).closes == inverse(mistakes[i]));
    }

    TEST_CASE("orientation: one face turned or mirrored in any way is found, also where the sky is smooth") {
        const Cube skies[] = {uneven_sky(24), smooth_behind(64)};
        for (const Cube& sky : skies)
            for (int face = 0; face < 6; ++face)
                for (int mistake = 1; mistake < 8; ++mistake) {
                    Orientation o;
                    o.mirrored[face] = mistake >= 4;
                    o.turns[face] = mistake % 4;
                    CAPTURE(face);
                    CAPTURE(mistake);
                    const Cube wrong = reorient(sky, o);
                    const OrientationCheck check = check_orientation(wrong);
                    CHECK(check.wrong);
                    CHECK(check.open_given() > 0);
                    CHECK(check.open_best() == 0);
                    const Cube mended = reorient(wrong, check.closes);
                    for (std::size_t i = 0; i < mended.faces[face].size(); ++i)
                        REQUIRE(mended.faces[face].data()[i] == sky.faces[face].data()[i]);
                }
    }

    TEST_CASE("orientation: faces that belong to different skies are not called mended") {
        Cube patchwork = make_cube(16, 3);
        for (int f = 0; f < 6; ++f) {
            const Cube other = uneven_sky(16);
            for (std::size_t i = 0; i < other.faces[f].size(); ++i)
                patchwork.faces[f].data()[i] = other.faces[f].data()[i] * float(1 << f);
        }
        const OrientationCheck check = check_orientation(patchwork);
        CHECK(check.given > 2);
        CHECK(!check.wrong);
    }

    TEST_CASE("orientation: the mending is told in words") {
        Orientation o;
        o.source = {0, 1, 2, 3, 5, 4};
        o.turns = {0, 0, 1, 0, 0, 0};
        CHECK(to_text(o, {"a", "b", "c", "d", "e", "f"}) == "+Y = c turned 90 deg, +Z = f, -Z = e");
        CHECK(to_text({}, {"a", "b", "c", "d", "e", "f"}) == "");
        Orientation mirror;
        mirror.mirrored[4] = true;
        mirror.turns[4] = 2;
        CHECK(to_text(mirror, {"a", "b", "c", "d", "e", "f"}) == "+Z = e mirrored left to right and turned 180 deg");
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("orientation: skies of one colour, of one texel and of noise say nothing and are left alone") {
        Cube flat = make_cube(4, 3);
        for (Image<float>& face : flat.faces)
            for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = 1;
        CHECK(check_orientation(flat).unknown);
        CHECK(!check_orientation(flat).wrong);
        CHECK(check_orientation(uneven_sky(1)).unknown);
        CHECK(!check_orientation(uneven_sky(16, 100)).wrong);
    }

} // TEST_SUITE
TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("orientation: what others found out by hand about four skies, the tool finds by itself") {
        const auto data = test::shared_data();
        const auto check = [&](const std::string& pattern) {
            EnvironmentReport report;
            read_environment({(data / "environments/sixface" / pattern).string()}, {}, &report);
            MESSAGE(pattern << ": seam ratio " << report.orientation.given << ", best " << report.orientation.best);
            return report;
        };
        const EnvironmentReport garden = check("studio_garden/studio_garden_%s.jpg");
        CHECK(garden.orientation.given < 1);
        CHECK(garden.orientation.closes.as_given());

        const EnvironmentReport night =
            check("skysf/skysfJ_%s.jpg"); // +Z = bk, -Z = ft, up turned by 90 deg, dn by 270
        CHECK(night.orientation.wrong);
        CHECK(night.files[4].ends_with("_bk.jpg"));
        CHECK(night.files[5].ends_with("_ft.jpg"));
        CHECK(night.orientation.closes == Orientation{{0, 1, 2, 3, 4, 5}, {0, 0, 1, 3, 0, 0}});
        CHECK(night.orientation.best < 1);

        const EnvironmentReport stars = check("tycho/tycho2t3_80_%s.jpg"); // +Y = my, -Y = py
        CHECK(stars.orientation.wrong);
        CHECK(stars.orientation.closes == Orientation{{0, 1, 3, 2, 4, 5}, {}});

        const EnvironmentReport smooth = check("philo_sky3/sky3_%s.jpg"); // named as skysf is; its ground is even
        CHECK(smooth.orientation.wrong);
        CHECK(smooth.orientation.closes.turns[2] == 1);

        EnvironmentReport strip;
        read_environment({(data / "environments/strip/Ryfjallet_cubemap.png").string()}, {}, &strip);
        CHECK(strip.orientation.open_given() == 0);
        CHECK(strip.orientation.given < 1);
        CHECK(strip.orientation.closes.as_given());
    }

    TEST_CASE("orientation: faces made from every real sky, at any size, have no open seam, and a mistake is found") {
        const auto data = test::shared_data() / "environments";
        int skies = 0;
        for (const char* folder : {"latlong", "openexr"})
            for (const auto& entry : std::filesystem::directory_iterator(data / folder)) {
                const std::string file = entry.path().string();
                const bool is_sky = file.ends_with(".hdr") || file.ends_with(".exr");
                if (!is_sky || file.find("Pattern") != std::string::npos || file.find("Sphere") != std::string::npos)
                    continue;
                ++skies;
                CAPTURE(file);
                const Environment sky = read_environment({file}, {.bad = BadPolicy::clamp});
                for (const int size : {4, 8, 16, 64, 256}) {
                    CAPTURE(size);
                    const Cube cube = to_cube(sky, {size, false}, {});
                    const OrientationCheck check = check_orientation(cube);
                    const double worst = *std::max_element(check.given_seams.begin(), check.given_seams.end());
                    CAPTURE(worst);
                    CHECK(!check.visible());
                    CHECK(!check.wrong);
                    if (size < 64) continue;
                    for (int face = 0; face < 6; ++face) {
                        CAPTURE(face);
                        Orientation mistake;
                        mistake.turns[face] = 2;
                        const OrientationCheck found = check_orientation(reorient(cube, mistake));
                        // A face that looks the same from both sides may not be noticed, but is never named wrongly.
                        if (found.wrong || found.visible()) CHECK(found.closes == mistake);
                    }
                }
            }
        CHECK(skies >= 9);
    }

} // TEST_SUITE
