// bake displace at its limits: memory, errors that cannot be reached, and interrupts of long searches.
#include "cli/displacing.h"
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

TEST_SUITE("cli") {

    TEST_CASE("displace: what does not fit in --max-memory is refused with what it needs and what would fit") {
        const Folder folder;
        const std::vector<std::string> arguments = {"displace", torus,          "--height", waves(folder), "--levels",
                                                    "6",        "--max-memory", "20M",      "-o",          "a.ply"};
        check_refused(folder, arguments, 4, "level");
        const Run run = run_bake(folder, arguments);
        CAPTURE(run.err);
        CHECK(run.seconds < 5);
#if defined(__SANITIZE_ADDRESS__)
        CHECK(run.peak_mib < 500); // the sanitizer keeps freed blocks; still less than the 714 MB that are refused
#else
        CHECK(run.peak_mib < 200);
#endif
        // Far beyond any machine, without --max-memory.
        check_refused(folder,
                      {"displace", "--shape", "torus", "--height", waves(folder), "--levels", "10", "-o", "a.ply"}, 4,
                      "level");
    }

#if !defined(__SANITIZE_ADDRESS__) // which keeps freed blocks
    TEST_CASE("displace: the memory that is said to be needed is what is taken, within a tenth") {
        const Folder folder;
        const auto check_said = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.begin(), {torus, "--height", waves(folder), "--amplitude", "1%"});
            arguments.push_back("--json");
            const Run run = displaced(folder, arguments);
            const double said = nlohmann::json::parse(run.out)["bytes_needed"].get<double>() / 1048576;
            CAPTURE(arguments[6]);
            CAPTURE(arguments[8]);
            CHECK(std::abs(run.peak_mib - said) < 0.1 * said + 8); // 8: blocks that a small result does not fill
        };
        for (const char* out : {"a.obj", "a.ply", "a.glb"}) check_said({"--levels", "4", "-o", out});
        check_said({"--levels", "4", "-o", "a.obj", "--audit"});
        check_said({"--levels", "4", "-o", "a.ply", "--margin"});
        check_said({"--max-error", "0.03%", "-o", "a.glb"});
    }

    TEST_CASE("displace: --max-memory is kept, by the audit too, and the refusal says what would fit without it") {
        const Folder folder;
        const auto in_memory = [&](const char* size, bool audit) {
            std::vector<std::string> arguments = {"displace", torus,          "--height", waves(folder), "--levels",
                                                  "4",        "--max-memory", size,       "-o",          "a.ply"};
            if (audit) arguments.push_back("--audit");
            return run_bake(folder, arguments);
        };
        const Run refused = in_memory("100M", true);
        CAPTURE(refused.err);
        CHECK(refused.code == 4);
        CHECK(refused.peak_mib < 100 * 1.1);
        CHECK(refused.err.find("without --audit") != std::string::npos);
        CHECK(refused.err.find("or leave out --audit, or set --levels to 3") != std::string::npos);
        const Run fits = in_memory("100M", false);
        CHECK(fits.code == 0);
        CHECK(fits.peak_mib < 100 * 1.1);
        // A mesh whose file alone is larger.
        write_file(folder / "large.obj", cube_obj + std::string(std::size_t(80) << 20, '\n'));
        check_refused(folder,
                      {"displace", "large.obj", "--height", waves(folder), "--max-memory", "80M", "-o", "b.ply"}, 4,
                      "more than the 80 MiB it may use (--max-memory); split the file, or raise --max-memory");
    }
#endif

    TEST_CASE("displace: an error that cannot be reached is refused at once, with one that can") {
        const Folder folder;
        write_file(folder / "cube.obj", cube_obj);
        for (const char* mesh : {torus.c_str(), "cube.obj"})
            for (const char* error : {"1e-30", "1e-9", "1e-7%", "1.5e-7"}) { // beyond the floats; beyond the memory
                const std::vector<std::string> arguments = {"displace",     mesh,    "--height",    waves(folder),
                                                            "-o",           "a.ply", "--max-error", error,
                                                            "--max-memory", "100M"};
                check_refused(folder, arguments, 4, "cannot be reached", {.seconds = 60});
                const Run run = run_bake(folder, arguments);
                CAPTURE(run.err);
                CHECK(run.seconds < 10);
                CHECK(run.err.find("set --max-error to ") != std::string::npos);
            }
        check_refused(folder, {"displace", torus, "--height", waves(folder), "-o", "a.ply", "--levels", "11"}, 2,
                      "--levels");
    }

    TEST_CASE("displace: Ctrl-C ends the search for rates and the audit within a second") {
        const Folder folder;
        const auto interrupted = [&](std::vector<std::string> arguments, double after) {
            arguments.insert(arguments.begin(), {"displace", torus, "--height", waves(folder), "-o", "a.ply"});
            const Run run = run_bake(folder, arguments, {.seconds = 100, .interrupt_after = after});
            CAPTURE(run.err);
            CHECK(run.code == 130);
            CHECK(run.seconds < after + 1);
        };
        interrupted({"--max-error", "0.0003%"}, 1);
        interrupted({"--levels", "6", "--measure", "--audit"}, 0.5);
    }

} // TEST_SUITE
