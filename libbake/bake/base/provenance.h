// What a written file says of how it was made: one JSON object in one line of ASCII.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace bake {

/// One thing that a file's values mean, or an option of the run: its name in snake_case and its value.
struct Fact {
    std::string name;
    std::variant<std::string, double, bool, std::vector<double>> value;

    bool operator==(const Fact&) const = default;
};
using Facts = std::vector<Fact>;

/// What a run is, besides its inputs.
struct RunDescription {
    std::string verb;
    Facts options; ///< those that affect the result, without folders
};

/// While it lives, the files that the current job (base/job.h) writes say which run made them. The command has one for each run. A program
/// that uses the library and wants no such record makes none.
class RunRecord {
public:
    explicit RunRecord(RunDescription run);
    ~RunRecord();
    RunRecord(const RunRecord&) = delete;
    RunRecord& operator=(const RunRecord&) = delete;

private:
    RunDescription run_;
    const RunDescription* outer_;
};

/// The record of a file whose values mean `facts`, empty without a RunRecord:
/// {"software": "bake", "version": ..., "verb": ..., "options": {...}, "inputs": [{"name": ..., "xxh128": ...}, ...],
/// "values": {facts}}. The inputs are the files that InputRecord knows by now, in the order of their names, without their
/// folders. Control characters and characters beyond ASCII are escaped. The same run gives the same bytes on any day, in
/// any folder and for any number of threads.
std::string record_text(const Facts& facts);

/// The text, if it is such an object, of any program; else nothing. Readers of files pass on no other records.
std::string valid_record(std::string text);

/// A text, or a number or a list of numbers, among the "values" of a record; empty if there is none of that name and kind.
std::string record_word(const std::string& record, const std::string& name);
std::vector<double> record_numbers(const std::string& record, const std::string& name);

/// The name under which formats with named texts hold the record.
inline constexpr const char* record_key = "bake";

/// The record as the text of a comment, "bake {...}"; empty without a RunRecord.
std::string record_comment(const Facts& facts);
/// The record in such a comment; empty for other texts.
std::string record_in(std::string_view comment);

} // namespace bake
