#include "bake/relief/map/texel_row.h"
#include "bake/relief/map/normal_code.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int block = 64;   ///< texels of a block, whose values stay in the nearest cache
constexpr int together = 4; ///< texels of a run that are evaluated at once; the last ones may lie beyond the run
constexpr std::uint32_t frames = 2048; ///< triangles that are remembered from row to row

/// Values of a triangle that the loop needs per texel. The first `varying` of them are linear over the triangle.
enum Value {
    m = 0, ///< three each
    p_u = 3,
    p_v = 6,
    tangent = 9,
    varying = 12,
    m_u = 12,
    m_v = 15,
    sigma = 18,
    sign = 19,
    turn = 20, ///< m . (m_u x m_v), which is constant over the triangle
    values = 21
};

/// The values at corner 0, and what they change by along b1 and b2. All are 0 for a triangle that the loop cannot work
/// on. Each number is repeated, so that one vector instruction loads it.
struct TriangleFrame {
    std::uint32_t triangle = no_index;
    alignas(16) float at[values][together], along_b1[varying][together], along_b2[varying][together];
};

TriangleFrame empty_frame(std::uint32_t triangle) noexcept {
    TriangleFrame frame{}; // all zeros
    frame.triangle = triangle;
    return frame;
}

void repeat(float (&to)[together], float value) noexcept { std::fill_n(to, together, value); }

void set_frame(TriangleFrame& frame, const BakeTarget& target, std::uint32_t triangle) noexcept {
    const TrianglePatch<float> patch = triangle_patch<float>(target.surface, triangle);
    if (patch.sigma == 0 || patch.flat) {
        frame = empty_frame(triangle);
        return;
    }
    frame.triangle = triangle;
    const auto& corner = target.surface.triangles[triangle].corner;
    const auto set = [&](int value, const Vec3f& a0, const Vec3f& a1, const Vec3f& a2) {
        for (int c = 0; c < 3; ++c) {
            repeat(frame.at[value + c], a0[c]);
            repeat(frame.along_b1[value + c], a1[c] - a0[c]);
            repeat(frame.along_b2[value + c], a2[c] - a0[c]);
        }
    };
    const auto corner_tangent = [&](int k) { return Vec3f(target.tangents[corner[k]]); };
    set(m, patch.n[0], patch.n[1], patch.n[2]);
    set(p_u, patch.p_u[0], patch.p_u[1], patch.p_u[2]);
    set(p_v, patch.p_v[0], patch.p_v[1], patch.p_v[2]);
    set(tangent, corner_tangent(0), corner_tangent(1), corner_tangent(2));
    for (int c = 0; c < 3; ++c) repeat(frame.at[m_u + c], patch.m_u[c]), repeat(frame.at[m_v + c], patch.m_v[c]);
    repeat(frame.at[sigma], patch.sigma);
    repeat(frame.at[sign], target.tangents[corner[0]].w);
    repeat(frame.at[turn], glm::dot(patch.n[0], glm::cross(patch.m_u, patch.m_v)));
}

/// The values of a block's texels, an array per value.
struct TexelBlock {
    float b1[block + together], b2[block + together];
    float value[values][block + together];
    float b[block], b_u[block], b_v[block];
    float red[block], green[block], blue[block];
    int special[block]; ///< not 0: the loop has no result
};

/// Evaluates a run of texels in one triangle.
void set_run(TexelBlock& to, const TriangleFrame& frame, int first, int count) noexcept {
    for (int x = first; x < first + count; x += together) {
        float b1[together], b2[together];
        for (int i = 0; i < together; ++i) b1[i] = to.b1[x + i], b2[i] = to.b2[x + i];
        for (int v = 0; v < varying; ++v)
            for (int i = 0; i < together; ++i)
                to.value[v][x + i] = frame.at[v][i] + b1[i] * frame.along_b1[v][i] + b2[i] * frame.along_b2[v][i];
        for (int v = varying; v < values; ++v)
            for (int i = 0; i < together; ++i) to.value[v][x + i] = frame.at[v][i];
    }
}

struct Encoding {
    ConstantScale<float> scale;
    float half_green; ///< -1/2 where green points down
};

constexpr float zero_below = 1e-6f; ///< as to_tangent_space

