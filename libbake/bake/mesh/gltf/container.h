// The files of a glTF: a .glb, or a .gltf with the files beside it.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/base/provenance.h"
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

namespace bake {

/// Bytes of the buffer, which are written when their turn comes.
struct GltfBlock {
    std::size_t bytes = 0;
    std::function<void(BlockWriter&)> write = {};

    /// Blocks begin at multiples of four.
    std::size_t padded() const noexcept { return (bytes + 3) / 4 * 4; }
};

/// An image beside a .gltf.
struct GltfBeside {
    std::string name; ///< in the folder of the .gltf
    std::span<const std::uint8_t> bytes;
};

/// Names of files beside a .gltf, each once.
class GltfNames {
public:
    explicit GltfNames(const std::string& path);
    /// `wanted`; if it is empty, one made of the number of the image and the ending.
    std::string next(const std::string& wanted, std::size_t number, const std::string& ending);

private:
    std::string stem_;
    std::set<std::string> taken_;
};

void put(BlockWriter& out, std::span<const std::uint8_t> bytes);
std::string percent_encoded(const std::string& name);
/// JSON holds UTF-8 alone; names from other formats may be anything.
std::string gltf_text(const std::string& text);
/// By the first bytes: PNG, JPEG, WebP, KTX2, DDS or AVIF; empty for others.
std::string gltf_mime_type(std::span<const std::uint8_t> bytes);

/// Writes .glb or .gltf by the name, atomically, the .gltf last. Sets the one buffer of `root`, and
/// asset.extras.bake to the record of the run with `facts`, if there is a run. Returns the bytes of all files.
/// Throws Error{Refusal::unwritable}, {Refusal::unsuitable} for a .glb above 4 GiB, and {Refusal::usage} for an image that
/// would replace a file of other contents, unless the .gltf that is replaced names that file.
std::int64_t write_gltf_files(const std::string& path, nlohmann::ordered_json& root, std::span<const GltfBlock> blocks,
                              std::span<const GltfBeside> beside, const Facts& facts);

} // namespace bake
