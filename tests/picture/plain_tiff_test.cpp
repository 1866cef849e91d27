#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_io.h"
#include "bake/picture/plain_tiff.h"
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

using namespace bake;

namespace {

/// A folder that goes away with it.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("plain_tiff_test_" + std::to_string(getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const char* name) const { return (path / name).string(); }
};

Image<float> pattern(int width, int height, int channels) {
    Image<float> image(width, height, channels);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float((i * 7919) % 65536) / 65535;
    return image;
}

std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// A 16 x 16 file of 8 bits whose directory lies before its one or two strips, as some programs write it.
std::string directory_first(int strips, std::uint32_t orientation) {
    const std::uint32_t beyond = 8 + 2 + 10 * 12 + 4, samples = beyond + 16, rows = 16 / strips;
    const std::uint32_t arrays[4] = {samples, samples + 128, 128, 128};
    const std::uint32_t offsets = strips == 1 ? samples : beyond, counts = strips == 1 ? 256 : beyond + 8,
                        count = strips;
    const std::uint32_t entries[10][3] = {{256, 1, 16},   {257, 1, 16},          {258, 1, 8},           {259, 1, 1},
                                          {262, 1, 1},    {273, count, offsets}, {274, 1, orientation}, {277, 1, 1},
                                          {278, 1, rows}, {279, count, counts}};
    std::string bytes("II*\0\10\0\0\0\12\0", 10);
    const auto put = [&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); };
    for (const auto& [tag, many, value] : entries) {
        const std::uint16_t start[2] = {std::uint16_t(tag), 4};
        put(start, 4), put(&many, 4), put(&value, 4);
    }
    bytes.append(4, '\0');
    put(arrays, 16);
    return bytes + std::string(256, '\x40');
}