/// The loop: see the header for the names.
template <NormalMethod method, Space space>
void normals(TexelBlock& block_, int count, const Encoding& encoding) noexcept {
    TexelBlock& t = block_;
    for (int i = 0; i < count; ++i) {
        const auto vector = [&](int value) {
            return Vec3f(t.value[value][i], t.value[value + 1][i], t.value[value + 2][i]);
        };
        const Vec3f M = vector(m), P_u = vector(p_u), P_v = vector(p_v);
        const float side = t.value[sigma][i], b_u = t.b_u[i], b_v = t.b_v[i];
        const float inverse = 1 / std::sqrt(glm::dot(M, M)), c = t.b[i] * inverse;
        const Vec3f W_u = P_u + c * vector(m_u), W_v = P_v + c * vector(m_v);
        const float flat_area = glm::dot(M, glm::cross(P_u, P_v)), area = glm::dot(M, glm::cross(W_u, W_v));
        const float other = flat_area + area - c * c * t.value[turn][i];

        Vec3f D;
        float A; // A / L
        if constexpr (method == NormalMethod::exact) {
            D = side * (b_u * W_v - b_v * W_u);
            A = side * area * inverse;
        } else if constexpr (method == NormalMethod::blinn) {
            D = side * (b_u * P_v - b_v * P_u);
            A = side * flat_area * inverse;
        } else {
            const float along = glm::dot(P_u, M) * inverse;
            const float per_length = 1 / std::sqrt(glm::dot(P_u, P_u) - along * along);
            D = (b_u / encoding.scale.u * inverse * per_length) * glm::cross(M, P_u) -
                (b_v / encoding.scale.v * side * per_length) * P_u;
            A = 1;
        }

        Vec3f r;
        if constexpr (space == Space::object) {
            r = A * M + glm::cross(M, D);
        } else {
            const Vec3f T = vector(tangent);
            const float skew = glm::dot(M, T), skew_share = skew * inverse * inverse;
            const float along_t = glm::dot(D, glm::cross(T, M));
            r.x = along_t;
            r.y = t.value[sign][i] * (glm::dot(D, T) - skew_share * glm::dot(D, M));
            r.z = A * (glm::dot(T, T) - skew * skew_share) - along_t * skew_share;
        }
        const float squared = glm::dot(r, r);
        r *= 1 / std::sqrt(squared);
        if constexpr (space == Space::tangent) {
            r.x = std::abs(r.x) < zero_below ? 0 : r.x;
            r.y = std::abs(r.y) < zero_below ? 0 : r.y;
        }
        t.red[i] = 0.5f * r.x + 0.5f;
        t.green[i] = encoding.half_green * r.y + 0.5f;
        t.blue[i] = 0.5f * r.z + 0.5f;
        const bool usual =
            (side * flat_area > 0) & (side * area > 0) & (side * other > 0) & (squared > 1e-30f) & (squared < 1e30f);
        t.special[i] = !usual;
    }
}

using Normals = void (*)(TexelBlock&, int, const Encoding&) noexcept;

template <Space space> Normals normals_by(NormalMethod method) noexcept {
    switch (method) {
    case NormalMethod::exact: return normals<NormalMethod::exact, space>;
    case NormalMethod::blinn:
    case NormalMethod::surface_gradient: break; // one direction, see displaced_normal.h
    case NormalMethod::constant_scale: return normals<NormalMethod::constant_scale, space>;
    }
    return normals<NormalMethod::blinn, space>;
}

/// One texel of the map before it is encoded; 0 where it has no normal.
struct Texel {
    Vec3f t{0};
    bool folded = false;
};

