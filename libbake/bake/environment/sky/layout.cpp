#include "bake/environment/sky/layout.h"
#include "bake/base/error.h"
#include <algorithm>
#include <array>

namespace bake {
namespace {

/// One cell of a layout: its column and row, and the face in it with the turns that the layout gives the face.
struct Cell {
    int column, row;
    TurnedFace face;
};
struct Grid {
    int columns, rows;
    std::array<Cell, 6> cells;
};

Grid grid(CubeLayout layout, FaceOrder order) noexcept {
    using F = CubeFace;
    switch (layout) {
    case CubeLayout::hcross:
        return {4,
                3,
                {{{1, 0, {F::py, 0}},
                  {0, 1, {F::nx, 0}},
                  {1, 1, {F::pz, 0}},
                  {2, 1, {F::px, 0}},
                  {3, 1, {F::nz, 0}},
                  {1, 2, {F::ny, 0}}}}};
    case CubeLayout::vcross:
        return {3,
                4,
                {{{1, 0, {F::py, 0}},
                  {0, 1, {F::nx, 0}},
                  {1, 1, {F::pz, 0}},
                  {2, 1, {F::px, 0}},
                  {1, 2, {F::ny, 0}},
                  {1, 3, {F::nz, 2}}}}};
    case CubeLayout::strip:
    case CubeLayout::hstrip: break;
    }
    const bool down = layout == CubeLayout::strip;
    Grid strip{down ? 1 : 6, down ? 6 : 1, {}};
    for (int k = 0; k < 6; ++k) strip.cells[k] = {down ? 0 : k, down ? k : 0, face_at(order, k)};
    return strip;
}

void copy(const Image<float>& from, int from_x, int from_y, Image<float>& to, int to_x, int to_y, int n) {
    for (int y = 0; y < n; ++y)
        std::copy_n(&from.at(from_x, from_y + y), std::size_t(n) * from.channels(), &to.at(to_x, to_y + y));
}

} // namespace

TurnedFace face_at(FaceOrder order, int k) noexcept {
    using F = CubeFace;
    constexpr TurnedFace openexr[6] = {{F::nx, 0}, {F::px, 0}, {F::py, 2}, {F::ny, 2}, {F::pz, 0}, {F::nz, 0}};
    return order == FaceOrder::openexr ? openexr[k] : TurnedFace{all_cube_faces[k], 0};
}

Image<float> turned(const Image<float>& face, int quarter_turns) {
    const int n = face.width(), turns = ((quarter_turns % 4) + 4) % 4;
    Image<float> result(n, n, face.channels());
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            // One quarter turn moves the right side to the top.
            const int from_x = turns == 0 ? x : turns == 1 ? n - 1 - y : turns == 2 ? n - 1 - x : y;
            const int from_y = turns == 0 ? y : turns == 1 ? x : turns == 2 ? n - 1 - y : n - 1 - x;
            std::copy_n(&face.at(from_x, from_y), face.channels(), &result.at(x, y));
        }
    return result;
}

Cube cut_faces(const Image<float>& picture, CubeLayout layout, FaceOrder order, const std::string& file) {
    const Grid cells = grid(layout, order);
    const int n = picture.width() / cells.columns;
    if (n < 1 || n * cells.columns != picture.width() || n * cells.rows != picture.height())
        throw Error(Refusal::unsuitable, file + ": is " + std::to_string(picture.width()) + "x" +
                                             std::to_string(picture.height()) + "; this layout has " +
                                             std::to_string(cells.columns) + "x" + std::to_string(cells.rows) +
                                             " square faces; name another format in `from`");
    Cube cube = make_cube(n, picture.channels());
    for (const Cell& cell : cells.cells) {
        Image<float>& face = cube[cell.face.face];
        copy(picture, cell.column * n, cell.row * n, face, 0, 0, n);
        if (cell.face.turns) face = turned(face, -cell.face.turns);
    }
    return cube;
}

Image<float> paste_faces(const Cube& cube, CubeLayout layout, FaceOrder order) {
    const Grid cells = grid(layout, order);
    const int n = cube.size();
    Image<float> picture(n * cells.columns, n * cells.rows, cube.channels());
    if (layout == CubeLayout::hcross || layout == CubeLayout::vcross) std::fill_n(picture.data(), picture.size(), 0.0f);
    for (const Cell& cell : cells.cells) {
        const Image<float>& face = cube[cell.face.face];
        if (cell.face.turns) copy(turned(face, cell.face.turns), 0, 0, picture, cell.column * n, cell.row * n, n);
        else copy(face, 0, 0, picture, cell.column * n, cell.row * n, n);
    }
    return picture;
}

} // namespace bake
