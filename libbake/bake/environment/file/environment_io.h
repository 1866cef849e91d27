// Environments from files: which format it is, whether it is what it is said to be, and whether its faces join.
#pragma once
#include "bake/environment/file/face_files.h"
#include "bake/environment/file/orientation.h"
#include "bake/environment/sky/environment.h"
#include "bake/environment/sky/layout.h"
#include <string>
#include <vector>

namespace bake {

enum class SkyFormat {
    automatic,
    faces,
    latlong,
    hcross,
    vcross,
    strip,
    ball,
    probe,
    octahedral,
    openexr_cube,
    openexr_latlong
};
const char* name(SkyFormat format) noexcept;

struct ReadEnvironmentOptions {
    /// automatic: six inputs or a %s are faces; one image is what its OpenEXR tag says, else what its shape can only be:
    /// 2:1 latlong, 4:3 hcross, 3:4 vcross, 1:6 or 6:1 strip. A square is refused: ball, probe and octahedral look alike.
    SkyFormat from = SkyFormat::automatic;
    RadianceOptions radiance;
    bool fix_orientation = false; ///< puts the faces where their seams close
};

struct EnvironmentReport {
    SkyFormat format = SkyFormat::automatic; ///< what it was read as
    std::array<std::string, 6> files;        ///< of the faces; for crosses and strips px ... nz
    std::string naming;                      ///< the words that told the faces
    BadTexels mended;                        ///< summed over the files; x, y of the first file with any
    bool checked = false;                    ///< `orientation` holds something: there were six faces
    OrientationCheck orientation;
    bool fixed = false; ///< the faces were moved as orientation.closes says
    SampleType type = SampleType::other;
};

/// Throws Error naming the file: as read_image, read_faces, name_faces; unsuitable when the picture does not have the
/// shape of its format, and for a probe or ball with something else than black outside the disc.
Environment read_environment(const std::vector<std::string>& inputs, const ReadEnvironmentOptions& options = {},
                             EnvironmentReport* report = nullptr);

} // namespace bake
