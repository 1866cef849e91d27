// How pictures say that their colours are encoded.
#include "bake/picture/icc.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "picture/png_bytes.h"
#include <cmath>
#include <zlib.h>

using namespace bake;
using namespace bake::test;

namespace {

std::string gamma_chunk(std::uint32_t value) { return png_chunk("gAMA", big_endian(value)); }

std::string profile_chunk(const std::string& name, const std::string& profile) {
    std::string packed(compressBound(uLong(profile.size())), '\0');
    uLongf size = uLongf(packed.size());
    REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(profile.data()),
                     uLong(profile.size())) == Z_OK);
    return png_chunk("iCCP", name + '\0' + '\0' + packed.substr(0, size));
}

/// The linear value of a texel of half the range, in a PNG with these chunks.
double half_of(const Folder& folder, int bits, const std::string& chunks, std::size_t* notes = nullptr,
               ColourSpace space = ColourSpace::automatic) {
    const std::string sample = bits == 16 ? std::string("\x80\x00", 2) : std::string("\x80");
    write_file(folder / "a.png", png_bytes(1, 1, bits, 2, {sample + sample + sample}, chunks));
    ImageInfo info;
    Image<float> image = read_image(folder / "a.png", &info);
    linearise(image, space, info);
    if (notes) *notes = info.notes.size();
    return image.at(0, 0, 1);
}

double srgb(double v) { return std::pow((v + 0.055) / 1.055, 2.4); }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("colour: a PNG is decoded by its sRGB chunk, its profile's curve or its gamma") {
        const Folder folder;
        const double x8 = 128 / 255.0, x16 = 32768 / 65535.0;
        std::size_t notes = 0;
        const auto near = [](double v) { return doctest::Approx(v).epsilon(1e-4); };
        CHECK(half_of(folder, 8, "", &notes) == near(srgb(x8)));
        CHECK(notes == 0);
        CHECK(half_of(folder, 16, "", &notes) == near(x16)); // untagged: linear, and said so
        CHECK(notes == 1);
        CHECK(half_of(folder, 16, srgb_tag(), &notes) == near(srgb(x16)));
        CHECK(notes == 0);
        CHECK(half_of(folder, 16, gamma_chunk(45455)) == near(srgb(x16)));
        CHECK(half_of(folder, 8, gamma_chunk(100000), &notes) == near(x8));
        CHECK(notes == 0);
        CHECK(half_of(folder, 8, gamma_chunk(55556)) == near(std::pow(x8, 1.8)));
        CHECK(half_of(folder, 16, profile_chunk("some name", make_icc(true, false)), &notes) == near(srgb(x16)));
        CHECK(notes == 0);
        CHECK(half_of(folder, 8, profile_chunk("sRGB", make_icc(false, false))) == near(x8)); // not by its name
        CHECK(half_of(folder, 8, png_chunk("cICP", std::string("\1\10\0\1", 4))) == near(x8));
        CHECK(half_of(folder, 16, png_chunk("cICP", std::string("\1\15\0\1", 4))) == near(srgb(x16)));
        CHECK(half_of(folder, 16, srgb_tag(), nullptr, ColourSpace::linear) == near(x16));
        CHECK(half_of(folder, 16, "", &notes, ColourSpace::srgb) == near(srgb(x16)));
        CHECK(notes == 0);
    }

    TEST_CASE("colour: curves of profiles: gamma, samples, the five parametric kinds") {
        const auto with_curve = [](const std::string& curve) {
            std::string profile = make_icc(false, true);
            const std::size_t at = profile.find(std::string("curv\0\0\0\0\0\0\0\0", 12));
            REQUIRE(at != std::string::npos);
            profile.replace(at, 12, curve);
            const std::size_t entry = profile.find("kTRC");
            profile.replace(entry + 8, 4, big_endian(std::uint32_t(curve.size())));
            const ColourTag tag = read_icc(profile);
            REQUIRE(tag.curves.size() == 1);
            return tag.curves[0];
        };
        const auto fixed = [](double v) { return big_endian(std::uint32_t(std::int32_t(std::lround(v * 65536)))); };
        const std::string zero(4, '\0');
        CHECK(with_curve("curv" + zero + big_endian(1) + std::string("\2\63", 2))(0.5) ==
              doctest::Approx(std::pow(0.5, 2 + 51 / 256.0)));
        CHECK(with_curve("curv" + zero + big_endian(3) + std::string("\0\0\x40\0\xff\xff", 6))(0.25) ==
              doctest::Approx(0.125).epsilon(1e-4));
        const auto para = [&](int kind, const std::vector<double>& parameters) {
            std::string tag = "para" + zero + std::string(1, '\0') + char(kind) + std::string(2, '\0');
            for (const double p : parameters) tag += fixed(p);
            return with_curve(tag);
        };
        CHECK(para(0, {2})(0.5) == doctest::Approx(0.25));
        CHECK(para(1, {2, 2, -1})(0.75) == doctest::Approx(0.25));
        CHECK(para(1, {2, 2, -1})(0.25) == 0);
        CHECK(para(2, {2, 2, -1, 0.1})(0.75) == doctest::Approx(0.35).epsilon(1e-4));
        CHECK(para(2, {2, 2, -1, 0.1})(0.25) == doctest::Approx(0.1).epsilon(1e-4));
        CHECK(para(3, {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045}).is_srgb());
        CHECK(para(4, {2, 1, 0, 0.5, 0.5, 0.25, 0.125})(0.75) == doctest::Approx(0.8125));
        CHECK(para(4, {2, 1, 0, 0.5, 0.5, 0.25, 0.125})(0.25) == doctest::Approx(0.25));
    }

    TEST_CASE("colour: damaged profiles and other primaries are told") {
        CHECK_FALSE(read_icc("not a profile").note.empty());
        std::string profile = make_icc(true, false);
        CHECK(read_icc(profile).note.empty());
        for (std::size_t size = 0; size < profile.size(); ++size) read_icc(profile.substr(0, size));
        profile[profile.find(std::string("XYZ \0\0\0\0\0\0\x6f", 11)) + 10] = '\x40'; // red's X
        CHECK_FALSE(read_icc(profile).note.empty());
        CHECK(read_icc(profile).is_srgb());
    }
}

