#include "bake/picture/picture_kind.h"
#include "bake/base/text.h"
#include "bake/picture/masked_texels.h"
#include <algorithm>
#include <optional>
#include <string_view>

namespace bake {
namespace {

using namespace std::string_view_literals;

constexpr const char* mend =
    "export it as PNG, EXR, TIFF, HDR, JPEG, TGA, BMP, PNM, PFM, DDS, KTX2, PSD, JPEG 2000 or WebP";

struct Signature {
    std::size_t offset;
    std::string_view bytes;
    PictureKind kind;
};

constexpr Signature signatures[] = {
    {0, "\x89PNG"sv, PictureKind::png},
    {0, "\x76\x2f\x31\x01"sv, PictureKind::exr},
    {0, "II*\0"sv, PictureKind::tiff},
    {0, "MM\0*"sv, PictureKind::tiff},
    {0, "II+\0"sv, PictureKind::tiff}, // BigTIFF
    {0, "MM\0+"sv, PictureKind::tiff},
    {0, "#?"sv, PictureKind::hdr}, // the name of the program follows, mostly RADIANCE or RGBE
    {0, "\xff\xd8\xff"sv, PictureKind::jpeg},
    {0, "DDS "sv, PictureKind::dds},
    {0, "\xabKTX 20\xbb"sv, PictureKind::ktx2},
    {0, "8BPS"sv, PictureKind::psd},
    {0, "\0\0\0\x0cjP  \r\n\x87\n"sv, PictureKind::jpeg2000},
    {0, "\xff\x4f\xff\x51"sv, PictureKind::jpeg2000}, // a codestream without boxes
    {8, "WEBP"sv, PictureKind::webp},                 // after "RIFF" and a size
    {0, "BM"sv, PictureKind::bmp},
};

struct OtherFormat {
    std::size_t offset;
    std::string_view bytes;
    const char* name; ///< with its article
};

constexpr OtherFormat other_formats[] = {
    {0, "GIF8"sv, "a GIF"},
    {0, "SDPX"sv, "a DPX picture"},
    {0, "XPDS"sv, "a DPX picture"},
    {0, "\x80\x2a\x5f\xd7"sv, "a Cineon picture"},
    {0, "\xd7\x5f\x2a\x80"sv, "a Cineon picture"},
    {0, "FOR4"sv, "an IFF picture"},
    {0, "FOR8"sv, "an IFF picture"},
    {0, "FORM"sv, "an IFF picture"},
    {0, "\x53\x80\xf6\x34"sv, "a Softimage PIC picture"},
    {0, "\x01\xda"sv, "an SGI picture"},
    {0, "\x2f\x08\x67\xab"sv, "a zfile depth map"},
    {0, "\xab\x67\x08\x2f"sv, "a zfile depth map"},
    {0, "SIMPLE  ="sv, "a FITS picture"},
    {0, "\0\0\1\0"sv, "an icon (ICO)"},
    {4, "ftypheic"sv, "a HEIF picture"},
    {4, "ftypheix"sv, "a HEIF picture"},
    {4, "ftypmif1"sv, "a HEIF picture"},
    {4, "ftypmsf1"sv, "a HEIF picture"},
    {4, "ftypavif"sv, "an AVIF picture"},
    {4, "ftypavis"sv, "an AVIF picture"},
    {4, "ftypcrx "sv, "raw samples of a camera"},
    {4, "ftypqt"sv, "a video"},
    {4, "ftyp"sv, "a video"},
    {8, "AVI "sv, "a video"},
    {0, "\x1a\x45\xdf\xa3"sv, "a video"},
    {0, "OggS"sv, "a video or a sound"},
    {0, "\0\0\1\xba"sv, "a video"},
    {0, "\0\0\1\xb3"sv, "a video"},
    {0, "\xabKTX 11\xbb"sv, "a KTX texture"},
    {0, "\xff\x0a"sv, "a JPEG XL picture"},
    {0, "\0\0\0\x0cJXL "sv, "a JPEG XL picture"},
    {0, "II\xbc\1"sv, "a JPEG XR picture"},
    {0, "\xff\xd8"sv, "a JPEG without its second marker"},
    {0, "\x8aMNG"sv, "an MNG animation"},
    {0, "\x8bJNG"sv, "a JNG picture"},
    {0, "gimp xcf"sv, "a GIMP picture (XCF)"},
    {0, "P7\n"sv, "a PAM picture"},
    {0, "qoif"sv, "a QOI picture"},
    {0, "Ptex"sv, "a Ptex texture"},
    {0, "\x20\x42\x44\x56"sv, "an OpenVDB volume"},
    {0, "\x89HDF"sv, "an HDF5 file"},
    {0, "FUJIFILM"sv, "raw samples of a camera"},
    {128, "DICM"sv, "a DICOM picture"},
    {0, "%PDF"sv, "a PDF"},
    {0, "%!PS"sv, "a PostScript file"},
    {0, "PK\3\4"sv, "a ZIP archive"},
    {0, "\x1f\x8b"sv, "a gzip archive"},
    {0, "7z\xbc\xaf"sv, "a 7z archive"},
    {0, "\177ELF"sv, "a program"},
};

bool has(const std::string& head, std::size_t offset, std::string_view bytes) noexcept {
    return head.size() >= offset + bytes.size() && std::string_view(head).substr(offset, bytes.size()) == bytes;
}

/// Raw samples of cameras are in TIFF too, and the picture that TIFF readers find there is a thumbnail.
bool is_named_camera_raw(const std::string& path) {
    constexpr std::string_view raw[] = {".dng", ".cr2", ".nef", ".nrw", ".arw", ".sr2", ".srf", ".pef",
                                        ".srw", ".3fr", ".iiq", ".erf", ".mef", ".mos", ".dcr", ".kdc"};
    return std::find(std::begin(raw), std::end(raw), ending(path)) != std::end(raw);
}

/// Portable pixmaps and floatmaps: two letters, then white space or a comment.
std::optional<PictureKind> portable_kind(const std::string& head) noexcept {
    if (head.size() < 3 || head[0] != 'P' || "\t\n\v\f\r #"sv.find(head[2]) == std::string_view::npos) return {};
    if (head[1] == 'F' || head[1] == 'f') return PictureKind::pfm;
    return head[1] >= '1' && head[1] <= '6' ? std::optional(PictureKind::pnm) : std::nullopt;
}

bool has_tga_footer(const PictureFile& file) {
    constexpr std::string_view truevision = "TRUEVISION-XFILE.\0"sv;
    std::string foot(truevision.size(), '\0');
    file.read(std::max<std::int64_t>(0, file.size() - std::int64_t(foot.size())), foot.data(),
              std::int64_t(foot.size()));
    return foot == truevision;
}

/// Truevision, "TGA File Format Specification", version 2. Files of the first version are known by the values of their
/// header alone; what these leave open, the ending decides.
bool is_tga(const PictureFile& file) {
    const std::string& head = file.head();
    if (head.size() < 18) return false;
    const auto byte = [&](std::size_t at) { return little_endian(head, at, 1); };
    const auto one_of = [](std::uint32_t value, std::initializer_list<std::uint32_t> known) {
        return std::find(known.begin(), known.end(), value) != known.end();
    };
    const std::uint32_t map = byte(1), type = byte(2), map_bits = byte(7), bits = byte(16), descriptor = byte(17);
    const bool sized = little_endian(head, 12, 2) > 0 && little_endian(head, 14, 2) > 0;
    if (map > 1 || !one_of(type, {1, 2, 3, 9, 10, 11}) || !sized) return false;
    if (has_tga_footer(file) || ending(file.path()) == ".tga") return true;
    const bool indexed = type == 1 || type == 9, grey = type == 3 || type == 11;
    const bool depth = indexed || grey ? one_of(bits, {8, 16}) : one_of(bits, {15, 16, 24, 32});
    const bool palette =
        indexed ? map == 1 && one_of(map_bits, {15, 16, 24, 32}) : map == 0 && little_endian(head, 3, 4) == 0;
    return depth && palette && (descriptor & 0xc0) == 0 && (descriptor & 0x0f) <= 8;
}

/// Text that begins like a drawing.
bool is_svg(const std::string& head) {
    return (head.starts_with("<?xml") || head.starts_with("<svg") || head.starts_with("<!--")) &&
           head.find("<svg") != std::string::npos;
}

} // namespace

PictureKind picture_kind(const PictureFile& file) {
    const std::string& head = file.head();
    const auto refused = [&](const std::string& name) {
        return unreadable(file.path(), "is " + name + ", which is not read", mend);
    };
    for (const Signature& signature : signatures)
        if (has(head, signature.offset, signature.bytes)) {
            if (signature.kind == PictureKind::tiff && is_named_camera_raw(file.path()))
                throw refused("raw samples of a camera");
            return signature.kind;
        }
    if (const auto portable = portable_kind(head)) return *portable;
    for (const OtherFormat& other : other_formats)
        if (has(head, other.offset, other.bytes)) throw refused(other.name);
    if (is_svg(head)) throw refused("an SVG drawing");
    if (is_tga(file)) return PictureKind::tga;
    if (has(head, 26, "\xff\xfe"sv)) throw refused("an RLA picture"); // the revision, in the midst of the header
    throw unreadable(file.path(), "is in no format that is read, or its beginning is damaged", mend);
}

} // namespace bake
