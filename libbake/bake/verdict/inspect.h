// Reports on files: measurements and findings, as text and as JSON.
#pragma once
#include "bake/mesh/check/mesh_audit.h"
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/check/mesh_distance.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/height/height.h"
#include "bake/surface/chart/uv_check.h"
#include "bake/verdict/image_check.h"
#include "bake/verdict/pair_check.h"
#include <optional>

namespace bake {

/// Warnings name faults; notes name properties that are right for many uses.
struct Findings {
    std::vector<std::string> warnings, notes;
};

struct InspectOptions {
    bool audit = false; ///< meshes: also self-intersections and orientation, with CGAL, which is slow
    MeshOptions read;   ///< meshes: options of reading
    MeshCheckOptions mesh;
    UvCheckOptions uv;
    Grey height_channel = Grey::mean; ///< pairs: channel of the height
    std::optional<bool> directx;      ///< pairs: whether green is expected to point down; none: nothing is expected
    MeshDistanceOptions distance;
    double limit = 0; ///< distances: warn if the upper bound is larger; 0 for no limit
};

/// Content of a glTF file besides its mesh.
struct GltfParts {
    std::size_t nodes = 0;           ///< nodes with a mesh
    std::size_t normal_textures = 0; ///< materials with a normal texture
    std::size_t images = 0, missing_images = 0;
    bool tangents = false;
    std::vector<std::string> notes; ///< what reading applied: skins, morph targets, instances, uv sets, transforms
};

struct MeshReport {
    std::string file;
    std::optional<GltfParts> gltf;
    MeshCheck check;
    Vec3d origin{0}; ///< of the mesh: to be added to the box of `check`
    UvCheck uv;
    bool audited = false;
    MeshAudit audit;
    std::string record; ///< how the file was made, as Mesh has it
    Findings findings;
};

struct ImageReport {
    std::string file;
    ImageCheck check;
    StepSlope step; ///< of one quantisation step, at amplitude 1 and extent 1 x height / width
    Findings findings;
};

struct PairReport {
    std::string height_file, normal_file;
    int height_width = 0, height_height = 0, normal_width = 0, normal_height = 0;
    NormalValues normal_values;
    PairCheck check;
    std::optional<bool> directx; ///< what InspectOptions expects of the green
    std::optional<PairRecipe> recipe;
    std::string height_channel; ///< as an option of the bake; empty for the mean
    Findings findings;
    /// The green is not what is expected, or unknown.
    bool unexpected() const noexcept;
};

struct DistanceReport {
    std::string file, other;
    MeshDistance distance;
    double limit = 0;
    Findings findings;
    bool over_limit() const noexcept { return limit > 0 && distance.upper > limit; }
};

/// Throw the errors of read_mesh(), read_image() and read_height().
MeshReport inspect_mesh(const std::string& path, const InspectOptions& options = {});
ImageReport inspect_image(const std::string& path, const InspectOptions& options = {});
PairReport inspect_pair(const std::string& height_path, const std::string& normal_path,
                        const InspectOptions& options = {});
DistanceReport inspect_distance(const std::string& path, const std::string& other_path,
                                const InspectOptions& options = {});

/// The findings for the measurements in a report.
Findings judge(const MeshReport& report);
Findings judge(const ImageReport& report);
Findings judge(const PairReport& report);
Findings judge(const DistanceReport& report);

/// True if the file ending is that of a mesh format, even of one that read_mesh() does not read.
bool named_like_a_mesh(const std::string& path);

/// Aligned lines, each with a newline at its end.
std::string to_text(const MeshReport& report);
std::string to_text(const ImageReport& report);
std::string to_text(const PairReport& report);
std::string to_text(const DistanceReport& report);

/// The recipe as options of `bake normal-map`; empty without one.
std::string bake_options(const PairReport& report);

/// One JSON object.
std::string to_json(const MeshReport& report);
std::string to_json(const ImageReport& report);
std::string to_json(const PairReport& report);
std::string to_json(const DistanceReport& report);

} // namespace bake
