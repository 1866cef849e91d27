// Inputs that are there and may not be read.
#include "cli/command.h"
#include <unistd.h>

using namespace bake::test;

namespace {

const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();

/// Root reads all files: the command then runs as another user, where the project's folder lets that user in.
bool may_be_refused() {
    if (getuid() != 0) return true;
    const Folder folder;
    fs::permissions(folder.path, fs::perms::all);
    return run_bake(folder, {"check", dots, torus}, {.as_nobody = true}).code == 0;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("unreadable: a file or a folder without permission is exit 3, and said to be that") {
        if (!may_be_refused()) {
            MESSAGE("not looked at: another user may not enter the project's folder");
            return;
        }
        const Folder folder;
        fs::permissions(folder.path, fs::perms::all);
        fs::create_directory(folder.path / "closed");
        for (const char* name :
             {"m.obj", "m.ply", "m.glb", "m.gltf", "h.png", "h.exr", "h.tif", "h.hdr", "h.jpg", "h.bmp", "s.toml",
              "lines.txt", "b.bin", "closed/m.obj", "closed/h.png", "closed/s.toml"}) {
            write_file(folder / name, "some bytes");
            if (name[0] != 'c') fs::permissions(folder / name, fs::perms::none);
        }
        write_file(folder / "open.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"b.bin"}]})");
        write_file(folder / "open.toml", "mesh = [{file = \"m.obj\"}]\n");
        write_file(folder / "sky.toml", "[sky]\nimage = \"h.png\"\n");
        fs::permissions(folder.path / "closed", fs::perms::none);

        const auto refused = [&](const std::vector<std::string>& line, const std::string& named) {
            check_refused(folder, line, 3, named, {.as_nobody = getuid() == 0});
            CHECK(run_bake(folder, line, {.as_nobody = getuid() == 0}).err.find("ermission denied") !=
                  std::string::npos);
        };
        for (const char* name : {"m.obj", "m.ply", "m.glb", "m.gltf", "h.png", "h.exr", "h.tif", "h.hdr", "h.jpg",
                                 "h.bmp", "closed/m.obj", "closed/h.png"})
            refused({"check", name}, name);
        refused({"check", "open.gltf"}, "b.bin");
        refused({"check", torus, "--against", "m.obj"}, "m.obj");
        refused({"check", "--pair", dots, "h.png"}, "h.png");
        refused({"bump-table", "h.png", "-o", "a.exr"}, "h.png");
        refused({"normal-map", "closed/m.obj", "--height", dots, "-o", "a.png"}, "closed/m.obj");
        refused({"normal-map", torus, "--height", "closed/h.png", "-o", "a.png"}, "closed/h.png");
        refused({"explain", "m.obj", "--height", dots, "--uv", "0,0"}, "m.obj");
        refused({"displace", "m.ply", "--height", dots, "-o", "a.ply"}, "m.ply");
        refused({"displace", torus, "--height", dots, "--edge-px", "9", "--camera", "s.toml", "-o", "a.ply"}, "s.toml");
        refused({"surface", "m.obj", "-o", "a.ply"}, "m.obj");
        refused({"surface", "--shape", "revolution:profile=lines.txt", "-o", "a.ply"}, "lines.txt");
        refused({"render", "s.toml", "-o", "a.png"}, "s.toml");
        refused({"render", "closed/s.toml", "-o", "a.png"}, "closed/s.toml");
        refused({"render", "open.toml", "-o", "a.png"}, "m.obj");
        refused({"render", "sky.toml", "-o", "a.png"}, "h.png");
        refused({"cubemap", "h.exr", "-o", "a.exr"}, "h.exr");
        refused({"cubemap", "closed/sky_%s.png", "-o", "a.exr"}, "closed");
        refused({"cubemap", "--capture", "s.toml", "--at", "0,0,0", "-o", "a.exr"}, "s.toml");
        fs::permissions(folder.path / "closed", fs::perms::all);
    }

    TEST_CASE("unreadable: what is not there is said to be that") {
        const Folder folder;
        for (const char* name : {"no.obj", "no.ply", "no.glb", "no.png", "no.exr", "none/no.obj", "none/no.png"})
            check_refused(folder, {"check", name}, 3, std::string(name) + ": no such file");
        check_refused(folder, {"render", "no.toml", "-o", "a.png"}, 3, "no.toml: no such file");
        check_refused(folder, {"surface", "--shape", "bezier:file=no.txt", "-o", "a.ply"}, 3, "no.txt: no such file");
    }

} // TEST_SUITE
