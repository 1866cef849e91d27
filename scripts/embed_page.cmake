# Makes the source file that holds the page of reports: cmake -D ESBUILD=... -D PAGE=folder -D OUT=page_assets.cpp -P
# embed_page.cmake. Without esbuild the strings are empty.
get_filename_component(folder ${OUT} DIRECTORY)
set(page "")
set(style "")
set(script "")
if(ESBUILD)
  # iife: the script leaves no names behind. The page runs in browsers from 2020 on.
  foreach(part main.js page.css)
    execute_process(COMMAND ${ESBUILD} ${PAGE}/${part} --bundle --minify --format=iife --target=es2020 --charset=ascii
      --log-level=warning --outfile=${folder}/${part} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  file(READ ${PAGE}/page.html page)
  file(READ ${folder}/main.js script)
  file(READ ${folder}/page.css style)
endif()
# A raw string each, between delimiters that the parts do not have.
file(WRITE ${OUT} "#include \"bake/verdict/report/page_assets.h\"
namespace bake {
const char* const page_template = R\"page(${page})page\";
const char* const page_style = R\"page(${style})page\";
const char* const page_script = R\"page(${script})page\";
} // namespace bake
")