Texel bake_texel(const BakeTarget& target, const TexelHit& hit, const Height<float>& h,
                 const NormalMapOptions& options) noexcept {
    const TrianglePatch<float> patch = triangle_patch<float>(target.surface, hit.triangle);
    const Jet<float> jet = jet_at(patch, hit.b1, hit.b2);
    const bool folded = folds(jet, h.b);
    // Where the surface is inside out the exact normal points inwards; blinn's keeps the shading of the relief.
    const NormalMethod method = folded && options.method == NormalMethod::exact ? NormalMethod::blinn : options.method;
    const Vec3f normal = unit_or_zero(displaced_normal(jet, h, method, target.scale));
    if (options.space == Space::object || normal == Vec3f(0)) return {normal, folded};
    const auto& corner = target.surface.triangles[hit.triangle].corner;
    const float b[3] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
    Vec3f T(0), N(0);
    for (int k = 0; k < 3; ++k) T += b[k] * Vec3f(target.tangents[corner[k]]), N += b[k] * patch.n[k];
    return {to_tangent_space(normal, T, N, target.tangents[corner[0]].w), folded};
}

} // namespace

struct TexelRow::Room {
    Normals normals;
    Encoding encoding;
    TexelBlock block;
    TriangleFrame none = empty_frame(no_index);
    std::unique_ptr<TriangleFrame[]> ring{new TriangleFrame[frames]}; ///< only the triangles are initialised
    std::uint32_t oldest = 0;                                         ///< place in the ring of the next new triangle
    std::vector<std::uint16_t> above; ///< per column, the place in the ring of the last row's triangle

    /// The frame of the run of texels in columns [first, last). A triangle of the last row is found below its texels.
    const TriangleFrame& frame(const BakeTarget& target, std::uint32_t triangle, int first, int last) {
        if (triangle == no_index) return none;
        std::uint32_t place = frames;
        for (const int x : {first, last - 1, (first + last) / 2})
            if (ring[above[x]].triangle == triangle) place = above[x];
        if (place == frames) {
            place = oldest;
            oldest = (oldest + 1) % frames;
            set_frame(ring[place], target, triangle);
        }
        for (int x = first; x < last; ++x) above[x] = std::uint16_t(place);
        return ring[place];
    }
};

TexelRow::TexelRow(const BakeTarget& target, const NormalMapOptions& options)
    : target_(target), options_(options), room_(new Room) {
    room_->normals = options.space == Space::object ? normals_by<Space::object>(options.method)
                                                    : normals_by<Space::tangent>(options.method);
    room_->above.resize(std::size_t(target.raster.hits.width()));
    room_->encoding = {target.scale, options.directx ? -0.5f : 0.5f};
}

TexelRow::~TexelRow() = default;

void TexelRow::bake(int y, const Height<float>* heights, float* rgb, unsigned char* owned) {
    TexelBlock& texels = room_->block;
    const TexelHit* hits = target_.raster.hits.row(y);
    const int width = target_.raster.hits.width();
    for (int from = 0; from < width; from += block, hits += block, heights += block, rgb += 3 * block, owned += block) {
        const int count = std::min(block, width - from);
        for (int i = 0; i < count; ++i) {
            texels.b1[i] = hits[i].b1, texels.b2[i] = hits[i].b2;
            texels.b[i] = heights[i].b, texels.b_u[i] = heights[i].b_u, texels.b_v[i] = heights[i].b_v;
        }
        for (int first = 0, last; first < count; first = last) {
            for (last = first + 1; last < count && hits[last].triangle == hits[first].triangle;) ++last;
            set_run(texels, room_->frame(target_, hits[first].triangle, from + first, from + last), first,
                    last - first);
        }
        room_->normals(texels, count, room_->encoding);
        for (int i = 0; i < count; ++i) {
            rgb[3 * i] = texels.red[i], rgb[3 * i + 1] = texels.green[i], rgb[3 * i + 2] = texels.blue[i];
            owned[i] = 1;
        }
        for (int i = 0; i < count; ++i)
            if (texels.special[i]) bake_special(hits[i], heights[i], rgb + 3 * i, owned[i]);
    }
}

void TexelRow::bake_special(const TexelHit& hit, const Height<float>& height, float* rgb, unsigned char& owned) {
    Texel texel;
    if (hit.triangle != no_index) texel = bake_texel(target_, hit, height, options_);
    owned = texel.t != Vec3f(0);
    counts_.folded += texel.folded;
    counts_.degenerate += hit.triangle != no_index && !owned;
    const Vec3f encoded = encode_normal(owned ? texel.t : Vec3f(0, 0, 1), options_.directx);
    rgb[0] = encoded.x, rgb[1] = encoded.y, rgb[2] = encoded.z;
}

} // namespace bake
