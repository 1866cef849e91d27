// A number by which a file's contents are known.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace bake {

/// XXH3 with 128 bits (Yann Collet, xxhash.com) of some bytes, as 32 hexadecimal digits: what the program xxh128sum prints.
/// It tells changes from chance, not from intent: whoever tries can make two files of the same hash.
std::string content_hash(const void* bytes, std::size_t size);

/// The same of a regular file, at 5 to 10 GB/s where the system still holds it. Nothing if the file cannot be read.
std::optional<std::string> file_hash(const std::string& path);
/// The same of an open file, whose position stays.
std::optional<std::string> file_hash(int descriptor);

} // namespace bake
