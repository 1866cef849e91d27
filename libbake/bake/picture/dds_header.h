// The header of a texture, DDS or KTX2: what it says of its texels, and whether all of them are there.
#pragma once
#include "bake/picture/picture_file.h"
#include <vector>

namespace bake {

/// What texels consist of.
enum class TexelCode {
    samples, ///< of one type, or by masks; or blocks that are not read here
    bc5,     ///< in its unsigned form
    bc6h,    ///< the same
    rgb9e5,
};

struct DdsHeader {
    std::int64_t width = 0, height = 0; ///< of the largest level of one face
    std::int64_t levels = 1;            ///< of every face
    std::int64_t faces = 1;             ///< 6 for a cube map, in the order +x -x +y -y +z -z
    std::int64_t arrays = 1;            ///< pictures, or cube maps, one after the other
    std::int64_t offset = 128;          ///< of the first texel
    std::int64_t face_bytes = 0;        ///< of a face with all its levels

    /// Of the first face of each level, and from there to the same level of the next face.
    std::vector<std::int64_t> level_at = {}, face_step = {};

    std::int64_t block_bytes = 0; ///< of 4 x 4 texels; 0 for a picture that is not compressed
    TexelCode code = TexelCode::samples;
    std::int64_t texel_bytes = 0; ///< of a texel that is not compressed
    SampleType type = SampleType::u8;
    std::vector<std::string> channels = {}; ///< none for a compressed picture
    std::vector<std::uint32_t> masks = {};  ///< one per channel; none: the samples of a texel follow each other
    int alpha_channel = -1;
    bool srgb = false;
    std::string record = {}; ///< of a KTX2, how it was made, as ImageInfo has it
};

/// Throws Error{Refusal::unreadable} for a header that is damaged, for a format of texels that is not read and for a file
/// that lacks a face or a level of those that its header claims, and Error{Refusal::unsuitable} for a volume and for a cube
/// map without all six faces.
DdsHeader read_dds_header(const PictureFile& file);

/// Bytes of a level of one face.
std::int64_t level_bytes(const DdsHeader& header, std::int64_t level) noexcept;

/// Sets what the header says of texels of this DXGI_FORMAT. False for a format that is not read.
bool set_dxgi_texels(const PictureFile& file, std::uint32_t number, DdsHeader& header);

} // namespace bake
