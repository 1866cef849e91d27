// What bake batch --emit writes, run by the programs that it is for.
#include "bake/base/shell_word.h"
#include "cli/batch_manifest.h"
#include <nlohmann/json.hpp>
#include <sstream>

using namespace bake::test;

namespace {

using Json = nlohmann::ordered_json;

bool no_ninja() { return std::system("ninja --version >/dev/null") != 0; }
bool no_ajv() {
    return !std::getenv("BAKE_NEEDS_VALIDATOR") &&
           !fs::exists(source_folder() / "build/openjd_validator/node_modules/ajv");
}

/// Exit code of a line of a shell in `folder`, where `bake` is the program under test. `tools`: a folder of other programs.
int shell(const fs::path& folder, const std::string& line, const std::string& tools = "") {
    const std::string path = (tools.empty() ? "" : tools + ":") + fs::path(std::getenv("BAKE")).parent_path().string();
    return WEXITSTATUS(std::system(
        ("cd " + bake::shell_word(folder) + " && PATH=" + bake::shell_word(path) + ":$PATH " + line).c_str()));
}

/// Checks that the files of write_manifest() in `made` have the bytes of bake batch.
void check_bytes(const Folder& folder, const fs::path& made) {
    fs::create_directory(folder / "serial");
    write_manifest(folder / "serial");
    REQUIRE(run_bake(folder, {"batch", "serial/m.toml"}).code == 0);
    for (const char* name : {"flat_a.png", "flat_c.png", "moved.ply", "rest.png"}) {
        CAPTURE(name);
        CHECK(contents((made / name).string()) == contents((folder.path / "serial" / name).string()));
    }
}

/// A template as a render manager runs it: each task of each step is the embedded file with its arguments.
void run_template(const Json& job, const fs::path& there, const std::string& folder) {
    for (const Json& step : job["steps"]) {
        const Json& script = step["script"];
        write_file((there / "run.sh").string(), script["embeddedFiles"][0]["data"]);
        const std::string range = step["parameterSpace"]["taskParameterDefinitions"][0]["range"];
        for (int i = 0; i <= std::stoi(range.substr(2)); ++i) {
            std::string line = "bash run.sh";
            for (std::string word : script["actions"]["onRun"]["args"]) {
                if (word == "{{Param.Folder}}") word = folder;
                if (word == "{{Task.Param.Job}}") word = std::to_string(i);
                line += " " + bake::shell_word(word);
            }
            CHECK(shell(there, line + " >log") == 0);
        }
    }
}

Json emitted_job(const Folder& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"batch", "m.toml", "--emit", "openjd"};
    words.insert(words.end(), more.begin(), more.end());
    const Run run = run_bake(folder, words);
    REQUIRE(run.code == 0);
    return Json::parse(run.out);
}

