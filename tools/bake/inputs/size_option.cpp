#include "inputs/size_option.h"
#include "bake/base/error.h"
#include "inputs/number_option.h"

namespace bake {

std::pair<int, int> parse_size(const std::string& flag, const std::string& text, int most) {
    const std::size_t cross = text.find('x');
    const auto width = parse_whole_number(text.substr(0, cross));
    const auto height = cross == std::string::npos ? width : parse_whole_number(text.substr(cross + 1));
    const auto fits = [&](const std::optional<std::int64_t>& n) { return n && *n >= 1 && *n <= most; };
    if (!fits(width) || !fits(height))
        throw Error(Refusal::usage,
                    flag + " " + text + ": is not a size; write 1024 or 2048x1024, up to " + std::to_string(most));
    return {int(*width), int(*height)};
}

CLI::Option* add_size_option(CLI::App& sub, std::optional<std::pair<int, int>>& size, const std::string& help, int most,
                             const std::string& flag) {
    return sub
        .add_option_function<std::string>(
            flag, [&size, most, flag](const std::string& text) { size = parse_size(flag, text, most); }, help)
        ->type_name("N|WxH");
}

} // namespace bake
