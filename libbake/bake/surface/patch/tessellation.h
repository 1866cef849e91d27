// Splits one patch into faces: a lattice inside, and strips of triangles between the lattice and sides that have
// other rates.
//
//   quad      corners (0,0) (1,0) (1,1) (0,1), sides from each to the next
//   triangle  corners (0,0) (1,0) (0,1)
#pragma once
#include "bake/mesh/mesh.h"
#include <array>
#include <functional>
#include <span>

namespace bake {

/// Segments of the sides and of the lattice inside.
struct PatchRates {
    int sides = 4;
    std::array<std::uint32_t, 4> side{1, 1, 1, 1};
    std::uint32_t across = 1, up = 1; ///< of the lattice, along s and t; a triangle's are equal
};

enum class PatchPattern {
    lattice, ///< sides and lattice agree: quads on quads, triangles on triangles
    ladder,  ///< two opposite sides of one segment each: a strip between the other two
    fan,     ///< no points inside, sides of one or two segments: all faces share the middle of one side
    strips,  ///< a lattice inside, at least one point of it, and a strip along each side
};
PatchPattern pattern(const PatchRates& rates) noexcept;

/// The rates, with the lattice inside replaced by the nearest one that some pattern can connect to the sides.
PatchRates fitted(PatchRates rates) noexcept;

/// Points of the lattice strictly inside the patch; none in ladders and fans.
std::uint32_t inner_points(const PatchRates& rates) noexcept;

/// One corner of a face: indices of the mesh.
struct FaceCorner {
    std::uint32_t position, normal, uv;
};

/// Points on the border: side i runs from corner i to the next, both included.
struct PatchRing {
    std::array<std::span<const FaceCorner>, 4> side;
};

/// Writes faces into arrays that have their final size, from a given face and corner on. Corners whose predecessor has the
/// same position are left out, and so are faces with fewer than three other corners: a quad at a pole becomes a triangle.
class FaceWriter {
public:
    FaceWriter(Mesh& mesh, std::uint64_t face, std::uint64_t corner) noexcept;
    void quad(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c, const FaceCorner& d) noexcept {
        if (a.position == b.position || b.position == c.position || c.position == d.position ||
            d.position == a.position)
            return polygon({a, b, c, d});
        put(a), put(b), put(c), put(d);
        close();
    }
    void triangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c) noexcept {
        if (a.position == b.position || b.position == c.position || c.position == a.position) return;
        put(a), put(b), put(c);
        close();
    }
    std::uint64_t faces() const noexcept { return face_; }
    std::uint64_t corners() const noexcept { return corner_; }

private:
    void polygon(std::array<FaceCorner, 4> corners) noexcept;
    void put(const FaceCorner& c) noexcept {
        position_[corner_] = c.position;
        normal_[corner_] = c.normal;
        if (uv_) uv_[corner_] = c.uv;
        ++corner_;
    }
    void close() noexcept { begin_[++face_] = std::uint32_t(corner_); }

    std::uint32_t *begin_, *position_, *normal_, *uv_;
    std::uint64_t face_, corner_;
};

/// Counts the faces and corners that a FaceWriter would write.
class FaceCounter {
public:
    void quad(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c, const FaceCorner& d) noexcept {
        const int different = (a.position != b.position) + (b.position != c.position) + (c.position != d.position) +
                              (d.position != a.position);
        if (different >= 3) ++faces, corners += std::uint64_t(different);
    }
    void triangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c) noexcept {
        if (a.position != b.position && b.position != c.position && c.position != a.position) ++faces, corners += 3;
    }
    std::uint64_t faces = 0, corners = 0;
};

/// Calls a function with the three or four positions of every face.
class FaceVisitor {
public:
    using Visit = std::function<void(std::span<const std::uint32_t>)>;
    explicit FaceVisitor(Visit visit) : visit_(std::move(visit)) {}
    void quad(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c, const FaceCorner& d) const {
        visit_(std::array{a.position, b.position, c.position, d.position});
    }
    void triangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c) const {
        visit_(std::array{a.position, b.position, c.position});
    }

private:
    Visit visit_;
};

/// Faces of a patch with fitted rates, to any sink with quad() and triangle(). Inner points are numbered row by row
/// from `inner` on, in all three indices.
template <class Sink> void emit_faces(const PatchRates& rates, const PatchRing& ring, std::uint32_t inner, Sink& sink);

/// Rows [first, last) of a quad patch of pattern lattice, of rates.up rows in all.
template <class Sink>
void emit_rows(const PatchRates& rates, const PatchRing& ring, std::uint32_t inner, std::uint32_t first,
               std::uint32_t last, Sink& sink);

} // namespace bake
