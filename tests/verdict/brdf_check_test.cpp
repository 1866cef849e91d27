#include "bake/verdict/brdf_check.h"
#include "light/lobes.h"
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {

    TEST_CASE(
        "check_brdf: the lecture's phong needs n = 2 pi - 1, or 2 pi - 2 with the cosine, and is not reciprocal") {
        const BrdfReport report = check_brdf("phong", sum_of({cosine_lobe(LobeKind::phong, 3)}));
        CHECK(report.positive());
        CHECK_FALSE(report.as_written.conserved());
        CHECK(report.as_written.largest == doctest::Approx(2 * pi / 4).epsilon(1e-3));
        CHECK(report.as_written.largest_deg == 0);
        CHECK(report.as_rendered.conserved());
        CHECK(report.as_rendered.largest == doctest::Approx(2. / 4).epsilon(1e-3));
        REQUIRE(report.exponents.size() == 1);
        CHECK(report.exponents[0].as_written == doctest::Approx(2 * pi - 1));
        CHECK(report.exponents[0].with_cosine == doctest::Approx(2 * pi - 2));
        CHECK(report.exponents[0].as_rendered == doctest::Approx(1));
        CHECK_FALSE(report.reciprocity.reciprocal());
        CHECK(report.reciprocity.ratio == doctest::Approx(1 / std::cos(85 * pi / 180)).epsilon(1e-3));
        CHECK(report.reciprocity.from_deg == 85);
        CHECK(report.reciprocity.to_deg == 0);
        CHECK(report.ratio_20_70 == doctest::Approx(std::cos(70 * pi / 180) / std::cos(20 * pi / 180)).epsilon(1e-3));
        CHECK(report.findings.warnings.empty());
    }

    TEST_CASE("check_brdf: the exponent that is named is the border") {
        for (const LobeKind kind : {LobeKind::phong, LobeKind::blinn}) {
            const double need = check_brdf("", sum_of({cosine_lobe(kind, 1, 1.5f)})).exponents.at(0).as_rendered;
            CHECK(need > 1);
            const auto largest = [&](double n) {
                return check_brdf("", sum_of({cosine_lobe(kind, float(n), 1.5f)})).as_rendered.largest;
            };
            CHECK(largest(need) == doctest::Approx(1).epsilon(1e-3));
            CHECK(largest(need - 0.2) > 1.01);
        }
    }

    TEST_CASE("check_brdf: normalised lobes, lambert and ggx keep all requirements") {
        for (const Bsdf& bsdf :
             {sum_of({lobe(LobeKind::lambert)}), sum_of({cosine_lobe(LobeKind::normalised_phong, 10)}),
              sum_of({cosine_lobe(LobeKind::normalised_blinn, 1)}), sum_of({ggx_lobe(0.3f)}),
              sum_of({ggx_lobe(0.05f, 0.04f)}), metallic_roughness(Vec3f(1), 0, 0.5f)}) {
            const BrdfReport report = check_brdf("", bsdf);
            CHECK(report.positive());
            CHECK(report.as_rendered.conserved());
            CHECK(report.as_written.largest == report.as_rendered.largest);
            CHECK(report.reciprocity.reciprocal());
            CHECK(report.exponents.empty());
        }
        // Lambert of albedo 1 beside, not under, a lobe reflects the sum.
        const BrdfReport sum =
            check_brdf("", sum_of({lobe(LobeKind::lambert), cosine_lobe(LobeKind::normalised_blinn, 9, 0.5f)}));
        CHECK(sum.as_rendered.largest == doctest::Approx(1.5).epsilon(1e-3));
        CHECK(sum.findings.warnings.size() == 1);
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("check_brdf: a negative weight is not positive, and takes its albedo away") {
        const BrdfReport report =
            check_brdf("", sum_of({lobe(LobeKind::lambert, 0.5f), cosine_lobe(LobeKind::phong, 10, -0.4f)}));
        CHECK_FALSE(report.positive());
        CHECK(report.least < 0);
        CHECK(report.as_rendered.albedo[0] == doctest::Approx(0.5 - 0.4 * 2 / 11).epsilon(1e-3));
        CHECK(report.findings.warnings.size() == 1);
    }

    TEST_CASE("check_brdf: a narrow lobe is compared where it is not 0") {
        CHECK_FALSE(check_brdf("", sum_of({cosine_lobe(LobeKind::phong, 1e5f)})).reciprocity.reciprocal());
        CHECK(check_brdf("", sum_of({cosine_lobe(LobeKind::normalised_phong, 1e5f)})).reciprocity.reciprocal());
    }

    TEST_CASE("check_brdf: the narrower a lobe is, the nearer to the mirror direction it is compared") {
        // The lobes are 0 at the next larger angle that is tried. Phong's f has n.l in its denominator.
        for (const auto& [exponent, off] : {std::pair(3e4f, 1.0), {2e5f, 0.3}, {3e6f, 0.1}}) {
            const BrdfRatio found = check_brdf("", sum_of({cosine_lobe(LobeKind::phong, exponent)})).reciprocity;
            CHECK(std::abs(found.from_deg - found.to_deg) == doctest::Approx(off).epsilon(1e-6));
            CHECK(found.ratio ==
                  doctest::Approx(std::cos(80 * pi / 180) / std::cos((80 + off) * pi / 180)).epsilon(1e-4));
        }
    }

    TEST_CASE("check_brdf: text and JSON have the same figures, and one line per angle") {
        const BrdfReport report = check_brdf("phong:n=3", sum_of({cosine_lobe(LobeKind::phong, 3)}));
        const std::string text = to_text(report);
        CHECK(text.starts_with("phong:n=3\n  positive       yes"));
        CHECK(text.find("n >= 5.28 (2 pi s - 1)") != std::string::npos);
        CHECK(text.find("n >= 4.28 (2 pi s - 2)") != std::string::npos);
        CHECK(text.find("= 0.364\n") != std::string::npos);
        CHECK(text.find("\n  85 deg ") != std::string::npos);
        const auto json = nlohmann::json::parse(to_json(report));
        CHECK(json["energy"]["as_written"]["conserved"] == false);
        CHECK(json["energy"]["as_rendered"]["albedo"].size() == 18);
        CHECK(json["reciprocity"]["holds"] == false);
        CHECK(json["exponents"][0]["as_written"].get<double>() == doctest::Approx(5.2832));
    }

} // TEST_SUITE
