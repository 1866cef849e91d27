#include "inputs/byte_option.h"
#include "bake/base/text.h"
#include "inputs/number_option.h"
#include <cctype>
#include <cmath>

namespace bake {

std::uint64_t parse_bytes(const std::string& flag, const std::string& text) {
    const std::size_t end = text.find_last_of("0123456789.") + 1; // 0 without any digit
    std::string unit = text.substr(end);
    for (char& c : unit) c = char(std::toupper(static_cast<unsigned char>(c)));
    const std::size_t power = unit.empty() ? 0 : std::string("BKMGT").find(unit[0]);
    const std::string rest = unit.empty() ? "" : unit.substr(1);
    const bool known = power != std::string::npos && (rest.empty() || (power > 0 && (rest == "B" || rest == "IB")));
    const double bytes = known ? parse_number(text.substr(0, end)).value_or(-1) * std::exp2(10.0 * double(power)) : -1;
    if (!(bytes >= 1) || bytes > 1e18)
        throw Error(Refusal::usage, flag + " " + text + ": is not a size; write bytes, or such as 500M or 2G");
    return std::uint64_t(bytes);
}

CLI::Option* add_memory_option(CLI::App& sub, std::optional<std::uint64_t>& bytes) {
    const auto parse = [&bytes](const std::string& text) { bytes = parse_bytes("--max-memory", text); };
    return sub
        .add_option_function<std::string>("--max-memory", parse,
                                          "Refuse what needs more memory, such as 2G [the memory that the machine has]")
        ->type_name("SIZE");
}

std::string describe_bytes(double bytes) {
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    int unit = 0;
    while (bytes >= 1024 && unit < 4) bytes /= 1024, ++unit;
    return format(unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
}

} // namespace bake
