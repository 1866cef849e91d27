#include "bake/relief/height/height_notes.h"
#include "bake/base/text.h"
#include "bake/relief/height/tiling.h"
#include <algorithm>

namespace bake {
namespace {

bool is_constant(const Image<float>& values) {
    return std::all_of(values.data(), values.data() + values.size(), [&](float v) { return v == values.data()[0]; });
}

std::string break_note(const BorderStep& step, const char* axis, const char* field) {
    return format(
        "does not tile in %s: the step across its border is %.3g times the mean step inside, which makes a ridge "
        "there; set `%s` to clamp, or repair the picture",
        axis, step.ratio(), field);
}

} // namespace

std::vector<std::string> height_notes(const HeightTexture& height, Wrap wrap_u, Wrap wrap_v) {
    std::vector<std::string> notes;
    const PictureKind& kind = height.kind;
    if (kind.looks == Looks::normal_map)
        notes.push_back(
            "looks like a normal map, not like a height: the mean of its channels was taken; give the height "
            "that it was made from, or choose a `grey`");
    else if (kind.looks == Looks::colour)
        notes.push_back(
            format("looks like a colour picture: its channels differ by up to %.3g of 255 levels, and their "
                   "mean was taken as the height; give a height, or choose a `grey`",
                   kind.tint));
    if (is_cut(height.info))
        notes.push_back(
            format("its samples have %d bits, of which the reader of this format gives 8: slopes are quantised; "
                   "convert the picture to PNG, TIFF or EXR",
                   height.info.bits));
    if (is_constant(height.values)) {
        notes.push_back(format("every texel has the same value, %.4g: there is no relief", height.values.data()[0]));
        return notes;
    }
    if (wrap_u != Wrap::repeat && wrap_v != Wrap::repeat) return notes;
    const Tiling tiling = measure_tiling(height.values);
    const bool u = wrap_u == Wrap::repeat && tiling.x.breaks(), v = wrap_v == Wrap::repeat && tiling.y.breaks();
    if (u && v)
        notes.push_back(break_note(tiling.x.ratio() > tiling.y.ratio() ? tiling.x : tiling.y, "x and y", "wrap"));
    else if (u || v) notes.push_back(u ? break_note(tiling.x, "x", "wrap_u") : break_note(tiling.y, "y", "wrap_v"));
    return notes;
}

} // namespace bake
