// The command where memory, threads, descriptors or processor time are short: done, or one line that names what is short.
#include "cli/displacing.h"
#include <sys/resource.h>
#include <unistd.h>

using namespace bake;
using namespace bake::test;

namespace {

const std::string bricks = (own_meshes() / "bricks.png").string(),
                  photo = (source_folder() / "tests/data/dots.jpg").string();

/// A user who runs nothing but the command, which may start this many processes and threads.
RunLimits processes(int count) { return {.user = 200000 + getpid() % 100000, .resources = {{RLIMIT_NPROC, count}}}; }

/// Whether another user may enter the project's folder and be limited.
bool may_be_another() {
    const Folder folder;
    fs::permissions(folder.path, fs::perms::all);
    return may_simulate_group() && run_bake(folder, {"check", bricks}, processes(100)).code == 0;
}

/// Waves of 16 bits, 1 MiB per 512 x 512.
std::string large_waves(const Folder& folder, int edge, const char* name = "large.tif") {
    write_picture(
        folder / name, edge, edge, 1, [](int x, int y, int) { return 0.5 + 0.4 * std::sin(0.01 * x + 0.02 * y); },
        Depth::u16);
    return name;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("limits: processor time that is used up is an interrupt") {
        const Folder folder;
        const std::string torus = (own_meshes() / "torus.obj").string();
        const RunLimits limits{.resources = {{RLIMIT_CPU, 1}}, .soft = true};
        // Minutes of work on any machine.
        check_refused(folder, {"render", torus, "--size", "512", "--spp", "16384", "--quiet", "-o", "n.png"}, 130,
                      "raise ulimit -t", limits);
    }

#if !defined(__SANITIZE_ADDRESS__) // which reserves terabytes, and at the end takes a thread and a descriptor
    TEST_CASE("limits: one thread is enough for a command that asks for one, and the lack of others is said") {
        if (!may_be_another()) {
            MESSAGE("not looked at: the command cannot run as another user");
            return;
        }
        const Folder folder;
        fs::permissions(folder.path, fs::perms::all);
        for (const char* out : {"a.png", "a.exr", "a.tif"}) {
            CAPTURE(std::string(out));
            const Run run =
                run_bake(folder, {"normal-map", "--threads", "1", "--quiet", bricks, "-o", out}, processes(1));
            CAPTURE(run.err);
            CHECK(run.code == 0);
            CHECK(run.err == "");
            check_refused(folder, {"normal-map", "--threads", "3", "--quiet", bricks, "-o", out}, 4,
                          "no thread can be started; use --threads 1, or raise ulimit -u", processes(1));
        }
        // OpenEXR does without its threads where they cannot be started.
        for (const int count : {2, 3}) {
            CAPTURE(count);
            const Run run =
                run_bake(folder, {"normal-map", "--threads", "2", "--quiet", bricks, "-o", "b.exr"}, processes(count));
            CAPTURE(run.err);
            CHECK(run.code == 0);
            // Its threads may be the last ones.
            const Run check = run_bake(folder, {"check", "--threads", "2", "b.exr"}, processes(count));
            CAPTURE(check.err);
            CHECK((check.code == 0 || (check.code == 4 && check.err.find("no thread can") != std::string::npos)));
        }
        // Nor is a picture damaged whose decoder cannot be started.
        for (const int count : {1, 2})
            check_refused(folder, {"check", "--threads", "1", photo}, 4, "; raise ulimit -u", processes(count));
    }

    TEST_CASE("limits: descriptors that are short are named, and no file is blamed") {
        const Folder folder;
        for (const int count : {4, 5, 6, 8, 12, 16}) {
            CAPTURE(count);
            check_refused(folder, {"check", photo}, 4, "(Too many open files); raise ulimit -n",
                          {.resources = {{RLIMIT_NOFILE, count}}});
        }
        check_refused(folder, {"surface", torus, "--size", "64", "--quiet", "--maps-out", "t"}, 5,
                      "(Too many open files); raise ulimit -n", {.resources = {{RLIMIT_NOFILE, 7}}});
    }

    TEST_CASE("limits: memory that is short is named, and neither the disk nor a picture is blamed") {
        const Folder folder;
        const auto within = [](int resource, long long mib) { return RunLimits{.resources = {{resource, mib << 20}}}; };
        for (const char* ending : {".exr", ".png", ".tif"}) {
            CAPTURE(std::string(ending));
            for (const long long mib : {90, 98, 110, 130}) {
                CAPTURE(mib);
                const Run run =
                    run_bake(folder, {"cubemap", "labels", "--size", "512", "--quiet", "-o", std::string("c") + ending},
                             within(RLIMIT_AS, mib));
                CAPTURE(run.err);
                if (run.code != 0) CHECK(run.code == 4);
                if (run.code != 0) CHECK(run.err.find("ulimit -") != std::string::npos);
            }
        }
        for (const long long mib : {300, 400}) {
            CAPTURE(mib);
            check_refused(folder, {"check", photo}, 4, "within what ulimit -v allows; raise ulimit -v, or give a PNG",
                          within(RLIMIT_AS, mib));
        }
        for (const long long mib : {30, 60, 88})
            check_refused(folder, {"check", photo}, 4, "within what ulimit -d allows; raise ulimit -d, or give a PNG",
                          within(RLIMIT_DATA, mib));
        CHECK(run_bake(folder, {"check", photo}, within(RLIMIT_AS, 2000)).code == 0);
    }

    TEST_CASE("limits: a control group's limit is kept by every verb, and named") {
        if (!may_simulate_group()) {
            MESSAGE("not looked at: a control group cannot be simulated");
            return;
        }
        const Folder folder;
        const std::vector<std::vector<std::string>> all = {
            {"surface", "--shape", "torus", "--resolution", "2048x1024", "-o", "s.ply"},
            {"normal-map", torus, "--height", bricks, "--size", "8192", "-o", "n.png"},
            {"cubemap", "labels", "--size", "2048", "-o", "c.exr"}};
        for (std::vector<std::string> arguments : all) {
            CAPTURE(arguments[0]);
            arguments.emplace_back("--quiet");
            const auto before = folder.names();
            const Run run = run_bake(folder, arguments, {.group_bytes = 200000000});
            CAPTURE(run.err);
            CHECK(run.peak_mib < 200);
            CHECK(run.code == 4);
            CHECK(lines(run.err) == 1);
            CHECK(run.err.find("memory.max of control group /") != std::string::npos);
            CHECK(folder.names() == before);
        }
        CHECK(run_bake(folder, {"normal-map", bricks, "-o", "n.png"}, {.group_bytes = 200000000}).code == 0);
        CHECK(run_bake(folder, {"check", photo}, {.group_bytes = 60000000}).code == 0);
    }

    TEST_CASE("limits: --max-memory lowers other limits, does not raise them, and leaves its own to the decoder") {
        const Folder folder;
        const auto displace = [](const std::string& height, const char* most) {
            return std::vector<std::string>{"displace", torus,          "--height", height, "--quiet", "--levels",
                                            "0",        "--max-memory", most,       "-o",   "d.ply"};
        };
        CHECK(run_bake(folder, displace(photo, "80M")).code == 0);
        const std::string large = large_waves(folder, 4096);
        check_refused(folder, displace(large, "50M"), 4,
                      "64 MiB of memory, more than the 50 MiB it may use (--max-memory); scale it down, or raise "
                      "--max-memory");
        check_refused(folder, displace(large, "180M"), 4, "a height of 4096 x 4096 texels needs");
        if (!may_simulate_group()) return;
        check_refused(folder, displace(large, "10G"), 4,
                      "(memory.max of control group /); scale the height down, or raise that limit",
                      {.group_bytes = 100000000});
    }
#endif

} // TEST_SUITE
