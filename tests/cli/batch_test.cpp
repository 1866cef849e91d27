#include "cli/batch_manifest.h"
#include <chrono>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace bake::test;

namespace {

const std::string bricks = (own_meshes() / "bricks.png").string(), torus = (own_meshes() / "torus.obj").string();

nlohmann::json batch(const Folder& folder, const std::vector<std::string>& more = {}, int code = 0) {
    std::vector<std::string> words = {"batch", "m.toml", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Run run = run_bake(folder, words);
    CHECK(run.code == code);
    CAPTURE(run.err);
    return nlohmann::json::parse(run.out)["tasks"];
}

std::string why(const nlohmann::json& tasks, const std::string& name) {
    for (const auto& task : tasks)
        if (task["name"] == name) return task["result"].get<std::string>() + ": " + task["why"].get<std::string>();
    return "";
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("batch: runs what changed alone, and files are those of single commands") {
        const Folder folder;
        write_manifest(folder.path);
        const auto first = batch(folder);
        CHECK(first.size() == 5);
        for (const auto& task : first) CHECK(task["result"] == "done");
        CHECK(run_bake(folder, {"normal-map", "torus.obj", "--height=heights/a.png", "--residual-of=moved.ply",
                                "--amplitude=0.05", "--size=32", "--out=alone.png"})
                  .code == 0);
        CHECK(contents(folder / "alone.png") == contents(folder / "rest.png"));
        for (const auto& task : batch(folder)) CHECK(task["result"] == "unchanged");

        fs::copy_file(own_meshes() / "ripples.png", folder / "heights/b.png", fs::copy_options::overwrite_existing);
        fs::remove(folder / "flat_c.png");
        const auto plan = batch(folder, {"--dry-run"});
        CHECK(why(plan, "flat_b") == "to run: inputs changed: heights/b.png");
        CHECK(why(plan, "flat_c") == "to run: output missing: flat_c.png");
        CHECK(why(plan, "moved") == "unchanged: ");
        CHECK(!fs::exists(folder / "flat_c.png"));
        const auto second = batch(folder);
        CHECK(why(second, "flat_b") == "done: inputs changed: heights/b.png");
        CHECK(why(second, "flat_a") == "unchanged: ");
        CHECK(fs::exists(folder / "flat_c.png"));
        CHECK(why(batch(folder, {"--force", "--filter", "rest"}), "moved") == "done: forced");
    }

    TEST_CASE("batch: files that an input names are inputs too") {
        const Folder folder;
        CHECK(run_bake(folder, {"displace", torus, "--height", bricks, "--levels", "1", "-o", "torus.gltf"}).code == 0);
        write_file(folder / "m.toml", "manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"surface\"\nfiles = "
                                      "[\"torus.gltf\"]\noutputs = {out = \"a.ply\"}\n");
        batch(folder);
        CHECK(why(batch(folder), "a") == "unchanged: ");
        std::string buffer;
        for (const std::string& name : folder.names())
            if (name.ends_with(".bin")) buffer = name;
        REQUIRE(!buffer.empty());
        std::string bytes = contents(folder / buffer);
        bytes[2] ^= 1;
        write_file(folder / buffer, bytes);
        CHECK(why(batch(folder), "a") == "done: inputs changed: " + buffer);
    }

    TEST_CASE("batch: a pattern does not match what the bake itself wrote") {
        const Folder folder;
        fs::copy_file(bricks, folder / "a.png");
        fs::copy_file(bricks, folder / "b.png");
        write_file(folder / "m.toml",
                   "manifest = 1\n[[bake]]\nname = \"n\"\nverb = \"normal-map\"\nfiles = [\"*.png\"]\n"
                   "options = {size = \"16\"}\noutputs = {out = \"./{stem}_n.png\"}\n"
                   "[[bake]]\nname = \"second\"\nverb = \"bump-table\"\nfiles = [\"*_n.png\"]\n"
                   "outputs = {out = \"{stem}.exr\"}\n");
        for (int run = 0; run < 3; ++run) {
            const auto tasks = batch(folder, {"--dry-run"});
            CHECK(tasks.size() == 4);
            batch(folder);
        }
        CHECK(!fs::exists(folder / "a_n_n.png"));
    }

    TEST_CASE("batch: what tasks tell is told once, with the first that tells it") {
        const Folder folder;
        fs::copy_file(bricks, folder / "a.png");
        fs::copy_file(bricks, folder / "b.png");
        write_file(folder / "m.toml", "manifest = 1\n[[bake]]\nname = \"{stem}\"\nverb = \"normal-map\"\n"
                                      "files = [\"*.png\"]\noptions = {size = \"16\"}\n"
                                      "outputs = {out = \"maps/{stem}.png\"}\n");
        const Run run = run_bake(folder, {"batch", "m.toml"});
        REQUIRE(run.code == 0);
        CHECK(
            run.err.find("bake: a: amplitude 0.01, 1 % of the picture's width; --amplitude sets it; so in 2 tasks\n") !=
            std::string::npos);
        CHECK(run.err.find("bake: b:") == std::string::npos);
        CHECK(run_bake(folder, {"batch", "m.toml", "--force", "--quiet"}).err == "");
        const auto tasks = batch(folder, {"--force"});
        for (const auto& task : tasks) CHECK(task["notes"].size() == 1);
    }

    TEST_CASE("batch: goes on after a failure, and its code is that of the first one") {
        const Folder folder;
        write_manifest(folder.path,
                       "[[bake]]\nname = \"none\"\nverb = \"bump-table\"\nfiles = [\"none.png\"]\noutputs = {out "
                       "= \"none.exr\"}\n[[bake]]\nname = \"of_none\"\nverb = \"check\"\nfiles = "
                       "[\"none.exr\"]\noutputs = {out = \"none.txt\"}\n");
        const Run run = run_bake(folder, {"batch", "m.toml"});
        CHECK(run.code == 3);
        const std::size_t reason = run.err.find("bake: none: none.png: no such file");
        REQUIRE(reason != std::string::npos);
        CHECK(lines(run.err.substr(reason)) == 1); // behind the notes of the others
        CHECK(run.out.find("of_none  (needs none)") != std::string::npos);
        CHECK(run.out.find("5 done, 1 failed, 1 skipped") != std::string::npos);
        CHECK(fs::exists(folder / "rest.png"));
        CHECK(why(batch(folder, {}, 3), "none") == "failed: new");
    }

    TEST_CASE("batch: Ctrl-C leaves what is finished, and the next run does the rest") {
        const Folder folder;
        std::string more;
        for (int i = 0; i < 200; ++i)
            more += "[[bake]]\nname = \"m" + std::to_string(i) + "\"\nverb = \"normal-map\"\nfiles = [\"" + bricks +
                    "\"]\noutputs = {out = \"m" + std::to_string(i) + ".png\"}\n";
        write_manifest(folder.path, more);
        const Run run = run_bake(folder, {"batch", "m.toml"}, {.seconds = 60, .interrupt_after = 0.5});
        CHECK(run.code == 130);
        std::size_t made = 0;
        for (const std::string& name : folder.names()) {
            made += name.starts_with("m") && name.ends_with(".png");
            CHECK(!name.starts_with(".bake-"));
        }
        CHECK(made < 200);
        std::size_t unchanged = 0;
        for (const auto& task : batch(folder, {"--dry-run"})) unchanged += task["result"] == "unchanged";
        CHECK(unchanged >= made);
    }

    TEST_CASE("batch: refuses what it cannot plan, and runs nothing") {
        const Folder folder;
        check_refused(folder, {"batch", "m.toml"}, 3, "m.toml: no such file");
        write_file(folder / "m.toml",
                   "manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"batch\"\noutputs = {out = \"b\"}\n");
        check_refused(folder, {"batch", "m.toml"}, 3, "runs bake batch");
        write_file(folder / "m.toml",
                   "manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"check\"\noutputs = {out = \"b\"}\n");
        check_refused(folder, {"batch", "m.toml", "--filter", "c*"}, 2, "no task has a name like");
    }

    TEST_CASE("batch: a task whose command writes nothing fails, and is no done one the next time") {
        const Folder folder;
        fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
        write_file(folder / "m.toml", "manifest = 1\n[[bake]]\nname = \"a\"\nverb = \"bump-table\"\nfiles = "
                                      "[\"dots.png\"]\noptions = {help = true}\noutputs = {out = \"a.exr\"}\n");
        for (int time = 0; time < 2; ++time) {
            const auto tasks = batch(folder, {}, 5);
            CHECK(tasks[0]["result"] == "failed");
            CHECK(tasks[0]["message"].get<std::string>().find("a.exr: was not written") != std::string::npos);
        }
    }
}
