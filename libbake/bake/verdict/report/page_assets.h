// The parts of the page of reports, which scripts/embed_page.cmake makes of the files in page/. Empty if esbuild was not
// there when bake was built.
#pragma once

namespace bake {

/// HTML with places such as {{style}}.
extern const char* const page_template;
extern const char* const page_style;
extern const char* const page_script;

} // namespace bake
