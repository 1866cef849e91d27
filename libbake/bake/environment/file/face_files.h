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
    std::string
        naming; ///< the six words by which the faces were recognised, "px nx py ny pz nz"; empty: by the order of the list
};

/// The words that stand for faces, each set in the order px nx py ny pz nz:
///   px nx py ny pz nz | px mx py my pz mz | posx negx ... | right left up down front back | ... top bottom ...
///   rt lf up dn bk ft (id Software's: bk is +Z) | rt lf up dn fr bk | +x -x +y -y +z -z | xpos xneg ... | 0 1 2 3 4 5
/// in lower case, upper case or with a capital.
///
/// Six paths: in any order if their names differ in such words, otherwise in the order px nx py ny pz nz. Throws
/// Error{Refusal::usage} for any other number of paths and for a face that is given twice; the message names the face.
FaceFiles name_faces(const std::vector<std::string>& paths);

/// The six existing files of a pattern with one `%s`, for any of the sets of words. Throws Error{Refusal::usage} when the
/// pattern does not contain exactly one `%s`, and Error{Refusal::unreadable}, naming the missing file, when no set is
/// complete.
FaceFiles find_faces(const std::string& pattern);

/// Whether a name stands for six files.
inline bool is_face_pattern(const std::string& file) { return file.find("%s") != std::string::npos; }

/// The six names that are written for a pattern: `%s` is replaced by px, nx, py, ny, pz, nz. Throws
/// Error{Refusal::usage} when the pattern does not contain exactly one `%s`.
std::array<std::string, 6> cube_files(const std::string& pattern);

/// Findings of read_faces.
struct FacesReport {
    std::array<BadTexels, 6> mended;
    ImageInfo first;                ///< of px
    std::vector<std::string> notes; ///< of reading the files, each with a file's name
};

/// Reads six faces with the channels they have, one to four. Throws Error naming the file: unreadable; unsuitable for a
/// face that is not square, or whose size, number of channels or sample type is not that of the first.
Cube read_faces(const std::array<std::string, 6>& files, const RadianceOptions& options = {},
                FacesReport* report = nullptr);

/// Reads six faces for the preview: three channels, finite. Throws as read_faces, and for fewer than three channels.
/// `notes` receives what reading the files has to tell.
Cube read_cube(const std::array<std::string, 6>& files, ColourSpace space = ColourSpace::automatic,
               std::vector<std::string>* notes = nullptr);

/// The first three channels; grey gives three equal ones.
Image<float> to_rgb(const Image<float>& image);

} // namespace bake
