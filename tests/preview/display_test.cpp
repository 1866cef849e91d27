// The protocol of tev, against a viewer of our own on the loopback interface.
#include "bake/base/error.h"
#include "bake/preview/display.h"
#include "preview/loopback_viewer.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("display: addresses") {
        const auto parsed = [](const char* text) {
            const DisplayAddress to = parse_display(text);
            return to.host + " " + to.port;
        };
        CHECK(parsed("localhost:1234") == "localhost 1234");
        CHECK(parsed("studio.example") == "studio.example 14158");
        CHECK(parsed("[::1]:99") == "::1 99");
        CHECK(parsed("[::1]") == "::1 14158");
        for (const char* wrong : {"", ":", ":80", "a:", "a:b", "a:0", "a:65536", "a:-1", "a:1:2", "::1", "[::1", "[]:1",
                                  "[::1]9", "a:999999999999"}) {
            CAPTURE(wrong);
            CHECK_THROWS_AS(parse_display(wrong), Error);
        }
    }

    TEST_CASE("display: a viewer gets the picture's size, its channels, and the values of each part") {
        LoopbackViewer viewer;
        {
            Display display(viewer.address(), "a b.png", 5, 3);
            display.update({1, 2, 2, 1}, {1, 2, 3, 4, 5, 6});
            CHECK(display.lost() == "");
        }
        const ShownPicture shown = viewer.wait();
        CHECK(shown.name == "a b.png");
        CHECK(shown.to_front);
        CHECK(shown.channels == std::vector<std::string>{"R", "G", "B"});
        REQUIRE(shown.width == 5);
        REQUIRE(shown.height == 3);
        REQUIRE(shown.updates == 1);
        const std::vector<float> last_row(shown.values.begin() + 2 * 5 * 3, shown.values.end());
        CHECK(last_row == std::vector<float>{0, 0, 0, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0});
    }

    TEST_CASE("display: nobody listens; the host is unknown") {
        const std::string address = LoopbackViewer().address(); // closed at once
        for (const std::string& to : {address, std::string("no-such-host.invalid:14158")}) {
            std::string message;
            try {
                Display display(to, "a", 1, 1);
            } catch (const Error& error) {
                message = error.what();
                CHECK(error.refusal == Refusal::unwritable);
            }
            CHECK(message.starts_with(to + ": cannot be reached ("));
        }
    }

    TEST_CASE("display: a viewer that is closed is noticed, and nothing else happens") {
        auto viewer = std::make_unique<LoopbackViewer>();
        Display display(viewer->address(), "a", 64, 64);
        viewer->close_connection();
        viewer.reset();
        const std::vector<float> values(64 * 64 * 3);
        for (int i = 0; i < 1000 && display.lost().empty(); ++i) display.update({0, 0, 64, 64}, values);
        CHECK(display.lost() != "");
        display.update({0, 0, 64, 64}, values);
    }

} // TEST_SUITE
