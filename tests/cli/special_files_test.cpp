// Names that are no regular files, given as pictures and meshes.
#include "cli/command.h"
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

using namespace bake::test;

TEST_SUITE("cli") {
    TEST_CASE("special files: a pipe, a socket and a device are refused at once, as picture and as mesh") {
        const Folder folder;
        REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
        const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        folder.path.string().copy(address.sun_path, sizeof address.sun_path - 8);
        std::string(address.sun_path).append("/socket").copy(address.sun_path, sizeof address.sun_path - 1);
        REQUIRE(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
        const std::string dots = (own_meshes() / "dots.png").string();
        int number = 0;
        for (const std::string target : {"pipe", "socket", "/dev/zero", "/dev/null", "/dev/tty"}) {
            for (const char* name : {".png", ".obj", ".ply", ".glb", ".jpg"}) {
                const std::string link = std::to_string(++number) + name;
                REQUIRE(symlink(target.c_str(), (folder / link).c_str()) == 0);
                check_refused(folder, {"check", link}, 3, link, {.seconds = 5});
            }
            check_refused(folder, {"check", target}, 3, target, {.seconds = 5});
            check_refused(folder, {"normal-map", "--height", target, "-o", "a.png"}, 3, target, {.seconds = 5});
            check_refused(folder, {"cubemap", target, "-o", "a.exr"}, 3, target, {.seconds = 5});
            check_refused(folder, {"displace", target, "--height", dots, "--amplitude", "1", "-o", "a.obj"}, 3, target,
                          {.seconds = 5});
        }
        close(listener);
    }
}
