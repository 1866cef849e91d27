// What the verbs leave behind when all goes well, when the disk is full, when they may not write, and when interrupted.
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <algorithm>
#include <cmath>
#include <linux/capability.h>
#include <map>
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

/// The verbs' other ways of writing; several write more than one file.
std::vector<std::vector<std::string>> other_jobs() {
    std::vector<std::vector<std::string>> all;
    for (const char* out : {"relief.ply", "relief.obj", "relief.glb", "relief.gltf"})
        all.push_back({"displace", torus, "--height", dots, "-o", out});
    all.push_back({"surface", "--shape", "torus", "--resolution", "32x16", "--size", "64x32", "--maps-out", "map", "-o",
                   "mesh.ply"});
    for (const char* out : {"cube.exr", "strip.png", "sky_%s.png", "sky_%s.exr", "sky.tif"})
        all.push_back({"cubemap", "labels", "--size", "16", "-o", out});
    const std::string scene = (own_meshes() / "scene.toml").string();
    for (const char* out : {"picture.png", "picture.exr"})
        all.push_back({"render", scene, "--size", "64x48", "--spp", "1", "-o", out});
    return all;
}

/// The sizes of all files of a folder.
std::map<std::string, long long> sizes_of(const Folder& folder) {
    std::map<std::string, long long> sizes;
    for (const std::string& name : folder.names()) sizes[name] = (long long)fs::file_size(folder / name);
    return sizes;
}

/// A height that takes seconds to bake.
std::string large_height(const Folder& folder) {
    Image<float> image(8192, 4096, 1);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float((i * 2654435761u) % 65536) / 65536;
    write_image(folder / "large.tif", image, {.depth = Depth::u16});
    return "large.tif";
}

