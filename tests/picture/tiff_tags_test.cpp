// What TIFF files say beside their samples.
#include "bake/base/error.h"
#include "bake/picture/icc.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "picture/tiff_files.h"
#include <algorithm>

using namespace bake;
using namespace bake::test;

namespace {

TiffPicture grey(int width, int height) {
    TiffPicture p{.width = width, .height = height};
    for (int i = 0; i < width * height; ++i) p.levels.push_back(std::uint64_t(i + 1));
    return p;
}

bool any_note(const ImageInfo& info, const std::string& text) {
    return std::any_of(info.notes.begin(), info.notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

ImageInfo info_of(const std::string& path, Image<float>& image) {
    ImageInfo info;
    image = read_image(path, &info);
    CHECK(read_image_info(path).width == image.width());
    CHECK(info.height == image.height());
    return info;
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("tiff: each of the eight orientations is turned upright, stored plainly or not") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        // Where the first stored row and column lie, as the standard words it.
        struct {
            const char *row, *column;
        } const sides[] = {{"top", "left"}, {"top", "right"}, {"bottom", "right"}, {"bottom", "left"},
                           {"left", "top"}, {"right", "top"}, {"right", "bottom"}, {"left", "bottom"}};
        for (int orientation = 1; orientation <= 8; ++orientation)
            for (const bool tiled : {false, true}) {
                CAPTURE(orientation);
                const std::string row = sides[orientation - 1].row, column = sides[orientation - 1].column;
                TiffPicture p = grey(5, 3);
                p.orientation = orientation, p.tiled = tiled;
                write_tiff(path, p);
                Image<float> image;
                const ImageInfo info = info_of(path, image);
                const bool upright_rows = row == "top" || row == "bottom";
                REQUIRE(image.width() == (upright_rows ? 5 : 3));
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 5; ++c) {
                        int x = upright_rows ? c : r, y = upright_rows ? r : c;
                        if (row == "right" || column == "right") x = image.width() - 1 - x;
                        if (row == "bottom" || column == "bottom") y = image.height() - 1 - y;
                        CHECK(image.at(x, y) * 255 == doctest::Approx(r * 5 + c + 1));
                    }
                CHECK(any_note(info, "turned upright") == (orientation > 1));
            }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("tiff: a palette gives its colours, in 8 bits or 16, and is told to heights") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        for (const int bits : {1, 2, 4, 8}) {
            TiffPicture p{.width = 2, .height = 1, .bits = bits, .photometric = PHOTOMETRIC_PALETTE, .levels = {1, 0}};
            std::vector<std::uint16_t> red(std::size_t(1) << bits), green = red, blue = red;
            red[1] = 0x1212, green[1] = 0x3434, blue[1] = 0x5656, red[0] = 0xffff;
            write_tiff(path, {p},
                       [&](TIFF* t) { TIFFSetField(t, TIFFTAG_COLORMAP, red.data(), green.data(), blue.data()); });
            Image<float> image;
            const ImageInfo info = info_of(path, image);
            CHECK(info.channels == std::vector<std::string>{"R", "G", "B"});
            CHECK(info.bits == 8);
            CHECK(info.palette);
            CHECK(image.at(0, 0, 0) == doctest::Approx(0x12 / 255.0));
            CHECK(image.at(0, 0, 2) == doctest::Approx(0x56 / 255.0));
            CHECK(image.at(1, 0, 0) == 1);
            const Run run = run_bake(folder, {"bump-table", "a.tif", "-o", "out.exr"});
            CHECK(run.err.find("palette") != std::string::npos);
        }
    }

    TEST_CASE("tiff: inks become colours") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        for (const bool planes : {false, true}) {
            TiffPicture p{.width = 1,
                          .height = 1,
                          .per_texel = 4,
                          .photometric = PHOTOMETRIC_SEPARATED,
                          .planes = planes,
                          .levels = {255, 51, 0, 102}};
            write_tiff(path, p);
            Image<float> image;
            info_of(path, image);
            REQUIRE(image.channels() == 3);
            CHECK(image.at(0, 0, 0) == 0);
            CHECK(image.at(0, 0, 1) == doctest::Approx(0.8 * 0.6));
            CHECK(image.at(0, 0, 2) == doctest::Approx(0.6));
        }
    }

