// Decoders in a process of their own, and what damaged files make them do.
#include "bake/base/error.h"
#include "bake/picture/foreign_picture.h"
#include "bake/picture/image_io.h"
#include "bake/picture/picture_reply.h"
#include "cli/command.h"
#include "memory_limits.h"
#include "picture/openimageio.h"
#include <cerrno>
#include <csignal>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace bake;
using namespace bake::test;

namespace {

fs::path greedy_decoder() { return fs::path(std::getenv("BAKE")).parent_path() / "greedy/bake_formats"; }

/// A PGM of 2 x 1 texels that tells the greedy decoder what to do.
std::string picture(const std::string& act) { return std::string("P5 2 1 255\n\x00\xff", 13) + "\n" + act; }

/// "" or the refusal.
std::string read_greedily(const Folder& folder, const std::string& act, Image<float>& image) try {
    write_file(folder / "a.pgm", picture(act));
    const PictureFile file(folder / "a.pgm");
    ImageInfo info;
    read_by_program(greedy_decoder().string(), file, PictureKind::pnm, {}, info, &image);
    return "";
} catch (const Error& error) {
    CHECK(error.refusal == Refusal::unreadable);
    return error.what();
}

std::ptrdiff_t open_descriptors() {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

/// Whether a process runs this program.
bool runs(const fs::path& program) {
    for (const auto& process : fs::directory_iterator("/proc")) {
        std::error_code ignored;
        if (fs::read_symlink(process.path() / "exe", ignored) == program) return true;
    }
    return false;
}

/// A folder with a command whose decoder is the greedy one.
struct GreedyBake {
    GreedyBake() : before(std::getenv("BAKE")) {
        fs::copy_file(before, folder / "bake");
        fs::copy_file(greedy_decoder(), folder / "bake_formats");
        setenv("BAKE", (folder / "bake").c_str(), 1);
    }
    ~GreedyBake() { setenv("BAKE", before.c_str(), 1); }
    Folder folder;
    std::string before;
};

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("foreign_picture: whatever a decoder does is one refusal, and nothing of it is left behind") {
        const Folder folder;
        Image<float> image;
        CHECK(read_greedily(folder, "good", image) == "");
        CHECK(image.at(1, 0) == 1);
        const auto before = open_descriptors();
        struct {
            const char *act, *said;
        } const cases[] = {{"crash", "crashed"},   {"abort", "crashed"}, {"exit", "crashed"},
                           {"foreign", "crashed"}, {"alpha", "crashed"}, {"bytes", "crashed"},
                           {"kind", "crashed"},    {"twice", "crashed"}, {"more", "crashed"},
                           {"fewer", "crashed"},   {"throw", "gave up"}, {"wide", "claims 1048576 x 1 pixels"}};
        for (const auto& [act, said] : cases) {
            CAPTURE(std::string(act));
            const std::string refusal = read_greedily(folder, act, image);
            CAPTURE(refusal);
            CHECK(refusal.starts_with(folder / "a.pgm: "));
            CHECK(refusal.find(said) != std::string::npos);
        }
        for (int i = 0; i < 50; ++i) CHECK(read_greedily(folder, i % 2 ? "good" : "abort", image).empty() == (i % 2));
        CHECK(open_descriptors() == before);
        CHECK((waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD));
    }

    TEST_CASE("foreign_picture: a decoder inherits nothing, and has limits of memory") {
        const Folder folder;
        Image<float> image;
        const int descriptors[2] = {dup(2), dup(2)}; // not closed by exec
        CHECK(read_greedily(folder, "inherit", image) == "");
        for (const int descriptor : descriptors) close(descriptor);
        if (!keeps_memory_limits()) return;
        CHECK(read_greedily(folder, "memory", image).find("took too much memory") != std::string::npos);
        CHECK(read_greedily(folder, "careless", image).find("crashed") != std::string::npos);
    }

    TEST_CASE("foreign_picture: integers come as the floats that OpenImageIO makes of them") {
        const Folder folder;
        std::string deep = "P5 256 1 65535\n";
        for (int i = 0; i < 256; ++i) deep += {char(i), char(37 * i)};
        write_file(folder / "a.pgm", deep);
        fs::copy_file(source_folder() / "tests/data/dots.jpg", folder / "b.jpg");
        for (const char* name : {"a.pgm", "b.jpg"})
            CHECK(same(read_image(folder / name), by_openimageio(folder, folder / name)));
    }

    TEST_CASE("foreign_picture: a program that is missing or cannot be started is named") {
        const Folder folder;
        write_file(folder / "a.pgm", picture("good"));
        write_file(folder / "text", "no program");
        const PictureFile file(folder / "a.pgm");
        ImageInfo info;
        for (const char* program : {"absent", "text"}) try {
                read_by_program(folder / program, file, PictureKind::pnm, {}, info, nullptr);
                FAIL("not refused");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unreadable);
                CHECK(std::string(error.what()).find(folder / program) != std::string::npos);
            }
    }

