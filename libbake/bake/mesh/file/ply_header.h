// The header of a PLY file: its elements, and the layout of their rows.
#pragma once
#include "bake/base/file_bytes.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type) noexcept;

struct PlyProperty {
    std::string name;
    PlyType type;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t rows = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::string record;         ///< how the file was made, as Mesh has it
    const char* body = nullptr; ///< first byte after the header
};

/// Throws Error{Refusal::unreadable} for an invalid header, with the line, and for more rows than the rest can hold.
PlyHeader read_ply_header(const FileBytes& file, const std::string& path);

/// Index of the property, or -1.
int find_property(const PlyElement& element, const char* name) noexcept;

} // namespace bake
