// bake <verb>: parses the command line, runs one verb, and turns every refusal into one line and its exit code.
#include "bake/base/input_record.h"
#include "bake/base/memory.h"
#include "bake/base/parallel.h"
#include "bake/base/system_lack.h"
#include "bake/base/text.h"
#include "bake/preview/nearest_key.h"
#include "inputs/number_option.h"
#include "run_description.h"
#include "verb.h"
#include "version_text.h"
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <unistd.h>

namespace bake {

void add_examples(CLI::App& sub, const std::string& examples) { sub.footer("Examples:\n" + examples); }

namespace {

void print_line(const std::string& message) {
    const char* const wipe = isatty(STDERR_FILENO) ? "\r\033[K" : ""; // a bar that is drawn there
    std::fprintf(stderr, "%sbake: %s\n", wipe, printable(with_flags(message)).c_str());
}

} // namespace

void note(const CommonArgs& common, const std::string& line) {
    if (!line.empty() && !common.quiet && !common.json) print_line(line);
}

int fail(const std::string& message, Refusal why) {
    print_line(message);
    return int(why);
}

void print_text(const std::string& text) { std::fputs(printable_lines(text).c_str(), stdout); }

void print_json(const nlohmann::ordered_json& object, int indent) {
    const auto dump = [&](bool ascii) {
        return object.dump(indent, ' ', ascii, nlohmann::ordered_json::error_handler_t::replace);
    };
    std::string text = dump(false);
    if (printable_lines(text) != text) text = dump(true); // as \u009b
    std::printf("%s\n", text.c_str());
}

void print_result(const CommonArgs& common, const std::string& text, nlohmann::json object, const Stopwatch& watch) {
    common.outputs->commit();
    if (common.json) {
        if (!object.contains("seconds")) object["seconds"] = watch.to_json();
        print_json(object);
    } else if (!common.quiet) {
        print_text(text + watch.to_text() + "\n");
    }
}

namespace {

struct VerbEntry {
    const char* name;
    const char* job;
    Verb* verb;
};

constexpr VerbEntry verbs[] = {
    {"bump-table", "Bump lookup table (slopes along u and v) from a grayscale height texture", bump_table_verb},
    {"displace", "Displace a mesh by a height: welded, without cracks, with exact normals", displace_verb},
    {"normal-map", "Normal map from a height texture, on a plane or on a mesh", normal_map_verb},
    {"surface", "Normals, tangents, derivatives and curvature of a shape, a mesh or a subdivision surface",
     surface_verb},
    {"check", "Report what is in meshes and images, and what is wrong with them", check_verb},
    {"compare", "Compare methods of relief in a scene, or two pictures, normal maps or meshes", compare_verb},
    {"plan", "Choose the cheapest model of each object within an error budget, by probes of the picture", plan_verb},
    {"cubemap", "Assemble, convert, filter and capture environments: six faces or one picture", cubemap_verb},
    {"render", "Render a preview of a scene, a mesh, or a map on a shape", render_verb},
    {"explain", "Print every step from the height file to the shaded pixel for one texel", explain_verb},
};

std::string without_end(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

/// " (did you mean --amplitude?)", or nothing.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
    const std::string meant = nearest_key(word, names);
    return meant.empty() ? "" : " (did you mean " + meant + "?)";
}

int refuse_verb(const std::string& word) {
    std::vector<std::string> names;
    for (const VerbEntry& entry : verbs) names.emplace_back(entry.name);
    std::error_code absent;
    if (std::filesystem::is_regular_file(word, absent))
        return fail(word + ": is a file, not a verb; bake check " + word + " says what is in it", Refusal::usage);
    return fail(word + ": is not a verb" + suggestion(word, names) + "; see bake --help", Refusal::usage);
}

int refuse_arguments(const CLI::App& sub, const std::string& reason) {
    const std::string verb = sub.get_parent() ? "bake " + sub.get_name() : "bake";
    std::vector<std::string> names;
    for (const CLI::Option* option : sub.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    // An unknown option is the better reason than what its absence or its value led to.
    for (const std::string& word : sub.remaining())
        if (word.size() > 1 && word[0] == '-')
            return fail(word + ": is not an option of " + verb + suggestion(word, names) + "; see " + verb + " --help",
                        Refusal::usage);
    return fail(without_end(reason) + "; see " + verb + " --help", Refusal::usage);
}

/// An option's value that begins with two dashes is an option whose predecessor lacks its value; a flag has no value.
void refuse_wrong_values(CLI::App& sub) {
    const CLI::Validator plain(
        [](std::string& text) {
            return text.starts_with("--") && text.size() > 2 ? text + " stands where its value is expected" : "";
        },
        "");
    for (CLI::Option* option : sub.get_options())
        if (option->get_items_expected_max() == 0) option->disable_flag_override();
        else if (option->nonpositional()) option->check(plain);
}

/// Refuses empty arguments, which a script's unset variables leave: no verb, file, value or list is empty, and CLI11 takes
/// the word behind "--out=" for its value.
void refuse_empty(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const bool option = word.starts_with("--") && word.find('=') + 1 == word.size();
        if (!word.empty() && !option) continue;
        const bool value = i > 0 && words[i - 1].size() > 1 && words[i - 1][0] == '-';
        const std::string what = option  ? word.substr(0, word.size() - 1)
                                 : value ? words[i - 1]
                                         : "argument " + std::to_string(i + 1);
        throw Error(Refusal::usage, what + ": is empty; write what belongs there, or leave it out");
    }
}

/// The arguments, with `help [VERB]` and nothing at all turned into --help.
std::vector<std::string> arguments(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty()) return {"--help"};
    if (words[0] != "help") return words;
    if (words.size() == 1 || words[1].starts_with("-")) return {"--help"};
    return {words[1], "--help"};
}

/// `cap`: to begin where the control group limits the memory, as the kernel ends a process that exceeds that limit.
int run(int argc, char** argv, std::optional<MemoryCap>& cap) {
    CLI::App app{"bake: normal maps, bump tables, displaced meshes, environment maps, and previews of them", "bake"};
    app.set_version_flag("-V,--version", version_text(), "Print the version, the licence and the libraries");
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "Print this help; bake help VERB prints that of a verb");
    add_examples(app, "  bake check meshes/torus.obj meshes/bricks.png\n"
                      "  bake normal-map meshes/bricks.png -o flat.png\n"
                      "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o normal.png\n"
                      "  bake help normal-map\n");

