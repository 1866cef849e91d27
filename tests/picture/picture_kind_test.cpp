#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "bake/picture/picture_kind.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

namespace {

/// The refusal of a file that begins with these bytes, "" for none.
std::string refused(const Folder& folder, const std::string& name, const std::string& bytes) try {
    write_file(folder / name, bytes);
    picture_kind(PictureFile(folder / name));
    return "";
} catch (const Error& error) {
    CHECK(error.refusal == Refusal::unreadable);
    return error.what();
}

/// Uncompressed grey, 2 x 1.
std::string tga(char descriptor = 0x20) {
    std::string bytes(18, '\0');
    bytes[2] = 3, bytes[12] = 2, bytes[14] = 1, bytes[16] = 8, bytes[17] = descriptor;
    return bytes + std::string("\x00\xff", 2);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("picture_kind: formats that are not read are refused by their name, with those that are") {
        const Folder folder;
        const auto box = [](const std::string& brand) { return std::string("\0\0\0\x20", 4) + "ftyp" + brand; };
        struct {
            std::string bytes, said;
        } const cases[] = {{"GIF89a", "a GIF"},
                           {"SDPX", "DPX"},
                           {"\x80\x2a\x5f\xd7", "Cineon"},
                           {"FOR4", "IFF"},
                           {"\x53\x80\xf6\x34", "Softimage"},
                           {"\x01\xda", "SGI"},
                           {"\x2f\x08\x67\xab", "zfile"},
                           {std::string(26, '\1') + "\xff\xfe", "RLA"},
                           {"SIMPLE  =   T", "FITS"},
                           {std::string("\0\0\1\0\1\0", 6), "icon"},
                           {box("heic"), "HEIF"},
                           {box("avif"), "AVIF"},
                           {box("isom"), "video"},
                           {"\xabKTX 11\xbb", "KTX"},
                           {"<?xml version='1.0'?><svg>", "SVG"},
                           {"%PDF-1.7", "PDF"},
                           {"PK\3\4", "ZIP"},
                           {"v 0 0 0\nv 1 0 0\n", "no format that is read"}};
        for (const auto& [bytes, said] : cases) {
            const std::string message = refused(folder, "a.png", bytes + std::string(200, '\1'));
            CAPTURE(message);
            CHECK(message.find(said) != std::string::npos);
            CHECK(message.find("PNG, EXR, TIFF, HDR, JPEG, TGA, BMP, PNM, PFM, DDS, KTX2, PSD, JPEG 2000 or WebP") !=
                  std::string::npos);
        }
        CHECK(refused(folder, "a.NEF", std::string("II*\0\x08\0\0\0", 8)).find("camera") != std::string::npos);
    }

    TEST_CASE("picture_kind: a TGA is known by its footer, or its header, or its name") {
        const Folder folder;
        const auto kind = [&](const std::string& name, const std::string& bytes) {
            write_file(folder / name, bytes);
            return picture_kind(PictureFile(folder / name));
        };
        CHECK(kind("a", tga()) == PictureKind::tga);
        CHECK(refused(folder, "a", tga('\xe0')) != ""); // reserved bits
        CHECK(kind("a.TGA", tga('\xe0')) == PictureKind::tga);
        CHECK(kind("a", tga('\xe0') + std::string(8, '\0') + std::string("TRUEVISION-XFILE.\0", 18)) ==
              PictureKind::tga);
        std::string no_size = tga();
        no_size[12] = 0;
        CHECK(refused(folder, "a.tga", no_size) != "");
    }

    TEST_CASE("picture_kind: the contents choose the decoder, not the name") {
        const Folder folder;
        const std::string grey = std::string("P5 2 1 255\n\x00\xff", 13);
        for (const char* name : {"a.png", "a.jpg", "a.exr", "a.tga", "a", "a.obj"}) {
            CAPTURE(std::string(name));
            write_file(folder / name, grey);
            ImageInfo info;
            CHECK(read_image(folder / name, &info).at(1, 0) == 1);
            CHECK(info.format == "pnm");
        }
        write_file(folder / "b.png", tga());
        CHECK(read_image(folder / "b.png").at(1, 0) == 1);
    }
}
