// Whether a file that is named as an input is of the kind that its place on the command line asks for.
#pragma once
#include "bake/verdict/inspect.h"
#include <string>

namespace bake {

enum class FileKind { mesh, picture, scene, unknown };

/// By the ending of the name.
FileKind file_kind(const std::string& path);

/// Throw Error{Refusal::unreadable} for a file that is named like one of another kind: mesh, picture or scene. Every other name
/// is left to the reader, which looks at the content.
void expect_picture(const std::string& path);
void expect_mesh(const std::string& path);
void expect_scene(const std::string& path);

} // namespace bake
