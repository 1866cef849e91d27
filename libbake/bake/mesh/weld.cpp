#include "bake/mesh/weld.h"
#include "bake/base/parallel.h"
#include <bit>

namespace bake {
namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

struct Slot {
    std::uint32_t hash = 0;
    std::uint32_t corner = nobody; // the first corner of the vertex
};

std::uint64_t two(float a, float b) noexcept {
    // Adding 0 turns -0 into 0, which compare equal but differ in their bits.
    return std::uint64_t(std::bit_cast<std::uint32_t>(a + 0.0f)) << 32 | std::bit_cast<std::uint32_t>(b + 0.0f);
}

std::uint64_t stir(std::uint64_t h) noexcept {
    h *= 0x9e3779b97f4a7c15u;
    return h ^ h >> 32;
}

std::uint32_t hash_of(const Vec3f& p, const Vec3f& n, const Vec2f& uv) noexcept {
    const std::uint64_t position = stir(stir(two(p.x, p.y)) ^ two(p.z, n.x));
    const std::uint64_t rest = stir(stir(two(n.y, n.z)) + two(uv.x, uv.y));
    return std::uint32_t(stir(position ^ std::rotl(rest, 29)));
}

// Open addressing with linear steps; it holds one slot per vertex and is never more than half full.
std::vector<Slot> grown(const std::vector<Slot>& table) {
    std::vector<Slot> larger(table.size() * 2);
    const std::size_t mask = larger.size() - 1;
    for (const Slot& slot : table) {
        if (slot.corner == nobody) continue;
        std::size_t at = slot.hash & mask;
        while (larger[at].corner != nobody) at = (at + 1) & mask;
        larger[at] = slot;
    }
    return larger;
}

} // namespace

Weld weld_corners(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<const Vec2f> uvs) {
    const std::size_t corners = positions.size();
    Weld weld;
    weld.vertex.resize(corners);

    // The hashes wait where the answers go.
    for_rows(std::int64_t(corners), 16384, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t c = begin; c < end; ++c) weld.vertex[c] = hash_of(positions[c], normals[c], uvs[c]);
    });

    // A closed triangle mesh has six corners per vertex: start with room for that many.
    std::vector<Slot> table(std::bit_ceil(corners / 3 + 16));
    for (std::size_t c = 0; c < corners; ++c) {
        if (c + 16 < corners) __builtin_prefetch(&table[weld.vertex[c + 16] & (table.size() - 1)]);
        const std::uint32_t hash = weld.vertex[c];
        std::size_t at = hash & (table.size() - 1);
        for (;; at = (at + 1) & (table.size() - 1)) {
            Slot& slot = table[at];
            if (slot.corner == nobody) {
                slot = {hash, std::uint32_t(c)};
                weld.vertex[c] = weld.vertices++;
                if (std::size_t(weld.vertices) * 2 > table.size()) table = grown(table);
                break;
            }
            const std::uint32_t first = slot.corner;
            if (slot.hash == hash && positions[first] == positions[c] && normals[first] == normals[c] &&
                uvs[first] == uvs[c]) {
                weld.vertex[c] = weld.vertex[first];
                break;
            }
        }
    }
    return weld;
}

std::vector<std::uint32_t> first_equal(std::span<const Vec3f> positions) {
    const std::size_t count = positions.size();
    Weld weld = weld_corners(positions, std::vector<Vec3f>(count), std::vector<Vec2f>(count));
    // Vertices are numbered in order of first use, so each is met for the first time at its first position.
    std::vector<std::uint32_t> first;
    first.reserve(weld.vertices);
    for (std::uint32_t p = 0; p < count; ++p) {
        if (weld.vertex[p] == first.size()) first.push_back(p);
        weld.vertex[p] = first[weld.vertex[p]];
    }
    return std::move(weld.vertex);
}

void weld_positions(Mesh& mesh) {
    const std::vector<std::uint32_t> first = first_equal(mesh.positions);
    for (std::uint32_t& p : mesh.corner_position) p = first[p];
}

} // namespace bake
