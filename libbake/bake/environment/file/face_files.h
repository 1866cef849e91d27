// Six face files: finds which file is which face, by its name, by a pattern or by its position in a list, and reads them.
#pragma once
#include "bake/environment/file/radiance.h"
#include "bake/environment/sky/cube.h"
#include <array>
#include <string>
#include <vector>

namespace bake {

/// Six files in the order of CubeFace.
struct FaceFiles {
    std::array<std::string, 6> files;
    /// The six parts of the names by which the faces were recognised, "px nx py ny pz nz"; empty: by the order of the list.
    std::string naming;
};

/// Six paths: in any order if the parts of their names that differ, or of the names of their folders, are words of one kind
/// (face_names.h), otherwise in the order px nx py ny pz nz. Throws Error{Refusal::usage} for any other number of paths and
/// for a face that is given twice; the message names the face.
FaceFiles name_faces(const std::vector<std::string>& paths);

/// Six paths in the order px nx py ny pz nz, whatever their names are. Throws Error{Refusal::usage} for equal ones.
FaceFiles faces_in_order(const std::vector<std::string>& paths);

/// The six existing files of a pattern with one `%s`, which is replaced by words of one kind that are written alike.
/// Throws Error{Refusal::usage} when the pattern does not contain exactly one `%s`, and Error{Refusal::unreadable}, naming
/// the missing file, when no six files are complete.
FaceFiles find_faces(const std::string& pattern);

/// Whether a name stands for six files.
inline bool is_face_pattern(const std::string& file) { return file.find("%s") != std::string::npos; }

/// The six names that are written for a pattern: `%s` is replaced by px, nx, py, ny, pz, nz. Throws
/// Error{Refusal::usage} when the pattern does not contain exactly one `%s`.
std::array<std::string, 6> cube_files(const std::string& pattern);

/// Reads six faces with the channels they have, one to four, and all their values. `first` is the header of px, with
/// the notes of all six files, each after the name of its file. Throws Error naming the file: unreadable, or
/// unsuitable for a face that is not square, or whose size, number of channels or sample type is not that of the
/// first.
Cube read_faces(const std::array<std::string, 6>& files, ColourSpace space = ColourSpace::automatic,
                ImageInfo* first = nullptr);

/// The first three channels; grey gives three equal ones.
Image<float> to_rgb(const Image<float>& image);

} // namespace bake
