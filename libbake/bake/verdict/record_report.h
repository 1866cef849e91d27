// How a file was made, for reports on files.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace bake {

/// The record of a file, as ImageInfo and Mesh have it, as an object; null without one.
nlohmann::ordered_json record_object(const std::string& record);

/// Rows of a report: by what the file was made and from what, with which options, and what its values mean. Empty
/// without a record.
std::string record_rows(const std::string& record);

} // namespace bake
