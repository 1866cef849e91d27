// What the verbs leave behind when all goes well, when the disk is full, when they may not write, and when interrupted.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <linux/capability.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <unistd.h>

using namespace bake;
using namespace bake::test;

namespace {

const std::string bricks = (own_meshes() / "bricks.png").string(), dots = (own_meshes() / "dots.png").string(),
                  torus = (own_meshes() / "torus.obj").string();

struct Job {
    std::string out;
    std::vector<std::string> arguments;
};

/// The verbs' ways of writing a file, small but larger than any writer's buffer.
std::vector<Job> jobs() {
    std::vector<Job> all;
    for (const char* ending : {"png", "exr", "tif"}) {
        const std::string table = std::string("table.") + ending, map = std::string("map.") + ending;
        all.push_back({table, {"bump-table", bricks, "-o", table}});
        all.push_back({map, {"normal-map", "--height", bricks, "-o", map}});
    }
    for (const char* out : {"moments.exr", "moments.tif"})
        all.push_back({out, {"bump-table", bricks, "-o", out, "--layout", "bumpslopes"}});
    return all;
}

/// A height that takes seconds to bake.
std::string large_height(const Folder& folder) {
    Image<float> image(8192, 4096, 1);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float((i * 2654435761u) % 65536) / 65536;
    write_image(folder / "large.tif", image, {.depth = Depth::u16});
    return "large.tif";
}

bool may_mount() { return geteuid() == 0 && prctl(PR_CAPBSET_READ, CAP_SYS_ADMIN) == 1; }

/// 128 KiB in memory, as long as it lives.
struct SmallDisk {
    explicit SmallDisk(const std::string& folder)
        : path(folder), mounted(mount("none", path.c_str(), "tmpfs", 0, "size=128k") == 0) {}
    ~SmallDisk() {
        if (mounted) umount(path.c_str());
    }
    std::string path;
    bool mounted;
};

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("output: the same bytes for 1, 2 and 7 threads, and a second run overwrites the first") {
        const Folder folder;
        std::vector<Job> all = jobs();
        all.push_back(
            {"torus.png",
             {"normal-map", torus, "--height", dots, "--amplitude", "1%", "-o", "torus.png", "--size", "256x128"}});
        for (const Job& job : all) {
            CAPTURE(job.out);
            std::string first;
            for (const char* threads : {"1", "2", "7"}) {
                std::vector<std::string> arguments = job.arguments;
                arguments.insert(arguments.end(), {"--threads", threads});
                REQUIRE(run_bake(folder, arguments).code == 0);
                if (first.empty()) first = contents(folder / job.out);
                CHECK((contents(folder / job.out) == first));
            }
        }
        CHECK(folder.names().size() == all.size());
    }

    TEST_CASE("output: a full disk is exit 5, one line; the old file stays and no other is left") {
        for (const Job& job : jobs()) {
            const Folder folder;
            REQUIRE(run_bake(folder, job.arguments).code == 0);
            const auto whole = (long long)fs::file_size(folder / job.out);
            write_file(folder / job.out, "old");
            for (const long long most : {300LL, whole / 2, whole - 1}) {
                CAPTURE(most);
                check_refused(folder, job.arguments, 5, job.out, {.file_bytes = most});
                CHECK(contents(folder / job.out) == "old");
            }
        }
    }

    TEST_CASE("output: a small disk that fills up" * doctest::skip(!may_mount())) {
        const Folder folder;
        fs::create_directory(folder.path / "disk");
        const SmallDisk disk(folder / "disk");
        REQUIRE(disk.mounted);
        for (const Job& job : jobs()) {
            std::vector<std::string> arguments = job.arguments;
            for (std::string& argument : arguments)
                if (argument == job.out) argument = "disk/" + job.out;
            write_file(folder / "disk/" + job.out, "old");
            check_refused(folder, arguments, 5, job.out);
            CHECK(contents(folder / "disk/" + job.out) == "old");
        }
    }

    TEST_CASE("output: folders that are missing, not writable, or stand where the file should be") {
        const Folder folder;
        fs::create_directory(folder.path / "taken.png");
        fs::create_directory(folder.path / "taken.exr");
        fs::create_directory(folder.path / "closed");
        write_file(folder / "file", "");
        for (const std::vector<std::string>& verb :
             {std::vector<std::string>{"bump-table", dots, "-o"}, {"normal-map", "--height", dots, "-o"}}) {
            const auto refused = [&](const std::string& out, const RunLimits& limits = {}) {
                std::vector<std::string> arguments = verb;
                arguments.push_back(out);
                check_refused(folder, arguments, 5, out, limits);
            };
            refused("taken.png");
            refused("taken.exr");
            refused("nowhere/a.png");
            refused("file/a.png");
            fs::permissions(folder.path, fs::perms::all);
            fs::permissions(folder.path / "closed", fs::perms::owner_read | fs::perms::owner_exec);
            if (getuid() == 0)
                fs::permissions(folder.path / "closed",
                                fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
            // Another user cannot read the project where it lies in a closed home: looked at only where it can.
            if (getuid() != 0) refused("closed/a.png");
            fs::permissions(folder.path / "closed", fs::perms::all);
        }
        CHECK(run_bake(folder, {"check", dots}, {.stdout_path = "/dev/full"}).code == 5);
    }

    TEST_CASE("output: Ctrl-C during a long bake is exit 130, one line, and leaves nothing") {
        const Folder folder;
        const std::string height = large_height(folder);
        for (const std::vector<std::string>& arguments : {std::vector<std::string>{"bump-table", height, "-o", "a.exr"},
                                                          {"bump-table", height, "-o", "a.png"},
                                                          {"normal-map", "--height", height, "-o", "a.exr"},
                                                          {"normal-map", "--height", height, "-o", "a.png"}}) {
            write_file(folder / arguments.back(), "old");
            const auto before = folder.names();
            const Run run = run_bake(folder, arguments, {.seconds = 100, .interrupt_after = 0.6});
            CAPTURE(arguments.back());
            CAPTURE(run.err);
            CHECK(run.code == 130);
            CHECK(lines(run.err) == 1);
            CHECK(run.seconds < 30);
            CHECK(contents(folder / arguments.back()) == "old");
            CHECK(folder.names() == before);
        }
    }

    TEST_CASE("output: an ending in capitals gives every verb the file that it gives in lower case") {
        const Folder folder;
        const auto same = [&](std::vector<std::string> arguments, const std::string& lower, const std::string& upper) {
            CAPTURE(upper);
            arguments.insert(arguments.end(), {"-o", lower});
            REQUIRE(run_bake(folder, arguments).code == 0);
            arguments.back() = upper;
            CHECK(run_bake(folder, arguments).code == 0);
            CHECK((contents(folder / lower) == contents(folder / upper)));
        };
        same({"surface", "--shape", "torus", "--resolution", "8x4"}, "surface.ply", "surface.PLY");
        same({"surface", "--shape", "torus", "--resolution", "8x4"}, "surface.glb", "surface.GLB");
        same({"displace", torus, "--height", dots}, "displaced.ply", "displaced.PLY");
        same({"displace", torus, "--height", dots, "--margin"}, "displaced.glb", "displaced.GLB");
        same({"normal-map", "--height", dots}, "map.tif", "map.TIF");
        same({"bump-table", dots}, "table.png", "table.PNG");
        same({"cubemap", "labels", "--size", "16"}, "cube.exr", "cube.EXR");
        CHECK(read_image_info(folder / "cube.EXR").environment == EnvironmentTag::cube);
    }

} // TEST_SUITE
