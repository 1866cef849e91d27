#include "bake/base/number_lines.h"
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/parse_double.h"
#include "bake/base/text_encoding.h"
#include <string_view>

namespace bake {

std::vector<NumberLine> read_number_lines(const std::string& path) {
    FileBytes file = read_file(path);
    decode_text(file);
    end_lines_by_newline(file);
    std::vector<NumberLine> lines;
    std::size_t number = 0;
    for (const char *next = file.begin(), *at = next; at < file.end(); at = next) {
        const char* end = at;
        while (*end != '\n') ++end; // read_file puts a '\n' behind the last line
        next = end + 1;
        NumberLine line{.line = ++number};
        while (at < end && *at != '#') {
            if (*at == ' ' || *at == '\t' || *at == '\r' || *at == ',') {
                ++at;
                continue;
            }
            const char* stop = at;
            while (stop < end && std::string_view(" \t\r,#").find(*stop) == std::string_view::npos) ++stop;
            const std::string_view word(at, std::size_t(stop - at));
            const auto value = parse_finite(word);
            if (!value)
                throw Error{Refusal::unreadable, path + ": line " + std::to_string(number) + ": " + shown(word) +
                                                     " is not a number; only numbers and # comments belong here"};
            line.values.push_back(*value);
            at = stop;
        }
        if (!line.values.empty()) lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace bake
