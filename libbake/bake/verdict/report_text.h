// Lines of reports.
#pragma once
#include "bake/verdict/inspect.h"
#include <string>

namespace bake {

/// "  name           value" and a newline.
std::string row(const std::string& name, const std::string& value);
/// A line for each note and each warning.
std::string finding_rows(const Findings& findings);
/// The same, and "nothing wrong" without warnings.
std::string endings(const Findings& findings);

} // namespace bake