/// Seconds after which a bake of large_height() has begun and is far from its end.
#ifdef __SANITIZE_ADDRESS__
constexpr double amid_long_work = 0.6;
#else
constexpr double amid_long_work = 0.3;
#endif

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

    TEST_CASE("output: a full disk is exit 5, one line; all old files stay and no other is left") {
        std::vector<std::vector<std::string>> all = other_jobs();
        for (const Job& job : jobs()) all.push_back(job.arguments);
        for (const std::vector<std::string>& arguments : all) {
            const Folder folder;
            CAPTURE(arguments.back());
            REQUIRE(run_bake(folder, arguments).code == 0);
            const auto sizes = sizes_of(folder);
            long long largest = 0;
            for (const auto& [name, size] : sizes) largest = std::max(largest, size);
            for (const long long most : {0LL, 300LL, largest / 2, largest - 1}) {
                CAPTURE(most);
                for (const auto& [name, size] : sizes) write_file(folder / name, "old");
                if (most > 0) check_refused(folder, arguments, 5, "cannot be written", {.file_bytes = most});
                else CHECK(run_bake(folder, arguments, {.file_bytes = most}).code == 5); // no line in a file either
                for (const auto& [name, size] : sizes) CHECK(contents(folder / name) == "old");
                CHECK(folder.names().size() == sizes.size());
            }
        }
    }

    TEST_CASE("output: no verb replaces a file that it read") {
        const Folder folder;
        write_mesh(folder / "relief.gltf", read_mesh(torus)); // with relief.bin beside it
        for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
            fs::copy_file(own_meshes() / (std::string("sky_") + face + ".png"), folder / face + ".png");
        fs::copy_file(bricks, folder / "bricks.png");
        fs::create_hard_link(folder / "bricks.png", folder / "linked.png");
        fs::create_symlink("bricks.png", folder.path / "named.png");
        write_file(folder / "scene.toml", "mesh = [{file = \"relief.gltf\", material = \"a\"}]\n"
                                          "material = [{name = \"a\", normal = \"px.png\"}]\n");
        fs::create_hard_link(folder / "relief.bin", folder / "other.bin");
        const auto sizes = sizes_of(folder);
        const auto refused = [&](const std::vector<std::string>& arguments) {
            check_refused(folder, arguments, 2, "would replace");
        };
        refused({"displace", "relief.gltf", "--height", dots, "-o", "relief.gltf"});
        refused({"displace", "relief.gltf", "--height", dots, "-o", "other.gltf"}); // and its other.bin
        refused({"surface", "relief.gltf", "-o", "other.gltf"});
        for (const char* out : {"bricks.png", "linked.png", "named.png", "./bricks.png"}) {
            refused({"normal-map", "bricks.png", "-o", out});
            refused({"bump-table", "bricks.png", "-o", out});
        }
        refused({"render", "scene.toml", "--size", "8", "-o", "px.png"});
        refused({"cubemap", "%s.png", "--size", "8", "-o", "%s.png"});
        refused({"cubemap", "px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png", "--size", "8", "--to", "strip",
                 "-o", "nz.png"});
        CHECK(sizes_of(folder) == sizes);
    }

    TEST_CASE("output: a file of two outputs' name is refused; several outputs appear all or none") {
        const Folder folder;
        const std::vector<std::string> surface = {"surface", "--shape", "torus", "--resolution", "64x32",
                                                  "--size",  "16x8",    "-o",    "mesh.ply",     "--maps-out"};
        std::vector<std::string> arguments = surface;
        arguments.push_back("map");
        REQUIRE(run_bake(folder, arguments).code == 0);
        const auto sizes = sizes_of(folder);
        for (const auto& [name, size] : sizes) write_file(folder / name, "old");
        // The maps fit, the mesh does not.
        check_refused(folder, arguments, 5, "mesh.ply", {.file_bytes = sizes.at("mesh.ply") - 1});
        for (const auto& [name, size] : sizes) CHECK(contents(folder / name) == "old");
        fs::create_symlink("map_normal.exr", folder.path / "link_position.exr");
        fs::create_symlink("map_normal.exr", folder.path / "link_normal.exr");
        arguments.back() = "link";
        check_refused(folder, arguments, 2, "two outputs");
        CHECK(contents(folder / "map_normal.exr") == "old");
    }

    TEST_CASE("output: the null device takes any verb's output; links are followed, the mode is kept") {
        const Folder folder;
        fs::create_symlink("/dev/null", folder.path / "nothing.png");
        CHECK(run_bake(folder, {"bump-table", dots, "-o", "nothing.png"}).code == 0);
        CHECK(run_bake(folder, {"bump-table", dots, "-o", "/dev/null"}).code == 0);
        CHECK(run_bake(folder, {"displace", torus, "--height", dots, "-o", "/dev/null"}).code == 0);
        CHECK(run_bake(folder, {"cubemap", "labels", "--size", "8", "-o", "/dev/null"}).code == 0);
        CHECK(fs::is_character_file("/dev/null"));
        write_file(folder / "real.png", "old");
        fs::permissions(folder.path / "real.png", fs::perms(0640));
        fs::create_symlink("real.png", folder.path / "link.png");
        CHECK(run_bake(folder, {"bump-table", dots, "-o", "link.png"}).code == 0);
        CHECK(fs::is_symlink(folder.path / "link.png"));
        CHECK(fs::file_size(folder / "real.png") > 100);
        CHECK((fs::status(folder / "real.png").permissions() & fs::perms::all) == fs::perms(0640));
        fs::create_symlink("/dev/full", folder.path / "full.png");
        check_refused(folder, {"bump-table", dots, "-o", "full.png"}, 5, "not a regular file");
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
            const Run run = run_bake(folder, arguments, {.seconds = 100, .interrupt_after = amid_long_work});
            CAPTURE(arguments.back());
            CAPTURE(run.err);
            CHECK(run.code == 130);
            CHECK(lines(run.err) == 1);
            CHECK(run.seconds < 30);
            CHECK(contents(folder / arguments.back()) == "old");
            CHECK(folder.names() == before);
        }
    }

    TEST_CASE("output: SIGTERM and SIGHUP are Ctrl-C, and a second signal leaves nothing either") {
        const Folder folder;
        const std::string height = large_height(folder);
        const std::vector<std::string> one = {"normal-map", "--height", height, "-o", "a.png"},
                                       many = {"cubemap", "labels", "--size", "2048", "-o", "sky_%s.png"};
        const auto before = folder.names();
        for (const int signal : {SIGTERM, SIGHUP, SIGINT})
            for (const bool twice : {false, true}) {
                const auto& arguments = twice ? many : one;
                const Run run = run_bake(folder, arguments,
                                         {.seconds = 100, .interrupt_after = 0.4, .signal = signal, .twice = twice});
                CAPTURE(run.err);
                CHECK(run.code == 130);
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