/// The names of those of the templates in which scripts/openjd_validator finds a fault.
std::set<std::string> refused(const Folder& folder, const std::vector<Json>& jobs) {
    std::string line = bake::shell_word((source_folder() / "scripts/openjd_validator").string());
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        write_file(folder / std::to_string(i), jobs[i].dump());
        line += " " + std::to_string(i);
    }
    const int code = shell(folder.path, line + " >faults");
    std::set<std::string> names;
    std::istringstream faults(contents(folder / "faults"));
    for (std::string fault; std::getline(faults, fault);) names.insert(fault.substr(0, fault.find(':')));
    CHECK(code == (names.empty() ? 0 : 1));
    return names;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("batch: Ninja runs what it emits, and then nothing" * doctest::skip(no_ninja())) {
        const Folder folder;
        write_manifest(folder.path);
        REQUIRE(run_bake(folder, {"batch", "m.toml", "--emit", "ninja", "-o", "build.ninja"}).code == 0);
        CHECK(shell(folder.path, "ninja >log") == 0);
        check_bytes(folder, folder.path);
        CHECK(shell(folder.path, "ninja >log") == 0);
        CHECK(contents(folder / "log").find("no work to do") != std::string::npos);
    }

    TEST_CASE("batch: Ninja knows the six files of a pattern, and has their folder made" * doctest::skip(no_ninja())) {
        const Folder folder;
        for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
            const std::string name = std::string("sky_") + face + ".png";
            fs::copy_file(own_meshes() / name, folder / name);
        }
        write_file(folder / "m.toml",
                   "manifest = 1\n[[bake]]\nname = \"less\"\nverb = \"cubemap\"\nfiles = [\"sky_%s.png\"]\n"
                   "options = {size = \"4\"}\noutputs = {out = \"less/new/sky_%s.exr\"}\n"
                   "[[bake]]\nname = \"least\"\nverb = \"cubemap\"\nfiles = [\"./less/new/sky_%s.exr\"]\n"
                   "options = {size = \"2\"}\noutputs = {out = \"least.exr\"}\n");
        REQUIRE(run_bake(folder, {"batch", "m.toml", "--emit", "ninja", "-o", "build.ninja"}).code == 0);
        CHECK(shell(folder.path, "ninja >log") == 0);
        CHECK(fs::exists(folder / "least.exr"));
        CHECK(shell(folder.path, "ninja >log") == 0);
        CHECK(contents(folder / "log").find("no work to do") != std::string::npos);
        fs::last_write_time(folder / "sky_nz.png", fs::file_time_type::clock::now() + std::chrono::hours(1));
        CHECK(shell(folder.path, "ninja >log") == 0);
        CHECK(contents(folder / "log").find("no work to do") == std::string::npos);
        fs::remove(folder / "sky_py.png");
        REQUIRE(run_bake(folder, {"batch", "m.toml", "--emit", "ninja", "-o", "build.ninja"}).code == 0);
        CHECK(shell(folder.path, "ninja >log 2>&1") != 0);
        CHECK(contents(folder / "log").find("sky_py.png") != std::string::npos);
    }

    TEST_CASE("batch: --emit refuses names that a format cannot have") {
        const Folder folder;
        const auto emit = [&](const std::string& name, const std::string& format) {
            write_file(folder / "m.toml", "manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"bump-table\"\nfiles = [\"" +
                                              name + "\"]\noutputs = {out = \"a.exr\"}\n");
            return run_bake(folder, {"batch", "m.toml", "--emit", format, "-o", "out"});
        };
        for (const auto& [name, format] : {std::pair("a|b.png", "ninja"), {"a{{b}}.png", "openjd"}}) {
            fs::copy_file(own_meshes() / "dots.png", folder.path / name);
            const Run run = emit("a*b*.png", format);
            CHECK(run.code == 4);
            CHECK(run.err.find(name) != std::string::npos);
            CHECK(!fs::exists(folder / "out"));
            fs::remove(folder.path / name);
        }
    }

    TEST_CASE("batch: an input that a task writes beside its output does not stop Ninja") {
        const Folder folder;
        fs::copy_file(own_meshes() / "torus.obj", folder / "torus.obj");
        fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
        write_file(folder / "m.toml",
                   "manifest = 1\n[[bake]]\nname = \"asset\"\nverb = \"normal-map\"\nfiles = [\"torus.obj\"]\n"
                   "inputs = {height = \"dots.png\"}\noptions = {amplitude = \"1%\", size = \"16\"}\n"
                   "outputs = {out = \"x/t.usda\"}\n"
                   "[[bake]]\nname = \"use\"\nverb = \"bump-table\"\nfiles = [\"x/t_normal.png\"]\nafter = "
                   "[\"asset\"]\noutputs = {out = \"x/t.exr\"}\n");
        REQUIRE(run_bake(folder, {"batch", "m.toml", "--emit", "ninja", "-o", "build.ninja"}).code == 0);
        CHECK(shell(folder.path, "ninja >log") == 0);
        CHECK(fs::exists(folder / "x/t.exr"));
    }

    TEST_CASE("batch: the lines of --emit commands make the same files") {
        const Folder folder;
        write_manifest(folder.path);
        const Run run = run_bake(folder, {"batch", "m.toml", "--emit", "commands"});
        REQUIRE(run.code == 0);
        write_file(folder / "lines.sh", run.out);
        CHECK(shell(folder.path, "sh -e lines.sh >log") == 0);
        check_bytes(folder, folder.path);
    }

    TEST_CASE("batch: the script for Slurm runs its tasks, and after a failure of the machine those that are left") {
        const Folder folder;
        const fs::path there = folder.path / "it's, a folder";
        fs::create_directories(there);
        write_manifest(there);
        REQUIRE(run_bake(folder, {"batch", "it's, a folder/m.toml", "--emit", "slurm", "--chunk", "3", "-o", "farm.sh"})
                    .code == 0);
        // An sbatch that runs the array at once, each job twice, without variables of its caller.
        fs::create_directories(folder / "bin");
        write_file(folder / "bin/sbatch",
                   "#!/bin/bash\nlog=${0%/*}/../sbatch.log\necho \"$@\" >>\"$log\"\n"
                   "[ $(wc -l <\"$log\") -le 2 ] || exit\n"
                   "for word in \"$@\"; do case $word in --array=0-*) last=${word##*-} ;; esac; done\n"
                   "for ((i = 0; i <= last; ++i)); do for again in 1 2; do\n"
                   "env -i PATH=\"$PATH\" ASAN_OPTIONS=\"$ASAN_OPTIONS\" SLURM_ARRAY_TASK_ID=$i bash \"${@: -4}\" || "
                   "exit; done; done >&2\necho 7\n");
        fs::permissions(folder / "bin/sbatch", fs::perms::owner_all);
        CHECK(shell(folder.path, "bash farm.sh --partition=night >log", folder / "bin") == 0);
        check_bytes(folder, there);
        const std::string log = contents(folder / "sbatch.log");
        CHECK(log.find("--array=0-1 --job-name=bake-0") != std::string::npos); // four tasks by threes
        CHECK(log.find("--array=0-0 --job-name=bake-1") != std::string::npos);
        CHECK(log.find("--dependency=afterok:7 --kill-on-invalid-dep=yes --partition=night") != std::string::npos);
    }

    TEST_CASE("batch: the OpenJD template has a step for each level, and its tasks make the same files") {
        const Folder folder;
        write_manifest(folder.path);
        const Json job = emitted_job(folder, {"--chunk", "2"});
        CHECK(job["specificationVersion"] == "jobtemplate-2023-09");
        REQUIRE(job["steps"].size() == 2);
        CHECK(job["steps"][0]["parameterSpace"]["taskParameterDefinitions"][0]["range"] == "0-1");
        CHECK(job["steps"][1]["dependencies"][0]["dependsOn"] == job["steps"][0]["name"]);
        const fs::path there = folder.path / "it's 'a\" $folder";
        fs::create_directories(there);
        write_manifest(there);
        run_template(job, folder.path, there.string());
        check_bytes(folder, there);
    }

    TEST_CASE("batch: the OpenJD template is as the specification says" * doctest::skip(no_ajv())) {
        const Folder folder;
        write_manifest(folder.path);
        fs::copy_file(folder / "m.toml", folder / "{{a}}\n.toml");
        const Run odd = run_bake(folder, {"batch", "{{a}}\n.toml", "--emit", "openjd"});
        CHECK(refused(folder, {emitted_job(folder), Json::parse(odd.out)}).empty());
    }

    TEST_CASE("batch: the schema of OpenJD templates refuses broken ones" * doctest::skip(no_ajv())) {
        const Folder folder;
        write_manifest(folder.path);
        const Json whole = emitted_job(folder);
        const std::string action = "/steps/0/script/actions/onRun", file = "/steps/0/script/embeddedFiles/0",
                          tasks = "/steps/0/parameterSpace/taskParameterDefinitions/0";
        // Null: the key is missing.
        const std::vector<std::pair<std::string, Json>> broken = {{"/specificationVersion", "jobtemplate-2023-10"},
                                                                  {"/name", "two\nlines"},
                                                                  {"/name", "{{Param.Folder"},
                                                                  {"/name", nullptr},
                                                                  {"/extra", 1},
                                                                  {"/steps", Json::array()},
                                                                  {"/steps", nullptr},
                                                                  {"/steps/0/name", std::string(65, 'a')},
                                                                  {"/steps/1/dependencies", Json::array()},
                                                                  {"/steps/1/dependencies/0", "Level0"},
                                                                  {"/parameterDefinitions/0/name", "a folder"},
                                                                  {"/parameterDefinitions/0/type", "FOLDER"},
                                                                  {"/parameterDefinitions/0/dataFlow", "BOTH"},
                                                                  {"/parameterDefinitions/0/minValue", 1},
                                                                  {tasks + "/range", "0-"},
                                                                  {tasks + "/range", Json::array()},
                                                                  {tasks + "/type", "PATH"},
                                                                  {action + "/command", nullptr},
                                                                  {action + "/command", ""},
                                                                  {action + "/args/0", 3},
                                                                  {action + "/timeout", 0},
                                                                  {file + "/type", "BINARY"},
                                                                  {file + "/data", ""},
                                                                  {file + "/data", "echo {{ 1 + 2 }}"},
                                                                  {file + "/filename", "a/b"},
                                                                  {file + "/runnable", "yes"}};
        std::vector<Json> jobs;
        for (const auto& [at, value] : broken) {
            jobs.push_back(whole);
            const Json::json_pointer pointer(at);
            if (value.is_null()) jobs.back()[pointer.parent_pointer()].erase(pointer.back());
            else jobs.back()[pointer] = value;
        }
        const std::set<std::string> found = refused(folder, jobs);
        for (std::size_t i = 0; i < broken.size(); ++i) {
            CAPTURE(broken[i].first);
            CAPTURE(broken[i].second.dump());
            CHECK(found.contains(std::to_string(i)));
        }
    }
}