    OutputSet outputs;
    const InputRecord inputs;
    CommonArgs common{.outputs = &outputs};
    std::function<int()> chosen;
    for (const VerbEntry& entry : verbs) {
        CLI::App* sub = app.add_subcommand(entry.name, entry.job);
        const std::function<int()> job = entry.verb(*sub, common);
        add_integer_option(*sub, "--threads", common.threads, 0, 1024, "Threads to use; 0: one per core")
            ->default_str(std::to_string(common.threads));
        sub->add_flag("--quiet", common.quiet, "No progress bar, no notes, no result as text");
        sub->add_flag("--json", common.json, "Print one JSON object");
        refuse_wrong_values(*sub);
        sub->callback([&chosen, job] { chosen = job; });
    }
    std::vector<std::string> words = arguments(argc, argv);
    refuse_empty(words);
    const auto known = [&](const VerbEntry& entry) { return entry.name == words[0]; };
    if (words[0][0] != '-' && std::none_of(std::begin(verbs), std::end(verbs), known)) return refuse_verb(words[0]);
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    try {
        app.parse(words);
    } catch (const CLI::Success& success) { // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        const auto used = app.get_subcommands();
        return refuse_arguments(used.empty() ? app : *used.front(), error.what());
    }
    // Never destroyed, see ThreadLimit: a command that has one thread needs no others, to its end.
    [[maybe_unused]] static const auto* const limit = new ThreadLimit(common.threads);
    // The threads of TBB and those of OpenEXR.
    if (const auto group = control_group_limit()) cap.emplace(*group, 2 * thread_count());
    const RunRecord record(describe_run(*app.get_subcommands().front()));
    return chosen();
}

/// Why memory was not granted. The limit is still in force.
int fail_without_memory() try {
    const MemoryLimit memory = memory_limit();
    return fail("out of memory: this takes more than " + memory.described() + "; use smaller inputs or outputs, or " +
                    memory.advice(),
                Refusal::unsuitable);
} catch (const std::bad_alloc&) { // not even for the line
    std::fputs("bake: out of memory; use smaller inputs or outputs\n", stderr);
    return int(Refusal::unsuitable);
}

} // namespace
} // namespace bake

int main(int argc, char** argv) {
    bake::catch_interrupts();
    std::optional<bake::MemoryCap> cap;
    try {
        const int code = bake::run(argc, argv, cap);
        if (std::fflush(stdout) != 0)
            return bake::fail("standard output: cannot be written; is the disk full?", bake::Refusal::unwritable);
        return code;
    } catch (const bake::Error& error) {
        return bake::fail(error.what(), error.refusal);
    } catch (const std::bad_alloc&) {
        return bake::fail_without_memory();
    } catch (const std::exception& error) {
        if (bake::lacks_threads(error))
            return bake::fail("no thread can be started; use --threads 1, or raise ulimit -u or the limit on memory",
                              bake::Refusal::unsuitable);
        return bake::fail(std::string("stopped by ") + error.what() + "; please report this",
                          bake::Refusal::unsuitable);
    }
}