    TEST_CASE(
        "picture_reply: a header comes back the same, and one with any byte changed is never worse than refused") {
        ReplyHeader header;
        header.info.format = "jpeg", header.info.channels = {"R", "G", "B", "A"}, header.info.colours = 3;
        header.info.alpha_channel = 3, header.info.bits = 8, header.info.notes = {"has two pictures"};
        header.info.description = "text", header.icc = std::string(300, 'i');
        header.data = {1, 2, 3, 4}, header.picture = {0, 0, 6, 7}, header.orientation = 6;
        const std::string bytes = to_bytes(header);
        const auto back = header_from(bytes);
        REQUIRE(back);
        CHECK(to_bytes(*back) == bytes);
        CHECK(back->picture == header.picture);
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            CHECK(!header_from(bytes.substr(0, at)));
            for (const char value : {'\0', '\1', '\x7f', '\xff'}) {
                std::string changed = bytes;
                changed[at] = value;
                if (const auto other = header_from(changed)) CHECK(other->info.channels.size() <= 64);
            }
        }
    }
}

TEST_SUITE("cli") {
    TEST_CASE("foreign_picture: a decoder that does not end is stopped, by its limit of time or by Ctrl-C") {
        const GreedyBake greedy;
        const Folder folder;
        write_file(folder / "a.pgm", picture("time"));
        check_refused(folder, {"check", "a.pgm"}, 3, "did not end in time");
        for (const char* act : {"time", "sleep"}) {
            write_file(folder / "a.pgm", picture(act));
            const Run run = run_bake(folder, {"check", "a.pgm"}, {.interrupt_after = 0.3});
            CHECK(run.code == 130);
            CHECK(run.seconds < 3);
        }
        CHECK(!runs(greedy.folder / "bake_formats"));
    }

    TEST_CASE("foreign_picture: a picture of 34 bytes does not make its decoder take gigabytes") {
        if (!keeps_memory_limits()) return;
        const Folder folder;
        std::string psd = std::string("8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\5\0\0\0\x09\0\x08\0\3", 26);
        write_file(folder / "a.psd",
                   psd + "\x7f" + std::string(7, '\0')); // 2 GB of colours for the mode RGB, which has none
        check_refused(folder, {"check", "a.psd"}, 3, "took too much memory");
        CHECK(run_bake(folder, {"check", "a.psd"}).peak_mib < 512);
    }

    TEST_CASE("foreign_picture: a decoder ends with the command that started it, however that ends") {
        const GreedyBake greedy;
        const Folder folder;
        write_file(folder / "a.pgm", picture("sleep"));
        const Run run = run_bake(folder, {"check", "a.pgm"}, {.interrupt_after = 0.5, .signal = SIGKILL});
        CHECK(run.code == 128 + SIGKILL);
        for (int i = 0; i < 100 && runs(greedy.folder / "bake_formats"); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        CHECK(!runs(greedy.folder / "bake_formats"));
    }

    TEST_CASE("foreign_picture: the folders that a missing decoder may be put into are named") {
        const GreedyBake greedy;
        fs::remove(greedy.folder / "bake_formats");
        const Folder folder;
        write_file(folder / "a.pgm", picture("good"));
        check_refused(folder, {"check", "a.pgm"}, 3, greedy.folder.path.string());
    }
}
