// bake <verb>: parses the command line, runs one verb, and turns every refusal into one line and its exit code.
#include "bake/base/parallel.h"
#include "bake/base/version.h"
#include "verb.h"
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

namespace bake {

void add_examples(CLI::App& sub, const std::string& examples) { sub.footer("Examples:\n" + examples); }

void note(const CommonArgs& common, const std::string& line) {
    if (!common.quiet && !common.json) std::fprintf(stderr, "bake: %s\n", with_flags(line).c_str());
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
    {"cubemap", "Assemble, convert, filter and capture environments: six faces or one picture", cubemap_verb},
    {"render", "Render a preview of a scene", render_verb},
    {"explain", "Print every step from the height file to the shaded pixel for one texel", explain_verb},
};

int fail(const std::string& message, Refusal why) {
    std::fprintf(stderr, "bake: %s\n", with_flags(message).c_str());
    return int(why);
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text;
}

int run(int argc, char** argv) {
    CLI::App app{"bake: normal maps, bump tables, displaced meshes, environment maps, and previews of them", "bake"};
    app.set_version_flag("--version", std::string("bake ") + version());
    app.require_subcommand(1);
    app.set_help_flag("-h,--help", "Print this help");
    add_examples(app, "  bake check meshes/torus.obj meshes/bricks.png\n"
                      "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o normal.png\n"
                      "  bake <verb> --help\n");

    CommonArgs common;
    std::function<int()> chosen;
    for (const VerbEntry& entry : verbs) {
        CLI::App* sub = app.add_subcommand(entry.name, entry.job);
        const std::function<int()> job = entry.verb(*sub, common);
        sub->add_option("--threads", common.threads, "Threads to use; 0: one per core")
            ->check(CLI::Range(0, 1024))
            ->capture_default_str();
        sub->add_flag("--quiet", common.quiet, "No progress bar, no notes");
        sub->add_flag("--json", common.json, "Print one JSON object");
        sub->callback([&chosen, job] { chosen = job; });
    }
    const std::string first = argc > 1 ? argv[1] : "";
    const auto known = [&](const VerbEntry& entry) { return entry.name == first; };
    if (!first.empty() && first[0] != '-' && std::none_of(std::begin(verbs), std::end(verbs), known))
        return fail(one_line(first) + ": is not a verb; see bake --help", Refusal::usage);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) { // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        const auto used = app.get_subcommands();
        const std::string verb = used.empty() ? "bake" : "bake " + used.front()->get_name();
        if (argc == 1) return fail("no verb; see bake --help", Refusal::usage);
        return fail(one_line(error.what()) + "; see " + verb + " --help", Refusal::usage);
    }
    const ThreadLimit limit(common.threads);
    return chosen();
}

} // namespace
} // namespace bake

int main(int argc, char** argv) {
    bake::catch_interrupts();
    try {
        const int code = bake::run(argc, argv);
        if (std::fflush(stdout) != 0)
            return bake::fail("standard output: cannot be written; is the disk full?", bake::Refusal::unwritable);
        return code;
    } catch (const bake::Error& error) {
        return bake::fail(error.what(), error.refusal);
    } catch (const std::bad_alloc&) {
        return bake::fail("out of memory; use smaller inputs or outputs", bake::Refusal::unsuitable);
    } catch (const std::exception& error) {
        return bake::fail(std::string("stopped by ") + error.what() + "; please report this",
                          bake::Refusal::unsuitable);
    }
}
