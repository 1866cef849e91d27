#include "bake/verdict/report_text.h"
#include "bake/base/printable.h"
#include "bake/base/text.h"

namespace bake {

std::string row(const std::string& name, const std::string& value) {
    return format("  %-14s ", printable(name).c_str()) + printable(value) + "\n";
}

std::string finding_rows(const Findings& findings) {
    std::string text;
    for (const std::string& note : findings.notes) text += row("note", note);
    for (const std::string& warning : findings.warnings) text += "  warning: " + printable(warning) + "\n";
    return text;
}

std::string endings(const Findings& findings) {
    return finding_rows(findings) + (findings.warnings.empty() ? "  nothing wrong\n" : "");
}

} // namespace bake
