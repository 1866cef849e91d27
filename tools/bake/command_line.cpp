#include "command_line.h"
#include "bake/preview/nearest_key.h"
#include "inputs/number_option.h"
#include "version_text.h"
#include <algorithm>
#include <filesystem>

namespace bake {

void add_examples(CLI::App& sub, const std::string& examples) { sub.footer("Examples:\n" + examples); }

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

/// The words with `help [VERB]` and nothing at all turned into --help.
std::vector<std::string> with_help(const std::vector<std::string>& words) {
    if (words.empty()) return {"--help"};
    if (words[0] != "help") return words;
    if (words.size() == 1 || words[1].starts_with("-")) return {"--help"};
    return {words[1], "--help"};
}

/// Whether the words are understood; else `code` is what the command ends with.
bool parse(CommandLine& line, std::vector<std::string> words, int& code) {
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    try {
        line.app.parse(words);
        return true;
    } catch (const CLI::Success& success) { // --help, --version
        std::ostringstream text;
        code = line.app.exit(success, text, text);
        print_text(text.str());
    } catch (const CLI::ParseError& error) {
        const auto used = line.app.get_subcommands();
        code = refuse_arguments(used.empty() ? line.app : *used.front(), error.what());
    }
    return false;
}

} // namespace

CommandLine::CommandLine()
    : app("bake: normal maps, bump tables, displaced meshes, environment maps, and previews of them", "bake") {
    app.set_version_flag("-V,--version", version_text(), "Print the version, the licence and the libraries");
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "Print this help; bake help VERB prints that of a verb");
    add_examples(app, "  bake check meshes/torus.obj meshes/bricks.png\n"
                      "  bake normal-map meshes/bricks.png -o flat.png\n"
                      "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o normal.png\n"
                      "  bake help normal-map\n");
    for (const VerbEntry& entry : verbs) {
        CLI::App* sub = app.add_subcommand(entry.name, entry.job);
        const std::function<int()> job = entry.verb(*sub, common);
        add_integer_option(*sub, "--threads", common.threads, 0, 1024, "Threads to use; 0: one per core")
            ->default_str(std::to_string(common.threads));
        sub->add_flag("--quiet", common.quiet, "No progress bar, no notes, no result as text");
        sub->add_flag("--json", common.json, "Print one JSON object");
        refuse_wrong_values(*sub);
        sub->callback([this, job] { chosen = job; });
    }
}

std::optional<int> CommandLine::take(const std::vector<std::string>& given) {
    const std::vector<std::string> words = with_help(given);
    refuse_empty(words);
    const auto known = [&](const VerbEntry& entry) { return entry.name == words[0]; };
    if (words[0][0] != '-' && std::none_of(std::begin(verbs), std::end(verbs), known)) return refuse_verb(words[0]);
    int code = 0;
    return parse(*this, words, code) ? std::nullopt : std::optional(code);
}

} // namespace bake
