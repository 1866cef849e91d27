#include "bake/environment/filter/convolve.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bake {
namespace {

constexpr int tile_directions = 64;

/// A square of output texels: their directions, and a bounding sphere of these.
struct DirectionTile {
    int face, x0, y0, width, height, count = 0;
    float nx[tile_directions], ny[tile_directions], nz[tile_directions];
    Vec3f centre;
    float radius = 0;
};

/// Sums over sources, for each direction of a tile.
struct Sums {
    float white[tile_directions];
    float light[max_sky_channels][tile_directions];
};

/// Result of a traversal: texels, and nodes that are used as a whole.
struct Sources {
    std::vector<SkyNode> texels, nodes;
};

DirectionTile tile_at(int face, int x0, int y0, int edge, int size) {
    DirectionTile tile{face, x0, y0, std::min(edge, size - x0), std::min(edge, size - y0)};
    Vec3d sum(0.0);
    for (int y = y0; y < y0 + tile.height; ++y)
        for (int x = x0; x < x0 + tile.width; ++x) {
            const Vec3d n = glm::normalize(
                cube_direction(CubePoint<double>{static_cast<CubeFace>(face), (x + 0.5) / size, (y + 0.5) / size}));
            sum += n;
            tile.nx[tile.count] = float(n.x), tile.ny[tile.count] = float(n.y), tile.nz[tile.count++] = float(n.z);
        }
    tile.centre = Vec3f(glm::normalize(sum));
    for (int k = 0; k < tile.count; ++k)
        tile.radius = std::max(tile.radius, glm::length(Vec3f(tile.nx[k], tile.ny[k], tile.nz[k]) - tile.centre));
    return tile;
}

/// Decides whether a tile may use a node as a whole.
template <class Lobe> class Opening {
public:
    Opening(const RadianceTree& tree, const Lobe& lobe, const ConvolveOptions& options)
        : lobe_(lobe), widest_(options.node_width * width_of(lobe)),
          // Bounds the error of the kink at the horizon, integrated along the horizon, relative to the integral of the lobe.
          widest_at_horizon_(options.node_width * 0.25f *
                             float(std::sqrt(lobe.integral() / (3.2 * double(lobe.horizon_slope()) + 1e-30)))),
          allowed_(options.tolerance * float(tree.mean() * lobe.integral())) {}

    /// `near` and `far`: bounds of the chord lengths between the node's texels and the tile's directions.
    bool takes_whole(const SkyNode& node, float near, float far) const noexcept {
        constexpr float widest_expansion = 0.4f;
        const float t = near * near / 2, K = lobe_.at(t);
        const bool straddles_horizon = far * far / 2 > 1;
        // Nodes may grow where the lobe is small: by K^(-1/4) the error would be equal in each part of the lobe, by K^(-1/2)
        // in each part of the sky; the exponent is between these.
        const float widest =
            std::min(straddles_horizon ? widest_at_horizon_ : widest_expansion, widest_ / std::pow(K, 0.3f));
        if (2 * node.rho > widest) return false;
        float error = K * lobe_.slope(t) * node.Q;
        if (straddles_horizon) error += lobe_.horizon_slope() * node.Q / (4 * std::sqrt(3 * node.h));
        return error <= allowed_;
    }

private:
    Lobe lobe_;
    float widest_, widest_at_horizon_, allowed_;
};

template <class Lobe>
void find_sources(const RadianceTree& tree, const Opening<Lobe>& opening, const DirectionTile& tile, Sources& found) {
    struct NodeIndex {
        int level, face, x, y;
    };
    found.texels.clear(), found.nodes.clear();
    std::vector<NodeIndex> open;
    for (int face = 5; face >= 0; --face) open.push_back({tree.last_level(), face, 0, 0});
    while (!open.empty()) {
        const NodeIndex at = open.back();
        open.pop_back();
        const SkyNode node = tree.node(at.level, at.face, at.x, at.y);
        const float apart = glm::length(node.d - tile.centre), reach = tile.radius + node.rho;
        const float near = std::max(apart - reach, 0.0f);
        if (near * near / 2 >= 1) continue; // below the horizon of every direction
        if (at.level == 0) {
            found.texels.push_back(node);
        } else if (at.level == tree.finest() || opening.takes_whole(node, near, apart + reach)) {
            found.nodes.push_back(node);
        } else {
            const int n = tree.size(at.level - 1);
            for (int y = std::min(2 * at.y + 1, n - 1); y >= 2 * at.y; --y)
                for (int x = std::min(2 * at.x + 1, n - 1); x >= 2 * at.x; --x)
                    open.push_back({at.level - 1, at.face, x, y});
        }
    }
}

template <class Lobe>
void add_texels(const std::vector<SkyNode>& texels, const Lobe& lobe, const DirectionTile& tile, int channels,
                Sums& sums) noexcept {
    float K[tile_directions];
    for (const SkyNode& s : texels) {
        for (int k = 0; k < tile.count; ++k) {
            const float x = tile.nx[k] - s.d.x, y = tile.ny[k] - s.d.y, z = tile.nz[k] - s.d.z;
            K[k] = lobe.at(0.5f * (x * x + y * y + z * z));
            sums.white[k] += s.omega * K[k];
        }
        for (int c = 0; c < channels; ++c)
            for (int k = 0; k < tile.count; ++k) sums.light[c][k] += s.F[c] * K[k];
    }
}

template <class Lobe>
void add_nodes(const std::vector<SkyNode>& nodes, const Lobe& lobe, const DirectionTile& tile, int channels,
               Sums& sums) noexcept {
    float K[tile_directions], K1[tile_directions];
    for (const SkyNode& s : nodes) {
        // Of a single texel, at the border of a level of odd size, the variance is 0, or a hair below by rounding.
        const float r = std::sqrt(std::max(3 * s.h, 1e-12f)), half_h = 0.5f * s.h;
        for (int k = 0; k < tile.count; ++k) {
            const float x = tile.nx[k] - s.d.x, y = tile.ny[k] - s.d.y, z = tile.nz[k] - s.d.z;
            const float t = 0.5f * (x * x + y * y + z * z) + s.h;
            const LobeValue value = lobe.at(t, r);
            // The variance of the cosine over the node is h times the squared sine.
            K[k] = value.K + value.K2 * half_h * t * (2 - t);
            K1[k] = value.K1;
            sums.white[k] += s.omega * K[k];
        }
        for (int c = 0; c < channels; ++c) {
            const Vec3f D = s.D[c];
            for (int k = 0; k < tile.count; ++k)
                sums.light[c][k] += s.F[c] * K[k] + K1[k] * (D.x * tile.nx[k] + D.y * tile.ny[k] + D.z * tile.nz[k]);
        }
    }
}

/// The mean of the sky under the lobe of direction k, clamped to the range of the sky.
template <class Lobe>
float mean_light(const RadianceTree& tree, const Lobe& lobe, const DirectionTile& tile, const Sums& sums, int k, int c,
                 bool integral_known) noexcept {
    const float light = sums.light[c][k], white = sums.white[k];
    if (white < std::numeric_limits<float>::min()) // no texel centre is in the lobe
        return tree.texel_at(Vec3f(tile.nx[k], tile.ny[k], tile.nz[k]), c);
    float mean = light / white;
    if (integral_known) {
        // The error of the sum for a white sky is that of the even part of this sky; suns are summed exactly.
        const float integral = float(lobe.integral());
        mean = (light + (integral - white) * float(tree.even_level(c))) / integral;
    }
    return std::clamp(mean, tree.least(c), tree.most(c));
}

} // namespace

