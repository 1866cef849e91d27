#include "bake/picture/tiff_pages.h"
#include <algorithm>
#include <vector>

namespace bake {
namespace {

struct Page {
    std::uint64_t offset = 0; ///< of the directory
    std::int64_t width = 0, height = 0;
    bool reduced = false, mask = false;

    double area() const noexcept { return double(width) * double(height); }
};

Page page_of(const TiffFile& tiff) {
    const auto kind = tiff.value<std::uint32_t>(TIFFTAG_SUBFILETYPE);
    const auto old_kind = tiff.value<std::uint16_t>(TIFFTAG_OSUBFILETYPE);
    return {TIFFCurrentDirOffset(tiff.get()), tiff.value<std::uint32_t>(TIFFTAG_IMAGEWIDTH),
            tiff.value<std::uint32_t>(TIFFTAG_IMAGELENGTH),
            (kind & FILETYPE_REDUCEDIMAGE) != 0 || old_kind == OFILETYPE_REDUCEDIMAGE, (kind & FILETYPE_MASK) != 0};
}

/// Pictures below a main one that is a thumbnail: raw photographs keep theirs there.
std::vector<std::uint64_t> directories_below(const TiffFile& tiff) {
    std::uint16_t count = 0;
    std::uint64_t* offsets = nullptr;
    if (TIFFGetField(tiff.get(), TIFFTAG_SUBIFD, &count, &offsets) != 1 || !offsets) return {};
    return {offsets, offsets + count};
}

std::vector<Page> all_pages(TiffFile& tiff) {
    constexpr std::size_t most_pages = 1000;
    std::vector<Page> pages;
    std::vector<std::uint64_t> below;
    do {
        pages.push_back(page_of(tiff));
        if (!pages.back().reduced) continue;
        const std::vector<std::uint64_t> here = directories_below(tiff);
        below.insert(below.end(), here.begin(), here.end());
    } while (pages.size() < most_pages && TIFFReadDirectory(tiff.get()));
    for (const std::uint64_t offset : below)
        if (pages.size() < most_pages && TIFFSetSubDirectory(tiff.get(), offset)) pages.push_back(page_of(tiff));
    return pages;
}

/// Whether `page` is the next level of a mip chain that contains `larger`.
bool is_level_of(const Page& page, const Page& larger) noexcept {
    const auto halves = [](std::int64_t small, std::int64_t large) {
        return small == std::max<std::int64_t>(1, large / 2) || small == (large + 1) / 2;
    };
    return halves(page.width, larger.width) && halves(page.height, larger.height) && page.area() < larger.area();
}

} // namespace

std::string choose_page(TiffFile& tiff) {
    if (TIFFLastDirectory(tiff.get()) && !page_of(tiff).reduced) return {};
    const std::vector<Page> pages = all_pages(tiff);
    // What follows a whole picture may be damaged.
    tiff.messages().error.clear();
    double largest = 0;
    bool any_whole = false;
    for (const Page& page : pages) any_whole |= !page.reduced && !page.mask;
    const auto is_candidate = [&](const Page& page) { return !page.mask && !(any_whole && page.reduced); };
    for (const Page& page : pages)
        if (is_candidate(page)) largest = std::max(largest, page.area());
    // Thumbnails are not always marked as such; pages of a document differ little.
    const auto chosen = std::find_if(
        pages.begin(), pages.end(), [&](const Page& page) { return is_candidate(page) && page.area() >= largest / 2; });
    if (chosen == pages.end() || !TIFFSetSubDirectory(tiff.get(), chosen->offset))
        tiff.fail("has no picture that could be read");
    std::size_t others = 0;
    const Page* level = &*chosen;
    for (const Page& page : pages) {
        if (&page == &*chosen) continue;
        if (&page > level && is_level_of(page, *level)) level = &page;
        else others += !page.reduced;
    }
    if (others == 0) return {};
    return "has " + std::to_string(pages.size()) + " pictures (pages): number " +
           std::to_string(chosen - pages.begin() + 1) + " is read, the others are left out";
}

} // namespace bake