bool same(const Image<float>& a, const Image<float>& b) {
    return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("plain_tiff: grey files of every depth hold the same floats and say the same of themselves as through "
              "OpenImageIO") {
        const Folder folder;
        for (const Depth depth : {Depth::u8, Depth::u16, Depth::float32})
            for (const auto& [width, height] : {std::pair(1, 1), {37, 64}, {640, 129}}) {
                const std::string plain = folder / "plain.tif", zipped = folder / "zipped.tif";
                write_image(plain, pattern(width, height, 1), {.depth = depth});
                write_image(zipped, pattern(width, height, 1), {.depth = depth, .compression = Compression::zip});
                REQUIRE(find_plain_tiff(plain, {}));
                REQUIRE_FALSE(find_plain_tiff(zipped, {}));
                ImageInfo info, want;
                const Image<float> image = read_image(plain, &info), reference = read_image(zipped, &want);
                CHECK(same(image, reference));
                CHECK(info.format == want.format);
                CHECK(info.type == want.type);
                CHECK(info.bits == want.bits);
                CHECK(info.channels == want.channels);
                CHECK(info.srgb_tagged == want.srgb_tagged);
                CHECK(info.alpha_channel == want.alpha_channel);
            }
    }

    TEST_CASE("plain_tiff: OpenImageIO reads what it writes, with any number of channels and alpha where it is") {
        const Folder folder;
        const std::string path = folder / "out.tif";
        for (const int channels : {2, 3, 4, 6}) {
            const Image<float> image = pattern(70, 130, channels);
            WriteOptions options;
            if (channels == 2) options.channels = {"b_u", "b_v"};
            write_image(path, image, options);
            REQUIRE_FALSE(find_plain_tiff(path, {})); // more than one channel: read by OpenImageIO
            ImageInfo info;
            CHECK(same(read_image(path, &info), image));
            CHECK(info.alpha_channel == (channels == 4 ? 3 : -1));
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("plain_tiff: the same bytes on every run and for any number of threads") {
        const Folder folder;
        const std::string path = folder / "out.tif";
        std::string first;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            write_image(path, pattern(300, 200, 1), {.depth = Depth::u16});
            if (first.empty()) first = bytes_of(path);
            CHECK(bytes_of(path) == first);
        }
    }

    TEST_CASE("plain_tiff: strips in any order are read in theirs") {
        const Folder folder;
        const std::string path = folder / "in.tif", swapped = folder / "swapped.tif";
        const Image<float> image = pattern(16, 128, 1); // two strips of 64 rows
        write_image(path, image, {.depth = Depth::float32});
        const auto tiff = find_plain_tiff(path, {});
        REQUIRE(tiff);
        REQUIRE(tiff->strips.size() == 2);
        std::string bytes = bytes_of(path);
        const auto offset = [&](int i) { return std::uint32_t(tiff->strips[i]); };
        const std::uint32_t before[2] = {offset(0), offset(1)}, after[2] = {offset(1), offset(0)};
        const std::size_t at = bytes.rfind(std::string(reinterpret_cast<const char*>(before), 8));
        REQUIRE(at != std::string::npos);
        std::memcpy(bytes.data() + at, after, 8);
        write_bytes(swapped, bytes);
        const Image<float> read = read_image(swapped);
        CHECK(read.at(3, 64) == image.at(3, 0));
        CHECK(read.at(3, 0) == image.at(3, 64));
    }
}

TEST_SUITE("stability") {

    TEST_CASE("plain_tiff: a file cut anywhere is refused, never read in part") {
        const Folder folder;
        const std::string path = folder / "in.tif", cut = folder / "cut.tif";
        for (const int channels : {1, 3}) {
            write_image(path, pattern(40, 100, channels), {.depth = Depth::u16});
            const std::string bytes = bytes_of(path);
            for (std::size_t length = 0; length < bytes.size(); length += length < 400 ? 13 : 701) {
                write_bytes(cut, bytes.substr(0, length));
                CHECK_FALSE(find_plain_tiff(cut, {}));
                CHECK_THROWS_AS(read_image(cut), Error);
            }
        }
    }

    TEST_CASE(
        "plain_tiff: a file whose last rows are missing is refused where its directory comes first, whoever reads it") {
        const Folder folder;
        const std::string path = folder / "in.tif";
        for (const int strips : {1, 2})
            for (const std::uint32_t orientation : {1u, 2u}) { // 2, mirrored, is for OpenImageIO
                const std::string bytes = directory_first(strips, orientation);
                write_bytes(path, bytes);
                CHECK(find_plain_tiff(path, {}).has_value() == (orientation == 1));
                CHECK_FALSE(is_cut_short_tiff(path));
                CHECK(read_image(path).at(15, 15) == doctest::Approx(64 / 255.0));
                for (const std::size_t missing : {1, 128, 129, 255}) {
                    write_bytes(path, bytes.substr(0, bytes.size() - missing));
                    CHECK_FALSE(find_plain_tiff(path, {}));
                    CHECK(is_cut_short_tiff(path));
                    CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains("is cut short"), Error);
                }
            }
    }

    TEST_CASE(
        "plain_tiff: a header with any one byte changed is read whole, or left to OpenImageIO, and never crashes") {
        const Folder folder;
        const std::string path = folder / "in.tif", changed = folder / "changed.tif";
        write_image(path, pattern(40, 100, 1), {.depth = Depth::u16});
        const std::string bytes = bytes_of(path);
        for (std::size_t i = 0; i < bytes.size();
             i = i == 7 ? 8 + 2 * 40 * 100 : i + 1) // header and directory, not the samples
            for (const char value : {'\0', '\1', '\x7f', '\xff'}) {
                std::string other = bytes;
                other[i] = value;
                write_bytes(changed, other);
                if (const auto tiff = find_plain_tiff(changed, {.max_bytes = 1 << 24}))
                    CHECK(read_plain_tiff(changed, *tiff).size() > 0);
            }
    }

    TEST_CASE("plain_tiff: a picture over the limit is not read here") {
        const Folder folder;
        const std::string path = folder / "in.tif";
        write_image(path, pattern(64, 64, 1), {.depth = Depth::u16});
        CHECK(find_plain_tiff(path, {.max_bytes = 4 * 64 * 64}));
        CHECK_FALSE(find_plain_tiff(path, {.max_bytes = 4 * 64 * 64 - 1}));
        CHECK_THROWS_AS(read_image(path, nullptr, {.max_bytes = 4 * 64 * 64 - 1}), Error);
    }
}
