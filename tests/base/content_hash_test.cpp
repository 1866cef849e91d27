#include "bake/base/content_hash.h"
#include "folders.h"
#include <doctest/doctest.h>
#include <fstream>
#include <string>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("content_hash: that of no bytes is the published one, and one changed bit changes it") {
        CHECK(content_hash("", 0) == "99aa06d3014798d86001c324468d497f");
        std::string bytes(100000, 'a');
        const std::string before = content_hash(bytes.data(), bytes.size());
        CHECK(before.size() == 32);
        bytes[77777] ^= 1;
        CHECK(content_hash(bytes.data(), bytes.size()) != before);
    }

    TEST_CASE("file_hash: of a file larger than a block as of its bytes, and none without a file") {
        const std::string file = (std::filesystem::temp_directory_path() / "bake_content_hash_test").string();
        std::string bytes(700001, '\0');
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = char(i * i >> 3);
        std::ofstream(file, std::ios::binary) << bytes;
        CHECK(file_hash(file) == content_hash(bytes.data(), bytes.size()));
        std::filesystem::remove(file);
        CHECK(!file_hash(file));
        CHECK(!file_hash(std::filesystem::temp_directory_path().string()));
    }
}
