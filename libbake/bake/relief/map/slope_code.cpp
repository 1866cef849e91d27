#include "bake/relief/map/slope_code.h"
#include "bake/base/text.h"
#include <charconv>

namespace bake {

namespace {
constexpr std::string_view formula = "slope = (level - 32768) / 32767 * ";
}

std::string to_text(const SlopeCode& code) { return std::string(formula) + format("%.9g", double(code.range)); }

std::optional<SlopeCode> slope_code(std::string_view description) {
    const std::size_t at = description.find(formula);
    if (at == std::string_view::npos) return {};
    SlopeCode code;
    const char* const number = description.data() + at + formula.size();
    const auto read = std::from_chars(number, description.data() + description.size(), code.range);
    if (read.ec != std::errc() || !(code.range > 0) || code.range * 0 != 0) return {};
    return code;
}

} // namespace bake
