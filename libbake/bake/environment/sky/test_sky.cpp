#include "bake/environment/sky/test_sky.h"
#include <cstdint>
#include <string_view>

namespace bake {
namespace {

/// Letters of 5 x 7 cells, rows from the top, the highest of 5 bits at the left.
struct Letter {
    char name;
    std::uint8_t rows[7];
};
constexpr Letter letters[] = {
    {'+', {0b00000, 0b00100, 0b00100, 0b11111, 0b00100, 0b00100, 0b00000}},
    {'-', {0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000}},
    {'X', {0b10001, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0b10001}},
    {'Y', {0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100}},
    {'Z', {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b11111}},
    {'p', {0b00000, 0b00000, 0b11110, 0b10001, 0b11110, 0b10000, 0b10000}},
    {'n', {0b00000, 0b00000, 0b10110, 0b11001, 0b10001, 0b10001, 0b10001}},
    {'x', {0b00000, 0b00000, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001}},
    {'y', {0b00000, 0b00000, 0b10001, 0b10001, 0b01111, 0b00001, 0b01110}},
    {'z', {0b00000, 0b00000, 0b11111, 0b00010, 0b00100, 0b01000, 0b11111}},
};

/// Whether the text, its letters 6 cells apart, covers the point (x, y) in cells from its upper left corner.
bool covers(std::string_view text, double x, double y) noexcept {
    if (x < 0 || y < 0 || y >= 7) return false;
    const auto at = std::size_t(x / 6);
    const int column = int(x) % 6, row = int(y);
    if (at >= text.size() || column > 4) return false;
    for (const Letter& letter : letters)
        if (letter.name == text[at]) return letter.rows[row] >> (4 - column) & 1;
    return false;
}

/// The same for text centred at (cx, cy), with cells of size `cell` in units of the face.
bool covers_at(std::string_view text, double s, double t, double cx, double cy, double cell) noexcept {
    const double width = 6.0 * double(text.size()) - 1;
    return covers(text, (s - cx) / cell + width / 2, (t - cy) / cell + 3.5);
}

/// An arrow from (0, 0) to (1, 0), for a point (along, across) in units of the arrow's length.
bool covers_arrow(double along, double across) noexcept {
    const double off = across < 0 ? -across : across;
    if (along < 0 || along > 1) return false;
    return along < 0.6 ? off < 0.07 : off < 0.45 * (1 - along);
}

const char* axis_of(const Vec3f& d) noexcept {
    if (d.x != 0) return d.x > 0 ? "+X" : "-X";
    if (d.y != 0) return d.y > 0 ? "+Y" : "-Y";
    return d.z > 0 ? "+Z" : "-Z";
}

} // namespace

Cube label_sky(int n) {
    constexpr float white[3] = {1, 1, 1};
    // The two faces of an axis have complementary colours.
    constexpr float colours[6][3] = {{0.45f, 0.06f, 0.06f}, {0.06f, 0.35f, 0.35f}, {0.08f, 0.4f, 0.08f},
                                     {0.35f, 0.06f, 0.35f}, {0.08f, 0.1f, 0.5f},   {0.4f, 0.38f, 0.05f}};
    Cube cube = make_cube(n, 3);
    for (const CubeFace face : all_cube_faces) {
        const int index = int(face);
        const auto direction = [&](float s, float t) { return cube_direction(CubePoint<float>{face, s, t}); };
        const Vec3f middle = direction(0.5f, 0.5f);
        const char *self = axis_of(middle), *right = axis_of(direction(1, 0.5f) - middle),
                   *down = axis_of(direction(0.5f, 1) - middle);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const double s = (x + 0.5) / n, t = (y + 0.5) / n;
                const bool line = x * 8 % n < 8 || y * 8 % n < 8, corner = s < 1.0 / 16 && t < 1.0 / 16;
                const bool text = covers_at(self, s, t, 0.5, 0.42, 0.045) ||
                                  covers_at(cube_face_names[index], s, t, 0.5, 0.7, 0.018) ||
                                  covers_at(right, s, t, 0.86, 0.42, 0.014) ||
                                  covers_at(down, s, t, 0.5, 0.93, 0.014) ||
                                  covers_arrow((s - 0.8) / 0.16, (t - 0.5) / 0.16) ||
                                  covers_arrow((t - 0.8) / 0.16 + 0.25, (s - 0.42) / 0.16);
                const float shade = (text || corner ? 1.0f : line ? 1.6f : 1.0f) * ((x + y) % 2 ? 1.0f : 0.96f);
                const float* colour = text || corner ? white : colours[index];
                for (int c = 0; c < 3; ++c) cube[face].at(x, y, c) = colour[c] * shade;
            }
    }
    return cube;
}

} // namespace bake
