#include "pages/man_page.h"
#include "bake/base/version.h"
#include "pages/option_view.h"
#include <algorithm>
#include <sstream>

namespace bake {
namespace {

/// Text that roff prints as it stands: hyphens that can be copied, and no line that is taken for a request.
std::string plain(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        if (c == '\\') out += "\\e";
        else if (c == '-') out += "\\-";
        else out += c;
    }
    return out;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return text;
}

std::string option_text(const OptionView& option) {
    std::string text = ".TP\n";
    for (std::size_t i = 0; i < option.names.size(); ++i)
        text += (i ? ", " : "") + (option.positional ? italic(option.names[i]) : bold(option.names[i]));
    if (!option.value.empty() && !option.positional) text += " " + italic(option.value);
    text += "\n" + plain(option.description) + ".";
    if (!option.default_value.empty()) text += " Default: " + plain(option.default_value) + ".";
    if (option.required) text += " Required.";
    for (const std::string& needed : option.needs) text += " Needs " + bold(needed) + ".";
    return text + "\n";
}

/// The lines below "Examples:": command lines are indented, what is said about them is not.
std::string examples_text(const CLI::App& app) {
    std::string text = ".SH EXAMPLES\n";
    std::istringstream in(app.get_footer());
    bool code = false;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line == "Examples:") continue;
        const bool is_code = line.starts_with("  ");
        if (is_code != code) text += is_code ? ".PP\n.nf\n.RS\n" : ".RE\n.fi\n.PP\n";
        code = is_code;
        text += plain(is_code ? line.substr(2) : line) + "\n";
    }
    return text + (code ? ".RE\n.fi\n" : "");
}

std::string exit_codes() {
    std::string text = ".SH EXIT STATUS\n";
    const std::pair<const char*, const char*> codes[] = {{"0", "Success."},
                                                         {"1", "Done, but the result exceeds a limit that was given."},
                                                         {"2", "Wrong options."},
                                                         {"3", "An input cannot be read."},
                                                         {"4", "An input is unsuitable, or needs too much memory."},
                                                         {"5", "An output cannot be written."},
                                                         {"130", "Interrupted."}};
    for (const auto& [code, meaning] : codes) text += ".TP\n" + bold(code) + "\n" + plain(meaning) + "\n";
    return text + "A run that fails leaves no output, and one line on stderr says why.\n";
}

std::string synopsis(const CLI::App& app, const std::string& command) {
    std::string text = ".SH SYNOPSIS\n" + bold(command);
    if (!verbs_of(app).empty()) return text + " " + italic("VERB") + " [" + italic("OPTIONS") + "]\n";
    for (const OptionView& option : options_of(app)) {
        if (option.positional)
            text += option.required ? " " + italic(option.names[0]) : " [" + italic(option.names[0]) + "]";
        else if (option.required) text += " " + bold(option.names.back()) + " " + italic(option.value);
    }
    return text + " [" + italic("OPTIONS") + "]\n";
}

} // namespace

std::string man_page(const CLI::App& app) {
    const std::string name = app.get_parent() ? "bake-" + app.get_name() : "bake";
    const std::string command = app.get_parent() ? "bake " + app.get_name() : "bake";
    std::string job = app.get_description();
    if (job.starts_with("bake: ")) job = job.substr(6);
    std::string text = ".TH " + upper(name) + " 1 \"\" \"bake " + version() + "\" \"User Commands\"\n";
    text += ".ad l\n"; // words of options are too long for lines that are flush right
    text += ".SH NAME\n" + plain(name) + " \\- " + plain(job) + "\n" + synopsis(app, command);
    if (const auto verbs = verbs_of(app); !verbs.empty()) {
        text += ".SH VERBS\n";
        for (const CLI::App* verb : verbs)
            text += ".TP\n" + bold(verb->get_name()) + "\n" + plain(verb->get_description()) + ". See " +
                    bold("bake-" + verb->get_name()) + "(1).\n";
    }
    text += ".SH OPTIONS\n";
    for (const OptionView& option : options_of(app)) text += option_text(option);
    text += examples_text(app) + exit_codes() + ".SH SEE ALSO\n";
    if (app.get_parent()) return text + bold("bake") + "(1)\n";
    std::string others;
    for (const CLI::App* verb : verbs_of(app))
        others += (others.empty() ? "" : ", ") + bold("bake-" + verb->get_name()) + "(1)";
    return text + others + "\n";
}

} // namespace bake
