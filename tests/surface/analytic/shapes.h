// Analytic shapes of every kind for tests, with the files of `revolution` and `bezier`.
#pragma once
#include "bake/base/text.h"
#include "bake/surface/analytic/parametric.h"
#include "mesh/file/mesh_files.h"
#include <numbers>

namespace bake_tests {

/// Profiles: a vase with its foot on the axis, open above; a drop, closed at both ends; the section of a ring.
inline const char* const vase = "# radius height\n0 0\n0.5 0\n0.7 0.4\n0.4 0.9\n0.3 1.2\n0.45 1.4\n";
inline const char* const drop = "0 -1\n0.8 -0.6\n0.9 0\n0.5 0.7\n0 1.1\n";
inline const char* const ring = "1.4 0\n1.1 0.35\n0.6 0.2\n0.7 -0.3\n1.2 -0.3\n1.4 0\n";

/// Eight patches that approximate a unit sphere. Two borders of each are quarters of great circles, one is a pole. Tangents
/// across the borders are perpendicular to the planes of symmetry, so that the surface is smooth there.
inline std::string octants() {
    const double k = 4.0 / 3 * (std::numbers::sqrt2 - 1);
    // A quarter circle from the equator up, and one from x to -z.
    const double up[4][2] = {{1, 0}, {1, k}, {k, 1}, {0, 1}}, round[4][2] = {{1, 0}, {1, k}, {k, 1}, {0, 1}};
    std::string text = "8\n";
    for (int half = 0; half < 2; ++half)
        for (int q = 0; q < 4; ++q)
            for (int row = 0; row < 4; ++row)
                for (int i = 0; i < 4; ++i) {
                    const auto& level = up[half == 0 ? row : 3 - row];
                    const double c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};
                    const double x = c[q] * round[i][0] - s[q] * round[i][1],
                                 z = s[q] * round[i][0] + c[q] * round[i][1];
                    text += bake::format("%.17g %.17g %.17g\n", level[0] * x, half == 0 ? level[1] : -level[1],
                                         -level[0] * z);
                }
    return text;
}

/// One patch without any symmetry.
inline std::string sheet() {
    std::string text = "1\n";
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            text += bake::format("%g %g %g\n", i + 0.3 * ((i * 7 + j * 3) % 4), 0.5 * ((i * 5 + j * 11) % 7),
                                 -j + 0.2 * ((i * 3 + j) % 5));
    return text;
}

struct Shapes {
    TemporaryFolder folder;
    std::string vase_file = folder.write("vase.txt", vase), drop_file = folder.write("drop.txt", drop),
                ring_file = folder.write("ring.txt", ring), octants_file = folder.write("octants.txt", octants()),
                sheet_file = folder.write("sheet.txt", sheet());

    std::vector<std::string> closed() const {
        return {"sphere:R=1.3",
                "ellipsoid:a=1,b=0.6,c=0.8",
                "torus:R=2,r=0.7",
                "superellipsoid:e1=0.6,e2=0.8",
                "revolution:profile=" + drop_file,
                "revolution:profile=" + ring_file,
                "bezier:file=" + octants_file};
    }
    std::vector<std::string> open() const {
        return {"plane:w=2,d=3",
                "disc:R=1.5",
                "cylinder:R=0.7,h=3",
                "cone:R=1,h=1.5",
                "cone:R=1,h=1.5,r=0.4",
                "helicoid:R=1.2,h=2,turns=1.5",
                "saddle:R=1,h=0.4",
                "revolution:profile=" + vase_file,
                "revolution:pointed=1,profile=" + drop_file,
                "bezier:flip=1,file=" + sheet_file};
    }
    static std::vector<std::string> one_sided() { return {"moebius:R=1,w=0.8", "klein:R=1,r=0.4"}; }
    std::vector<std::string> all() const {
        std::vector<std::string> out = closed();
        for (const auto& more : {open(), one_sided()}) out.insert(out.end(), more.begin(), more.end());
        return out;
    }
};

} // namespace bake_tests
