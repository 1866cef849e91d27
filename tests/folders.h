// The folders that tests read from.
#pragma once
#include <cstdlib>
#include <filesystem>

namespace bake::test {

/// The root of the sources: $BAKE_SOURCE, or else the working directory.
inline std::filesystem::path source_folder() {
    const char* folder = std::getenv("BAKE_SOURCE");
    return std::filesystem::absolute(folder ? folder : ".");
}

/// The collection of real files beside the sources. A test that reads it belongs to a suite that doctest skips and counts
/// where the collection is absent: TEST_SUITE("real" * doctest::skip(no_shared_data())).
inline std::filesystem::path shared_data() {
    return std::filesystem::weakly_canonical(source_folder() / "../shared/data");
}

inline bool no_shared_data() { return !std::filesystem::is_directory(shared_data()); }

/// The project's own meshes/.
inline std::filesystem::path own_meshes() { return source_folder() / "meshes"; }

} // namespace bake::test
