// The ledger as a file of lines: one for each file as a task met it, and one for each task, behind that of the program that ran
// it. Fields are apart by one blank; in names, blanks, % and control characters are %20 and the like.
#include "bake/base/block_writer.h"
#include "bake/base/file_bytes.h"
#include "bake/base/text.h"
#include "bake/batch/ledger.h"
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <tuple>

namespace bake {
namespace {

constexpr std::string_view first_line = "bake batch ledger 1";

std::string escaped(const std::string& name) {
    std::string out;
    for (const char c : name)
        if (static_cast<unsigned char>(c) <= ' ' || c == '%' || c == 0x7f)
            out += format("%%%02x", static_cast<unsigned char>(c));
        else out += c;
    return out;
}

std::string unescaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        int code = 0;
        const bool coded = text[i] == '%' && i + 2 < text.size() &&
                           std::from_chars(&text[i + 1], &text[i + 1] + 2, code, 16).ptr == &text[i + 1] + 2;
        out += coded ? char(code) : text[i];
        if (coded) i += 2;
    }
    return out;
}

/// The fields of one line, one after the other; `good` is false behind the first that is not as it is asked for.
struct Fields {
    std::string_view rest;
    bool good = true;

    std::string_view word() {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        const std::string_view out = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        good &= !out.empty();
        return out;
    }
    template <class Number> Number number() {
        const std::string_view text = word();
        Number value{};
        good &= std::from_chars(text.data(), text.data() + text.size(), value).ptr == text.data() + text.size();
        return value;
    }
    std::vector<FileMark> marks(const std::vector<FileMark>& known) {
        std::vector<FileMark> out;
        for (std::size_t count = number<std::size_t>(); good && count > 0; --count) {
            const auto i = number<std::size_t>();
            good &= i < known.size();
            if (good) out.push_back(known[i]);
        }
        return out;
    }
};

/// Numbers the marks, and collects their lines.
struct Marks {
    std::unordered_map<std::string, std::size_t> numbers;
    std::string lines;

    std::string listed(const std::vector<FileMark>& marks) {
        std::string text = " " + std::to_string(marks.size());
        for (const FileMark& mark : marks) {
            const std::string line = "file " + std::to_string(mark.stamp.size) + " " +
                                     std::to_string(mark.stamp.changed_ns) + " " + std::to_string(mark.stamp.number) +
                                     " " + (mark.hash.empty() ? "-" : mark.hash) + " " + escaped(mark.path) + "\n";
            const auto [known, fresh] = numbers.emplace(line, numbers.size());
            if (fresh) lines += line;
            text += " " + std::to_string(known->second);
        }
        return text;
    }
};

} // namespace

Ledger::Ledger(std::string path, std::string program) : path_(std::move(path)), program_(std::move(program)) {
    std::error_code absent;
    if (std::filesystem::is_regular_file(path_, absent)) read();
}

void Ledger::read() {
    const FileBytes bytes = read_file(path_);
    std::string_view text(bytes.begin(), bytes.size);
    std::vector<FileMark> marks;
    std::string program;
    std::unordered_map<std::string, LedgerEntry> entries;
    for (std::size_t line = 0; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        Fields fields{text.substr(0, end)};
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line == 0 && fields.rest != first_line) return;
        if (line == 0) continue;
        const std::string_view kind = fields.word();
        if (kind == "program") program = unescaped(fields.word());
        if (kind == "file") {
            const auto size = fields.number<std::int64_t>(), changed = fields.number<std::int64_t>();
            const FileStamp stamp{size, changed, fields.number<std::uint64_t>()};
            const std::string hash(fields.word());
            marks.push_back({unescaped(fields.word()), stamp, hash == "-" ? "" : hash});
        }
        if (kind == "task") {
            LedgerEntry entry{program, std::string(fields.word()), fields.number<double>(), {}, {}};
            entry.inputs = fields.marks(marks);
            entry.outputs = fields.marks(marks);
            entries[unescaped(fields.word())] = std::move(entry);
        }
        if (!fields.good) return;
    }
    entries_ = std::move(entries);
}

void Ledger::write() {
    const std::lock_guard lock(mutex_);
    if (!changed_) return;
    using Named = const std::pair<const std::string, LedgerEntry>*;
    std::vector<Named> sorted;
    for (const auto& named : entries_) sorted.push_back(&named);
    std::sort(sorted.begin(), sorted.end(), [](Named a, Named b) {
        return std::tie(a->second.program, a->first) < std::tie(b->second.program, b->first);
    });
    Marks marks;
    std::string tasks;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const auto& [name, entry] = *sorted[i];
        if (i == 0 || entry.program != sorted[i - 1]->second.program)
            tasks += "program " + escaped(entry.program) + "\n";
        tasks += "task " + entry.key + format(" %.3f", entry.seconds);
        tasks += marks.listed(entry.inputs);
        tasks += marks.listed(entry.outputs);
        tasks += " " + escaped(name) + "\n";
    }
    BlockWriter file(path_);
    file.write(std::string(first_line) + "\n" + marks.lines + tasks);
    file.commit();
    changed_ = false;
}

} // namespace bake
