// Reading environments from files: finds the format, checks it, and checks whether the faces match at their seams.
#pragma once
#include "bake/environment/file/face_files.h"
#include "bake/environment/file/mend_sky.h"
#include "bake/environment/file/orientation.h"
#include "bake/environment/sky/cross.h"
#include "bake/environment/sky/environment.h"
#include "bake/environment/sky/sky_format.h"
#include <string>
#include <vector>

namespace bake {

struct ReadEnvironmentOptions {
    /// automatic: six inputs or a %s are faces; a single picture has the format of its tag or else of its shape: 2:1
    /// latlong, 4:3 hcross, 3:4 vcross, 1:6 or 6:1 strip. A square picture is refused, because ball, probe and octahedral
    /// are all square.
    SkyFormat from = SkyFormat::automatic;
    ColourSpace space = ColourSpace::automatic;
    BadPolicy bad = BadPolicy::refuse; ///< see mend_sky.h
    bool by_name = true;               ///< false: six inputs are px nx py ny pz nz, whatever their names are
    bool check_seams = true;           ///< whether to examine the seams of six faces, which takes up to a second
    bool fix_orientation = false;      ///< moves and turns the faces so that their seams match; needs check_seams
};

struct EnvironmentReport {
    SkyFormat format = SkyFormat::automatic; ///< used for reading
    std::array<std::string, 6> files;        ///< of the faces; for crosses and strips px ... nz
    std::string naming;                      ///< the words by which the faces were recognised
    std::string picture;                     ///< the file, if the sky is one picture
    CrossShape cross;                        ///< of a cross
    SkyFaults faults;                        ///< values that were replaced
    bool checked = false;                    ///< whether `orientation` is set
    OrientationCheck orientation;
    bool fixed = false; ///< the faces were moved to orientation.closes
    SampleType type = SampleType::other;
    std::vector<std::string> notes; ///< of reading the files, each with a file's name
};

/// Throws Error naming the file: as read_image, read_faces, name_faces; unsuitable when the picture does not have the
/// shape of its format, and for a probe that is not black outside its disc.
Environment read_environment(const std::vector<std::string>& inputs, const ReadEnvironmentOptions& options = {},
                             EnvironmentReport* report = nullptr);

/// Notes for the user about how a sky was read, one line each. `by_name` is that of ReadEnvironmentOptions.
std::vector<std::string> reading_notes(const EnvironmentReport& report, bool by_name = true);

} // namespace bake
