#include "pages/completion.h"
#include "bake/base/error.h"
#include "pages/option_view.h"

namespace bake {
namespace {

/// The text as one word of a shell.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
    return out;
}

std::string verb_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : verbs_of(app)) names.push_back(verb->get_name());
    return joined(names, " ");
}

/// What bash completes within one verb. An option that takes a file leaves COMPREPLY empty, which means names of files.
std::string bash_verb(const CLI::App& verb) {
    std::string flags, values;
    for (const OptionView& option : options_of(verb)) {
        if (option.positional) continue;
        flags += (flags.empty() ? "" : " ") + joined(option.names, " ");
        if (option.value.empty()) continue;
        values += "        " + joined(option.names, "|") + ") ";
        values += option.choices.empty() ? "return;;\n" : "words='" + joined(option.choices, " ") + "';;\n";
    }
    return "    " + verb.get_name() + ")\n      case $before in\n" + values +
           "        *) [[ $word == -* ]] && words='" + flags + "';;\n      esac;;\n";
}

std::string for_bash(const CLI::App& app) {
    std::string text = "# Completion of bake for bash.\n"
                       "_bake() {\n"
                       "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
                       "  # bash takes = for a word of its own.\n"
                       "  [[ $word == = ]] && word=\n"
                       "  [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD-2]}\n"
                       "  COMPREPLY=()\n"
                       "  if ((COMP_CWORD == 1)); then\n"
                       "    COMPREPLY=($(compgen -W '" +
                       verb_names(app) +
                       " help --help --version' -- \"$word\"))\n"
                       "    return\n"
                       "  fi\n"
                       "  case ${COMP_WORDS[1]} in\n"
                       "    help) words='" +
                       verb_names(app) + "';;\n";
    for (const CLI::App* verb : verbs_of(app)) text += bash_verb(*verb);
    return text + "  esac\n"
                  "  [[ -n $words ]] && COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
                  "}\n"
                  "complete -o default -F _bake bake\n";
}

/// A text within the brackets of _arguments, or between its colons.
std::string zsh_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string zsh_value(const OptionView& option) {
    if (option.value.empty() && !option.positional) return "";
    const std::string name = zsh_text(option.value.empty() ? option.names[0] : option.value);
    if (!option.choices.empty()) return ":" + name + ":(" + joined(option.choices, " ") + ")";
    return ":" + name + ":" + (option.file || option.positional ? "_files" : " ");
}

std::string zsh_option(const OptionView& option) {
    if (option.positional) return "        " + quoted("*" + zsh_value(option)) + " \\\n";
    std::string text;
    for (const std::string& name : option.names)
        text += "        " +
                quoted("(" + joined(option.names, " ") + ")" + name + "[" + zsh_text(option.description) + "]" +
                       zsh_value(option)) +
                " \\\n";
    return text;
}

std::string for_zsh(const CLI::App& app) {
    std::string text = "#compdef bake\n"
                       "# Completion of bake for zsh.\n"
                       "_bake() {\n"
                       "  local context state line\n"
                       "  local -a verbs=(\n";
    for (const CLI::App* verb : verbs_of(app)) {
        std::string job;
        for (const char c : verb->get_description()) job += c == ':' ? std::string("\\:") : std::string(1, c);
        text += "    " + quoted(verb->get_name() + ":" + job) + "\n";
    }
    text += "  )\n"
            "  if ((CURRENT == 2)); then\n"
            "    _describe verb verbs\n"
            "    return\n"
            "  fi\n"
            "  local verb=$words[2]\n"
            "  shift words\n"
            "  ((CURRENT--))\n"
            "  case $verb in\n"
            "    help) _describe verb verbs;;\n";
    for (const CLI::App* verb : verbs_of(app)) {
        text += "    " + verb->get_name() + ")\n      _arguments -s \\\n";
        // _arguments knows one pattern for all positional words.
        bool positional = false;
        for (const OptionView& option : options_of(*verb))
            if (!option.positional || !std::exchange(positional, true)) text += zsh_option(option);
        text += "      ;;\n";
    }
    return text + "  esac\n"
                  "}\n"
                  "_bake \"$@\"\n";
}

std::string for_fish(const CLI::App& app) {
    std::string text = "# Completion of bake for fish.\n"
                       "complete -c bake -n __fish_use_subcommand -f -l help -d 'Print this help'\n"
                       "complete -c bake -n __fish_use_subcommand -f -l version -d 'Print the version'\n";
    for (const CLI::App* verb : verbs_of(app)) {
        text += "complete -c bake -n __fish_use_subcommand -f -a " + verb->get_name() + " -d " +
                quoted(verb->get_description()) + "\n";
        for (const OptionView& option : options_of(*verb)) {
            if (option.positional) continue;
            text += "complete -c bake -n '__fish_seen_subcommand_from " + verb->get_name() + "'";
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.choices.empty()) text += " -x -a " + quoted(joined(option.choices, " "));
            else if (!option.value.empty()) text += option.file ? " -r -F" : " -x";
            text += " -d " + quoted(option.description) + "\n";
        }
    }
    return text;
}

} // namespace

std::string completion(const CLI::App& app, const std::string& shell) {
    if (shell == "bash") return for_bash(app);
    if (shell == "zsh") return for_zsh(app);
    if (shell == "fish") return for_fish(app);
    throw Error(Refusal::usage, shell + ": is not a shell with completion; bash, zsh and fish have it");
}

} // namespace bake
