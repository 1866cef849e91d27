# Makes the source file that names the commit: cmake -D SOURCE=folder -D OUT=commit.cpp -P embed_commit.cmake. The file is
# written only if the commit is another one, so that nothing is compiled without need. In an archive that git made, which
# has no history, the name of the commit stands in libbake/install/commit.txt.
cmake_policy(VERSION 3.25)
set(commit "unknown")
file(STRINGS ${SOURCE}/libbake/install/commit.txt archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  set(commit ${archived})
elseif(EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git -C ${SOURCE} rev-parse --short=10 HEAD OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit ${head})
    execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD RESULT_VARIABLE modified ERROR_QUIET)
    if(modified)
      string(APPEND commit -modified)
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#include \"version_text.h\"
namespace bake {
const char* const source_commit = \"@commit@\";
} // namespace bake
" @ONLY)
