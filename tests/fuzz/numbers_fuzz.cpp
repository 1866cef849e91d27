// Numbers in text against the C library, and text made printable.
#include "bake/base/parse_double.h"
#include "bake/base/printable.h"
#include "bake/base/text_line.h"
#include "fuzz/fuzz.h"

namespace {

using bake::fuzz::require;

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// A number as the C library reads it: only where both mean a decimal number by it.
void check_number(const std::string& word) {
    if (word.find_first_not_of("0123456789.eE+-") != std::string::npos) return;
    const std::string line = word + '\n';
    float single = 0;
    const char* end = line.data();
    const bool read = bake::parse_float(end, single);
    char* known_end = nullptr;
    const float known = std::strtof(line.c_str(), &known_end);
    require(read == (known_end != line.c_str()), "parse_float reads what strtof reads");
    require(!read || (end == known_end && is_same(single, known)), "parse_float is the nearest float");
    const double known_double = std::strtod(line.c_str(), &known_end);
    const auto finite = bake::parse_finite(word);
    require(bool(finite) == (!word.empty() && known_end == line.c_str() + word.size() && std::isfinite(known_double)),
            "parse_finite reads what strtod reads");
    require(!finite || *finite == known_double, "parse_finite is the nearest double");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    check_number(text.substr(0, text.find('\n')));
    const std::string once = bake::printable(text);
    require(bake::printable(once) == once, "printable text stays as it is");
    require(once.find('\n') == std::string::npos && once.find('\x1b') == std::string::npos,
            "printable text is one line");
    require(bake::printable_lines(once) == once, "printable text is printable as lines");
    bake::shown(text);
    return 0;
}
