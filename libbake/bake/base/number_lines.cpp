#include "bake/base/number_lines.h"
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/text_encoding.h"
#include "bake/base/text_line.h"
#include <charconv>
#include <cmath>

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
            double value = 0;
            const bool plus = *at == '+' && at[1] != '-'; // std::from_chars takes no plus
            const auto read = std::from_chars(at + plus, end, value);
            const bool ends = read.ptr == end || std::string_view(" \t\r,#").find(*read.ptr) != std::string_view::npos;
            if (read.ec != std::errc() || !ends || !std::isfinite(value)) {
                const char* stop = at;
                while (stop < end && *stop != ' ' && *stop != ',') ++stop;
                throw Error{Refusal::unreadable, path + ": line " + std::to_string(number) + ": " +
                                                     shown({at, std::size_t(stop - at)}) +
                                                     " is not a number; only numbers and # comments belong here"};
            }
            line.values.push_back(value);
            at = read.ptr;
        }
        if (!line.values.empty()) lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace bake
