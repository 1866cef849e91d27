# BAKE_LIBRARIES: the libraries that this build found, which --version names.
file(STRINGS ${OPENSUBDIV_INCLUDE}/opensubdiv/version.h lines REGEX "#define OPENSUBDIV_VERSION_(MAJOR|MINOR|PATCH) ")
list(TRANSFORM lines REPLACE "[^0-9]*([0-9]+).*" "\\1")
list(JOIN lines . opensubdiv_version)
find_package(TinyGLTF QUIET)
set(libraries "")
foreach(library "CGAL ${CGAL_VERSION}" "CLI11 ${CLI11_VERSION}" "Embree ${embree_VERSION}" "GLM ${glm_VERSION}"
    "libpng ${PNG_VERSION_STRING}" "libtiff ${TIFF_VERSION_STRING}" "JSON for Modern C++ ${nlohmann_json_VERSION}" "OpenEXR ${OpenEXR_VERSION}"
    "OpenImageIO ${OpenImageIO_VERSION}" "OpenSubdiv ${opensubdiv_version}" "oneTBB ${TBB_VERSION}" "TinyGLTF ${TinyGLTF_VERSION}"
    "toml++ ${tomlplusplus_VERSION}" "zlib ${ZLIB_VERSION_STRING}")
  if(library MATCHES " [0-9]")
    list(APPEND libraries ${library})
  endif()
endforeach()
list(JOIN libraries ", " BAKE_LIBRARIES)
set_source_files_properties(tools/bake/version_text.cpp PROPERTIES COMPILE_DEFINITIONS
  "BAKE_LIBRARIES=\"${BAKE_LIBRARIES}\";BAKE_WITH_CGAL=$<BOOL:${BAKE_WITH_CGAL}>")
