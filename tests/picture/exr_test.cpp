#include "bake/picture/image_io.h"
#include "picture/openimageio.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {
    TEST_CASE("exr: OpenImageIO reads the same floats out of what is written, in the same order of channels") {
        const Folder folder;
        const std::string path = folder / "a.exr";
        const std::vector<std::string> names[] = {
            {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}, {"b_u", "b_v"}, {"b", "b_u", "b_v", "b_u2"}};
        for (const std::vector<std::string>& channels : names)
            for (const Depth depth : {Depth::half, Depth::float32}) {
                Image<float> image(67, 300, int(channels.size()));
                for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float(i * 7919 % 65521) / 4096 - 3;
                write_image(path, image, {.depth = depth, .channels = channels});
                const Image<float> back = read_image(path);
                CHECK(same(back, by_openimageio(folder, path)));
                if (depth == Depth::float32 && channels[0] != "b") CHECK(same(back, image));
            }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("exr: of several layers the main one is read, and the others are told") {
        const Folder folder;
        const std::string path = folder / "a.exr";
        Image<float> image(3, 2, 5);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float(i);
        write_image(path, image,
                    {.depth = Depth::float32,
                     .channels = {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
                                  "ViewLayer.Combined.A", "ViewLayer.Depth.Z"}});
        ImageInfo info;
        const Image<float> back = read_image(path, &info);
        CHECK(info.channels == std::vector<std::string>{"R", "G", "B", "A"});
        CHECK(info.alpha_channel == 3);
        REQUIRE(info.notes.size() == 1);
        CHECK(info.notes[0].find("ViewLayer.Depth.Z") != std::string::npos);
        for (int c = 0; c < 4; ++c) CHECK(back.at(2, 1, c) == image.at(2, 1, c));
        CHECK(run_bake(folder, {"cubemap", "a.exr", "--from", "latlong", "-o", "out.exr"}).code == 4); // 3 : 2
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("exr: real files are read as OpenImageIO reads them") {
        const Folder folder;
        int files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(shared_data())) {
            const std::string path = entry.path().string();
            if (entry.path().extension() != ".exr" || path.find("/bad/") != std::string::npos ||
                entry.file_size() > 300000 || files == 5)
                continue;
            const Image<float> image = read_image(path), other = by_openimageio(folder, path);
            // OpenImageIO gives the data window, which the picture is cut out of.
            if (image.width() != other.width() || image.height() != other.height()) continue;
            ++files;
            CAPTURE(path);
            CHECK(same(image, other));
        }
        CHECK(files > 3);
    }
}
