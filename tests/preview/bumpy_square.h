// A square with bumps as a high-poly mesh, over a quad as the low-poly one, and a scene with both.
#pragma once
#include "bake/base/text.h"
#include "bake/base/vec.h"
#include "cli/command.h"
#include <cmath>

namespace bake::test {

/// high.obj: 32 x 32 quads over [-0.5, 0.5]^2 in x and z whose height is a product of two sines with four periods along an edge.
/// low.obj: one quad; bare.obj: the same without uvs.
inline void write_bumpy_square(const Folder& folder, double amplitude = 0.02) {
    constexpr int n = 32;
    const double k = 8 * pi;
    std::string points, faces;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double u = double(i) / n, v = double(j) / n;
            const double height = amplitude * std::sin(k * u) * std::sin(k * v);
            const double along_x = amplitude * k * std::cos(k * u) * std::sin(k * v),
                         along_z = amplitude * k * std::sin(k * u) * std::cos(k * v);
            points += format("v %.9g %.9g %.9g\nvt %.9g %.9g\nvn %.9g 1 %.9g\n", u - 0.5, height, v - 0.5, u, 1 - v,
                             -along_x, -along_z);
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i + 1;
            faces += "f";
            for (const int b : {a, a + n + 1, a + n + 2, a + 1}) faces += format(" %d/%d/%d", b, b, b);
            faces += "\n";
        }
    write_file(folder / "high.obj", points + faces);
    const std::string corners = "v -0.5 0 -0.5\nv -0.5 0 0.5\nv 0.5 0 0.5\nv 0.5 0 -0.5\nvn 0 1 0\n";
    write_file(folder / "low.obj", corners + "vt 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
    write_file(folder / "bare.obj", corners + "f 1//1 2//1 3//1 4//1\n");
}

/// The square seen from `camera`, 48 x 32 pixels.
inline std::string bumpy_scene(const std::string& camera, const std::string& low = "low.obj", int map = 64) {
    return "[render]\nsize = [48, 32]\nexposure = -1\n[camera]\nposition = " + camera +
           "\ntarget = [0, 0, 0]\nfov-deg = 30\n[[light]]\ntype = \"directional\"\nfrom = [-0.3, 1, 0.4]\n"
           "[[material]]\nname = \"clay\"\ndiffuse = 0.6\n[[mesh]]\nname = \"square\"\nfile = \"" +
           low + "\"\nhigh = \"high.obj\" # 2048 triangles\nnormal-size = " + std::to_string(map) +
           "\nmaterial = \"clay\"\n";
}

inline constexpr const char* from_afar = "[0, 30, 20]";
inline constexpr const char* from_near = "[0, 1.5, 1.5]";
inline constexpr const char* at_a_grazing_angle = "[0, 0.12, 1.6]";

} // namespace bake::test
