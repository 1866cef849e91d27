// bake compare: how much two pictures, two normal maps, two meshes, or the methods that show a relief differ.
#include "compare_options.h"

namespace bake {

std::function<int()> compare_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<CompareArgs>();
    add_compare_options(sub, *args);
    add_examples(
        sub, "  bake compare meshes/torus_methods.toml --size 120 --spp 4 --methods plain,bump --reference displace:8\n"
             "  bake compare meshes/torus_methods.toml --size 120 --methods bump,displace:4 --reference displace:8 -o "
             "methods/\n"
             "  bake compare meshes/torus_methods.toml --size 120 --methods bump --reference displace:8 --limit "
             "outline-max=9 --json\n"
             "Two files of one kind; the first is the reference:\n"
             "  bake render meshes/torus.obj --size 128 --spp 16 -o fine.exr\n"
             "  bake render meshes/torus.obj --size 128 --spp 1 -o coarse.exr\n"
             "  bake compare fine.exr coarse.exr\n"
             "  bake compare fine.exr coarse.exr --metric flip --limit flip=0.2 -o diff.png\n"
             "  bake normal-map meshes/bricks.png -o up.png\n"
             "  bake normal-map meshes/bricks.png --directx -o down.png\n"
             "  bake compare --normals up.png down.png --limit angle-max=1\n"
             "  bake compare meshes/torus.obj meshes/sphere.obj --limit distance=2\n");
    return [args, &common, &sub] {
        const Comparing what = check_compare_usage(*args, sub);
        return what == Comparing::methods ? compare_methods(*args, common) : compare_files(*args, what, common);
    };
}

} // namespace bake
