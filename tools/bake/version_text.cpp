#include "version_text.h"
#include "bake/base/version.h"

namespace bake {

std::string version_text() {
    std::string text = std::string("bake ") + version() + " (commit " + source_commit + ")\n";
    text += BAKE_WITH_CGAL ? "Licence: GPL-3.0-or-later, because CGAL is built in; the sources are Apache-2.0\n"
                           : "Licence: Apache-2.0; built without CGAL\n";
    return text + "Built with " BAKE_LIBRARIES;
}

} // namespace bake
