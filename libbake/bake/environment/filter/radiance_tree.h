// A sky as a quadtree of light sources.
//
// A node approximates the texels below it, each a source at its centre d_k with solid angle omega_k and flux
// F_k = L_k omega_k, by
//   omega = sum omega_k      d = sum omega_k d_k / omega      h = (1 - |d|^2) / 2, the variance of d_k along one axis
//   F = sum F_k              D = sum F_k (d_k - d), the first moment of the flux about d, per channel
//   Q = sum |F_k - (F / omega) omega_k| |d_k - d|^2 approximately, the unevenness of the flux, per node
// For a kernel K(n . d) that is smooth across the node the flux is F K + K' n . D plus the second moment of an even node; Q
// bounds the error. Nodes of even radiance can therefore be used as a whole, and nodes with a sun are subdivided.
#pragma once
#include "bake/environment/sky/cube.h"
#include <cstdint>
#include <vector>

namespace bake {

inline constexpr int max_sky_channels = 4;

/// A node's values, as above; rho is the largest |d_k - d|.
struct SkyNode {
    float omega, h, rho, Q;
    Vec3f d;
    float F[max_sky_channels];
    Vec3f D[max_sky_channels];
};

/// Level 0 is the texels themselves, level l >= 1 has ceil(size / 2^l) nodes along an edge, the last has one per face.
/// Levels below `finest` are not stored but computed when needed. The sky must outlive the tree.
class RadianceTree {
public:
    /// `sky` is finite and not empty, with 1 to 4 channels. Level 0 is never stored. Memory at three channels: 25 bytes per
    /// texel, a quarter of that for finest = 2, a sixteenth for 3.
    explicit RadianceTree(const Cube& sky, int finest = 0);

    int channels() const noexcept { return channels_; }
    int last_level() const noexcept { return int(levels_.size()); }
    int finest() const noexcept { return finest_; }
    int size(int level) const noexcept; ///< nodes along an edge
    /// Node (x, y) of a face. Level 0: h, rho, Q and D are 0.
    SkyNode node(int level, int face, int x, int y) const noexcept;
    /// Radiance of a channel in the texel that contains a direction.
    float texel_at(const Vec3f& d, int channel) const noexcept;
    /// Mean of |L| over the sphere, the largest of the channels.
    double mean() const noexcept { return mean_; }
    /// Mean radiance of a channel over the sky without its suns, the texels above four times the mean of |L|.
    double even_level(int channel) const noexcept { return even_level_[channel]; }
    float least(int channel) const noexcept { return least_[channel]; } ///< smallest radiance of a channel
    float most(int channel) const noexcept { return most_[channel]; }   ///< largest

private:
    SkyNode texel(int face, int x, int y) const noexcept;
    SkyNode from_children(int level, int face, int x, int y) const noexcept;

    struct Level {
        int size;
        std::vector<float>
            values; ///< stride_ values per node, face by face, row by row; empty for levels below finest_
    };
    const Cube& sky_;
    int channels_, stride_, finest_;
    double mean_ = 0, even_level_[max_sky_channels] = {};
    float least_[max_sky_channels] = {}, most_[max_sky_channels] = {};
    std::vector<float> omega_; ///< of the texels of a face
    std::vector<Level> levels_;
};

} // namespace bake
