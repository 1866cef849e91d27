// Numbers and counted nouns in warnings and notes.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace bake {

/// Four significant digits.
std::string number(double v);
/// "12.3 %" of a fraction.
std::string percent(double part);
/// counted(2, "face") is "2 faces". Words after a '|' are not inflected: counted(2, "face|without uvs") is "2 faces without
/// uvs".
std::string counted(std::size_t count, const std::string& what);
/// Adds "2 faces: rest" if the count is not 0.
void add_if(std::vector<std::string>& list, std::size_t count, const std::string& what, const std::string& rest);

} // namespace bake
