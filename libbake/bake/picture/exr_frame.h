// What reading and writing OpenEXR share.
#pragma once
#include <OpenEXR/ImfFrameBuffer.h>
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

inline constexpr const char *exr_cube_format = "CubeFace Environment", *exr_latlong_format = "LatLong Environment";

/// Sets the number of OpenEXR's own threads that help the one that calls it, and returns it: 0 if not all can be started.
int exr_helpers();

/// Slices of interleaved samples, of which `first` is the one at the window's upper left corner.
template <class Sample>
Imf::FrameBuffer frame_of(const Sample* first, const std::vector<std::string>& channels, int x, int y, int width) {
    const std::size_t step = channels.size() * sizeof(Sample), row = step * std::size_t(width);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        // The library adds the coordinates back; as numbers, for the origin may lie outside the memory.
        const auto origin = reinterpret_cast<std::uintptr_t>(first + c) -
                            std::uintptr_t(std::int64_t(x) * std::int64_t(step) + std::int64_t(y) * std::int64_t(row));
        frame.insert(channels[c], Imf::Slice(sizeof(Sample) == 2 ? Imf::HALF : Imf::FLOAT,
                                             reinterpret_cast<char*>(origin), step, row));
    }
    return frame;
}

} // namespace bake
