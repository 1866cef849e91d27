#include "bake/mesh/file/ply_header.h"
#include "bake/base/error.h"
#include "bake/base/provenance.h"
#include "bake/base/text_line.h"
#include <algorithm>
#include <optional>

namespace bake {
namespace {

std::optional<PlyType> type_named(std::string_view name) noexcept {
    struct Named {
        std::string_view first, second;
        PlyType type;
    };
    static constexpr Named types[] = {
        {"char", "int8", PlyType::int8},        {"uchar", "uint8", PlyType::uint8},
        {"short", "int16", PlyType::int16},     {"ushort", "uint16", PlyType::uint16},
        {"int", "int32", PlyType::int32},       {"uint", "uint32", PlyType::uint32},
        {"float", "float32", PlyType::float32}, {"double", "float64", PlyType::float64},
    };
    for (const Named& t : types)
        if (name == t.first || name == t.second) return t.type;
    return {};
}

/// Of elements, and of properties of one: a hostile header must not keep us busy.
constexpr std::size_t most_declarations = 1000;

std::vector<std::string_view> words_of(const char* p) {
    std::vector<std::string_view> words;
    for (skip_blanks(p); *p != '\n'; skip_blanks(p)) {
        const char* const word = p;
        while (!ends_word(*p)) ++p;
        words.emplace_back(word, std::size_t(p - word));
    }
    return words;
}

/// Bytes that one row takes at least.
std::uint64_t least_bytes(const PlyElement& element, PlyFormat format) noexcept {
    std::uint64_t bytes = 0;
    for (const PlyProperty& p : element.properties)
        bytes += format == PlyFormat::ascii ? 2 : size_of(p.is_list ? p.count_type : p.type); // a digit and a blank
    return bytes;
}

/// Adds what one header line declares; why it cannot, when it cannot.
std::string read_declaration(const std::vector<std::string_view>& words, PlyHeader& header) {
    const std::string_view keyword = words[0];
    if (keyword == "element") {
        PlyElement element;
        std::int64_t rows = -1;
        if (words.size() == 3) {
            const char* p = words[2].data();
            if (!parse_integer(p, rows) || !ends_word(*p)) rows = -1;
        }
        if (rows < 0) return "an element needs a name and a count of 0 or more";
        if (header.elements.size() == most_declarations) return "more elements than any mesh has";
        element.name = words[1];
        element.rows = std::uint64_t(rows);
        for (const PlyElement& other : header.elements)
            if (other.name == element.name) return "a second element " + shown(element.name);
        header.elements.push_back(std::move(element));
        return {};
    }
    if (keyword == "property") {
        if (header.elements.empty()) return "a property before any element";
        PlyElement& element = header.elements.back();
        const bool is_list = words.size() == 5 && words[1] == "list";
        if (!is_list && words.size() != 3) return "a property needs a type and a name, or list, two types and a name";
        const auto type = type_named(words[is_list ? 3 : 1]);
        const auto count_type = type_named(is_list ? words[2] : "uchar");
        if (!type || !count_type) return shown(words[type ? 2 : is_list ? 3 : 1]) + " is not a PLY type";
        if (*count_type == PlyType::float32 || *count_type == PlyType::float64)
            return "the count of a list cannot be a float";
        if (element.properties.size() == most_declarations) return "more properties than any mesh has";
        PlyProperty property{std::string(words.back()), *type, is_list, *count_type};
        if (find_property(element, property.name.c_str()) >= 0) return "a second property " + shown(property.name);
        element.properties.push_back(std::move(property));
        return {};
    }
    if (keyword == "comment" || keyword == "obj_info") return {};
    return shown(keyword) + " is not a word of a PLY header";
}

} // namespace

std::size_t size_of(PlyType type) noexcept {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::float64: break;
    }
    return 8;
}

int find_property(const PlyElement& element, const char* name) noexcept {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name) return int(i);
    return -1;
}

PlyHeader read_ply_header(const FileBytes& file, const std::string& path) {
    PlyHeader header;
    const auto refuse = [&](std::size_t line, const std::string& why) {
        throw Error(Refusal::unreadable,
                    path + ":" + std::to_string(line) + ": " + why + "; write the file again from its source");
    };
    const char* const stop = file.end() + 1; // with the '\n' behind the file
    std::size_t line = 0;
    bool format_known = false;
    for (const char* p = file.begin();; ++line) {
        if (p >= file.end())
            refuse(std::max<std::size_t>(1, line),
                   line == 0 ? "an empty file, not a PLY" : "the header has no end_header");
        const auto words = words_of(p);
        p = static_cast<const char*>(std::memchr(p, '\n', std::size_t(stop - p))) + 1;
        if (line == 0) {
            if (words.size() != 1 || words[0] != "ply") refuse(1, "does not begin with 'ply'");
        } else if (words.empty()) {
            continue;
        } else if (words[0] == "format") {
            const std::string_view name = words.size() == 3 ? words[1] : "";
            format_known = name == "ascii" || name == "binary_little_endian" || name == "binary_big_endian";
            if (!format_known || words[2] != "1.0")
                refuse(line + 1, "not format ascii, binary_little_endian or binary_big_endian 1.0");
            header.format = name == "ascii"                  ? PlyFormat::ascii
                            : name == "binary_little_endian" ? PlyFormat::little_endian
                                                             : PlyFormat::big_endian;
        } else if (words[0] == "comment" && words.size() > 1) {
            const std::string record = record_in({words[1].data(), std::size_t(p - 1 - words[1].data())});
            if (!record.empty()) header.record = record;
        } else if (words[0] == "end_header") {
            if (p > file.end()) p = file.end();
            header.body = p;
            break;
        } else if (const std::string why = read_declaration(words, header); !why.empty()) {
            refuse(line + 1, why);
        }
    }
    if (!format_known) refuse(line + 1, "the header names no format");

    // What cannot be there is refused before memory is asked for it.
    auto left = std::uint64_t(file.end() - header.body) + (header.format == PlyFormat::ascii);
    for (const PlyElement& element : header.elements) {
        const std::uint64_t least = least_bytes(element, header.format);
        if (least > 0 && element.rows > left / least)
            throw Error(Refusal::unreadable, path + ": declares " + std::to_string(element.rows) + " rows of " +
                                                 shown(element.name) + ", more than its " + std::to_string(file.size) +
                                                 " bytes can hold; it was cut short: copy or export it again");
        left -= element.rows * least;
    }
    return header;
}

} // namespace bake
