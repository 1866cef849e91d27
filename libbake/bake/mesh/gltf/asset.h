// A glTF file kept whole while parts of it are replaced: its JSON as it stands, and the bytes that the JSON names.
//
// What is replaced is recorded first and given its place at the end: accessors and bufferViews that nothing names any
// more are used again, new ones follow the others. All other numbers in the JSON stay valid, also in extensions that are
// not known here.
#pragma once
#include "bake/mesh/gltf/container.h"
#include "bake/mesh/gltf/document.h"
#include <memory>
#include <optional>

namespace bake {

/// A list of values that becomes an accessor with a bufferView of its own.
struct GltfValues {
    nlohmann::ordered_json accessor; ///< componentType, count, type and, if need be, min, max
    std::optional<std::size_t> like; ///< an accessor of the file, of which all is the same but the count
    std::size_t stride = 0;          ///< bytes from element to element, a multiple of 4; 0: no gaps, for indices
    bool indices = false;
    GltfBlock bytes;
};
using GltfSharedValues = std::shared_ptr<GltfValues>; ///< primitives that share one get the same accessor

/// What a primitive has instead.
struct GltfPrimitivePatch {
    std::size_t mesh = 0, primitive = 0;                              ///< numbers in the JSON
    std::vector<std::pair<std::string, GltfSharedValues>> attributes; ///< null: is removed
    std::vector<std::vector<std::pair<std::string, GltfSharedValues>>> targets;
    GltfSharedValues indices; ///< of a list of triangles; null: the primitive keeps its own
    bool moved = false;       ///< its vertices are others: compressed copies of them are removed
};

class GltfAsset {
public:
    using json = nlohmann::ordered_json;
    /// The document must outlive it.
    explicit GltfAsset(const GltfDocument& document, std::string path);

    /// All of the file but the buffers. A new key moves what is in an object: references into `root` do not outlive it.
    json root;

    /// An element of a list of the JSON; a new null if there is no such list or element.
    json& at(const char* list, std::size_t index);
    /// The bytes of an image; empty if its file is missing.
    std::span<const std::uint8_t> image(std::size_t index) const;
    void patch(GltfPrimitivePatch patch);
    /// Puts other bytes into an image, which may be new.
    void set_image(std::size_t index, std::vector<std::uint8_t> png, const std::string& name);

    /// Writes the file with all patches. Adds notes on what could not be kept. Returns the bytes of all files.
    std::int64_t write(const std::string& path, const Facts& facts, std::vector<std::string>& notes);

private:
    void take_out(GltfPrimitivePatch& patch);
    void place_accessors();
    std::size_t new_view(GltfBlock block, const json& extra);
    std::vector<GltfBeside> place_images(const std::string& path, std::vector<std::string>& notes);
    std::vector<GltfBlock> lay_out_buffer();
    void sign();

    const GltfDocument& document_;
    std::string path_;
    std::vector<GltfPrimitivePatch> patches_;
    std::set<std::size_t> old_accessors_, old_views_;                       ///< that patches have taken out
    std::vector<std::size_t> free_views_;                                   ///< in descending order
    std::vector<GltfBlock> added_;                                          ///< buffers behind those of the document
    std::vector<std::pair<std::size_t, std::vector<std::uint8_t>>> images_; ///< that are new
};

} // namespace bake