TEST_SUITE("cli") {
    TEST_CASE("colour: pictures of colour are tagged in PNG, normal maps and tables carry no colour chunk") {
        const Folder folder;
        const auto has = [&](const char* file, const char* chunk) {
            return contents(folder / file).find(chunk) != std::string::npos;
        };
        write_file(folder / "quad.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
        write_file(folder / "s.toml",
                   "mesh = [{file = \"quad.obj\"}]\n[render]\nsize = 8\nexposure = 0\nbackground = [0.2, 0.2, 0.2]\n");
        REQUIRE(run_bake(folder, {"render", "s.toml", "--depth", "16", "-o", "r.png"}).code == 0);
        CHECK(has("r.png", "sRGB"));
        ImageInfo info;
        Image<float> image = read_image(folder / "r.png", &info);
        linearise(image, ColourSpace::automatic, info);
        CHECK(image.at(0, 0) == doctest::Approx(0.2).epsilon(1e-3));
        CHECK(info.notes.empty());

        REQUIRE(run_bake(folder, {"cubemap", "labels", "--size", "16", "-o", "f_%s.png"}).code == 0);
        CHECK(has("f_px.png", "sRGB"));
        REQUIRE(run_bake(folder, {"cubemap", "labels", "--size", "16", "--linear", "-o", "l_%s.png"}).code == 0);
        CHECK_FALSE(has("l_px.png", "sRGB"));
        CHECK(has("l_px.png", "gAMA"));
        CHECK(run_bake(folder, {"cubemap", "f_%s.png", "--srgb", "--linear", "-o", "g_%s.png"}).code == 2);

        const std::string row(4 * 6, '\x80'); // untagged, 16 bits
        write_file(folder / "u.png", png_bytes(4, 2, 16, 2, {row, row}));
        const Run run = run_bake(folder, {"cubemap", "u.png", "--size", "4", "-o", "u.exr"});
        CHECK(run.code == 0);
        CHECK(run.err.find("u.png: has 16-bit integers without a colour tag: taken as linear") != std::string::npos);
        CHECK(run_bake(folder, {"cubemap", "u.png", "--srgb", "--size", "4", "-o", "u.exr"}).err.find("taken as") ==
              std::string::npos);

        write_file(folder / "h.png", png_bytes(2, 2, 8, 0, {std::string("\x00\x40", 2), "\x80\x7f"}, srgb_tag()));
        REQUIRE(run_bake(folder, {"normal-map", "--height", "h.png", "--amplitude", "0.1", "-o", "n.png"}).code == 0);
        REQUIRE(run_bake(folder, {"bump-table", "h.png", "-o", "b.png"}).code == 0);
        for (const char* file : {"n.png", "b.png"})
            for (const char* chunk : {"sRGB", "gAMA", "iCCP", "cHRM", "cICP"}) CHECK_FALSE(has(file, chunk));
    }
}