int finest_level_for(int sky_size, float lobe_width) noexcept {
    int level = 0;
    while (sky_size >> (level + 1) >= 512 && 8 * 2.0f / float(sky_size >> (level + 1)) <= lobe_width) ++level;
    return level;
}

template <class Lobe>
Cube convolve(const RadianceTree& tree, const Lobe& lobe, int size, const ConvolveOptions& options,
              Progress* progress) {
    const int channels = tree.channels();
    // Tiles are not much wider than the lobe, so that few nodes are subdivided for only a few directions of a tile.
    int edge = 8;
    while (edge > 2 && 2.0f * float(edge) / float(size) > 4 * width_of(lobe)) edge /= 2;
    const int tiles = (size + edge - 1) / edge;
    const Opening<Lobe> opening(tree, lobe, options);
    // A sum over texels reproduces the integral of a lobe that is wider than a texel: by the spectrum of GGX to
    // exp(-2 sqrt 2 pi 1.2) = 2e-5 at the widest texel, of 2 / size.
    const bool integral_known = width_of(lobe) > 1.2f * 2 / float(tree.size(0));

    Cube out = make_cube(size, channels);
    const std::int64_t all = std::int64_t(6) * tiles * tiles;
    if (progress) progress->start("filter", all);
    const auto fill = [&](std::int64_t begin, std::int64_t end) {
        Sources found;
        for (std::int64_t i = begin; i < end; ++i) {
            const int face = int(i / (tiles * tiles)), x0 = int(i % tiles) * edge, y0 = int(i / tiles % tiles) * edge;
            const DirectionTile tile = tile_at(face, x0, y0, edge, size);
            find_sources(tree, opening, tile, found);
            Sums sums{};
            add_nodes(found.nodes, lobe, tile, channels, sums);
            add_texels(found.texels, lobe, tile, channels, sums);
            for (int k = 0; k < tile.count; ++k) {
                const int x = tile.x0 + k % tile.width, y = tile.y0 + k / tile.width;
                for (int c = 0; c < channels; ++c)
                    out.faces[tile.face].at(x, y, c) = mean_light(tree, lobe, tile, sums, k, c, integral_known);
            }
        }
    };
    for_rows(all, 1, fill, progress);
    return out;
}

template Cube convolve(const RadianceTree&, const GgxLobe&, int, const ConvolveOptions&, Progress*);
template Cube convolve(const RadianceTree&, const PhongLobe&, int, const ConvolveOptions&, Progress*);

} // namespace bake
