// bake check --brdf from outside.
#include "cli/command.h"
#include <nlohmann/json.hpp>

using namespace bake::test;

TEST_SUITE("cli") {

    TEST_CASE("bake check --brdf: a report with exit code 0, whatever it says; --strict makes a gain of energy 1") {
        const Folder folder;
        const Run good = run_bake(folder, {"check", "--brdf", "phong:n=20,specular=.5"});
        CHECK(good.code == 0);
        CHECK(good.err.empty());
        CHECK(good.out.starts_with("phong:n=20,specular=.5\n"));
        CHECK(good.out.find("reciprocal     no") != std::string::npos);
        CHECK(run_bake(folder, {"check", "--strict", "--brdf", "phong:n=20,specular=.5"}).code == 0);
        const Run gain = run_bake(folder, {"check", "--brdf", "blinn:n=1"});
        CHECK(gain.code == 0);
        CHECK(gain.out.find("warning: gains energy") != std::string::npos);
        CHECK(run_bake(folder, {"check", "--strict", "--brdf", "blinn:n=1"}).code == 1);
    }

    TEST_CASE("bake check --brdf: every model, sums, several reports, and JSON") {
        const Folder folder;
        const Run run = run_bake(folder, {"check",  "--json",
                                          "--brdf", "lambert",
                                          "--brdf", "phong:n=1e+1",
                                          "--brdf", "blinn",
                                          "--brdf", "normalised-phong:specular=.3",
                                          "--brdf", "normalised-blinn:n=0",
                                          "--brdf", "ggx:roughness=.3,f0=.04",
                                          "--brdf", "lambert:albedo=.5+blinn:n=8,specular=.5+ggx",
                                          "--brdf", "ggx:f0=1+covered-lambert",
                                          "--brdf", "metallic-roughness:base=1,metallic=1"});
        REQUIRE(run.code == 0);
        const auto files = nlohmann::json::parse(run.out)["files"];
        REQUIRE(files.size() == 9);
        const auto albedo = [&](int i) {
            return files[std::size_t(i)]["energy"]["as_rendered"]["largest_albedo"].get<double>();
        };
        CHECK(albedo(0) == doctest::Approx(0.8).epsilon(1e-3));
        CHECK(albedo(1) == doctest::Approx(2. / 11).epsilon(1e-3));
        CHECK(albedo(3) == doctest::Approx(0.3).epsilon(1e-3));
        CHECK(albedo(4) == doctest::Approx(1).epsilon(1e-3));
        CHECK(albedo(7) == doctest::Approx(1).epsilon(1e-3));
        CHECK(albedo(8) == doctest::Approx(1).epsilon(1e-3));
        CHECK(files[6]["energy"]["as_written"]["largest_albedo"].get<double>() > albedo(6) + 0.5);
        CHECK(files[2]["brdf"] == "blinn");
    }

    TEST_CASE("bake check --brdf: unknown names and keys are refused with the nearest known one") {
        const Folder folder;
        check_refused(folder, {"check", "--brdf", "phog:n=3"}, 2, "did you mean phong?");
        check_refused(folder, {"check", "--brdf", "lambert+normalized-blinn"}, 2, "did you mean normalised-blinn?");
        check_refused(folder, {"check", "--brdf", "ggx:roughnes=1"}, 2, "did you mean roughness?");
        check_refused(folder, {"check", "--brdf", "ggx:roughness=1.5"}, 2, "from 0 to 1");
        for (const char* bad : {"nan", "inf", "1e999", "0x10", "", "-1", "2e6"})
            check_refused(folder, {"check", "--brdf", std::string("phong:n=") + bad}, 2, "--brdf phong:n");
        check_refused(folder, {"check", "--brdf", "phong:n=1,n=2"}, 2, "given twice");
        check_refused(folder, {"check", "--brdf", "phong:n"}, 2, "phong:n");
        check_refused(folder, {"check", "--brdf", "lambert+"}, 2, "is missing");
        check_refused(folder, {"check", "--brdf", "lambert+lambert+phong+blinn+ggx"}, 2, "more than 4 lobes");
        check_refused(folder, {"check", "--against", "a.obj", "--brdf", "ggx"}, 2, "--against");
    }

} // TEST_SUITE