    TEST_CASE("tiff: extra samples are alpha only where the file says so, and no part of a height") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        struct {
            std::vector<std::uint16_t> kinds;
            int alpha;
        } const cases[] = {{{EXTRASAMPLE_UNSPECIFIED}, -1},
                           {{EXTRASAMPLE_UNASSALPHA}, 1},
                           {{EXTRASAMPLE_ASSOCALPHA}, 1},
                           {{EXTRASAMPLE_UNSPECIFIED, EXTRASAMPLE_UNASSALPHA}, 2}};
        for (const auto& [kinds, alpha] : cases) {
            TiffPicture p{.width = 2, .height = 2, .per_texel = 1 + int(kinds.size()), .extra = kinds};
            for (int i = 0; i < 4; ++i) {
                p.levels.push_back(std::uint64_t(50 * i));
                for (std::size_t k = 0; k < kinds.size(); ++k) p.levels.push_back(200);
            }
            write_tiff(path, p);
            Image<float> image;
            const ImageInfo info = info_of(path, image);
            CHECK(info.alpha_channel == alpha);
            CHECK(info.colours == 1);
            CHECK(any_note(info, "associated") == (kinds[0] == EXTRASAMPLE_ASSOCALPHA));
            run_bake(folder, {"bump-table", "a.tif", "--layout", "bumpslopes", "--depth", "float", "-o", "h.exr"});
            CHECK(read_level(folder / "h.exr", 0).at(1, 1, 0) == doctest::Approx(150 / 255.0));
        }
    }

    TEST_CASE("tiff: the first picture of full size is read, and others that are no smaller versions are told") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        TiffPicture small = grey(4, 3), full = grey(16, 12), mask = grey(16, 12), second = grey(16, 12);
        full.levels[0] = 200, second.levels[0] = 7;
        mask.kind = FILETYPE_MASK;
        Image<float> image;
        const auto none = [](TIFF*) {};
        const auto read = [&](const std::vector<TiffPicture>& pictures) {
            write_tiff(path, pictures, none);
            const ImageInfo info = info_of(path, image);
            CHECK(image.width() == 16);
            CHECK(image.at(0, 0) == doctest::Approx(200 / 255.0));
            return any_note(info, "pictures");
        };
        CHECK(read({small, full})); // a thumbnail that is not marked as such
        small.kind = FILETYPE_REDUCEDIMAGE;
        CHECK_FALSE(read({small, full}));
        CHECK_FALSE(read({full, grey(8, 6), grey(4, 3), grey(2, 1), grey(1, 1)}));
        CHECK(read({full, second}));
        CHECK(read({mask, full}));
    }

    TEST_CASE("tiff: texels without data are counted") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        constexpr int tag = 42113;
        static const TIFFFieldInfo field = {tag,          -1, -1, TIFF_ASCII,
                                            FIELD_CUSTOM, 1,  0,  const_cast<char*>("GDALNoData")};
        for (const int format : {SAMPLEFORMAT_UINT, SAMPLEFORMAT_INT}) {
            TiffPicture p{.width = 3, .height = 1, .bits = 16, .format = format};
            const std::uint64_t none = format == SAMPLEFORMAT_INT ? 65536 - 9999 : 9999;
            p.levels = {none, 100, none};
            write_tiff(path, {p}, [&](TIFF* t) {
                TIFFMergeFieldInfo(t, &field, 1);
                REQUIRE(TIFFSetField(t, tag, format == SAMPLEFORMAT_INT ? "-9999" : "9999") == 1);
            });
            Image<float> image;
            const ImageInfo info = info_of(path, image);
            CHECK(any_note(info, "2 texels have it"));
            const Run run = run_bake(folder, {"bump-table", "a.tif", "-o", "out.exr"});
            CHECK(run.err.find("9999") != std::string::npos);
            CHECK(run_bake(folder, {"bump-table", "a.tif", "-o", "out.exr", "--quiet"}).err.empty());
        }
    }

    TEST_CASE("tiff: a step of signed integers is that of their depth, whatever values are used") {
        const Folder folder;
        TiffPicture p{.width = 40, .height = 40, .bits = 16, .format = SAMPLEFORMAT_INT};
        p.levels = some_levels(1600, 16);
        write_tiff(folder / "a.tif", p);
        CHECK(level_step(read_image_info(folder / "a.tif")) == doctest::Approx(1 / 32767.0));
        CHECK(run_bake(folder, {"check", "a.tif"}).out.find("3.052e-05") != std::string::npos);
    }

    TEST_CASE("tiff: colours of 16 bits are tagged by a profile, data are not") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        Image<float> image(4, 2, 3), back;
        std::fill_n(image.data(), image.size(), 0.5f);
        for (const int channels : {1, 3}) {
            write_image(path, Image<float>(4, 2, channels), {.depth = Depth::u16, .colour = ColourSpace::srgb});
            CHECK(info_of(path, back).srgb_tagged);
            write_image(path, Image<float>(4, 2, channels), {.depth = Depth::u16, .colour = ColourSpace::linear});
            const ImageInfo info = info_of(path, back);
            REQUIRE_FALSE(info.colour.curves.empty());
            CHECK(info.colour.curves[0].is_linear());
            CHECK(info.colour.note.empty());
        }
        write_image(path, image, {.depth = Depth::u16});
        CHECK(info_of(path, back).colour.source.empty());
    }

    TEST_CASE("tiff: volumes, raw samples of cameras and unknown compressions are refused for what they are") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        const auto refused = [&](int tag, int value, const char* why) {
            write_tiff(path, {grey(4, 4)}, [&](TIFF* t) { TIFFSetField(t, std::uint32_t(tag), value); });
            CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains(why), Error);
        };
        refused(TIFFTAG_IMAGEDEPTH, 2, "volume");
        refused(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_CFA, "camera");
    }
}
