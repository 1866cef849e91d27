// Runs a fuzz target without its engine: run_seeds FILE_OR_FOLDER ... gives each file to the target, and then, the same in
// every run, versions of it that are cut short or have bytes changed. For builds without libFuzzer, and for its findings.
#include "fuzz/fuzz.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

std::vector<fs::path> files_of(int count, char** names) {
    std::vector<fs::path> files;
    for (int i = 0; i < count; ++i)
        if (fs::is_directory(names[i]))
            for (const auto& entry : fs::directory_iterator(names[i])) files.push_back(entry.path());
        else files.emplace_back(names[i]);
    std::sort(files.begin(), files.end());
    return files;
}

void run(const Bytes& bytes) {
    // A copy of its own size, so that the address sanitizer sees reads beyond the end.
    const Bytes exact(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

void run_versions(const Bytes& seed) {
    constexpr std::size_t cuts = 16, changes = 64;
    for (std::size_t i = 0; i < cuts; ++i) run({seed.begin(), seed.begin() + std::ptrdiff_t(seed.size() * i / cuts)});
    std::uint64_t state = seed.size();
    const auto random = [&state] { return (state = state * 6364136223846793005u + 1442695040888963407u) >> 33; };
    for (std::size_t i = 0; i < changes && !seed.empty(); ++i) {
        Bytes changed = seed;
        for (std::size_t k = 0; k <= i % 4; ++k) changed[random() % changed.size()] = std::uint8_t(random());
        run(changed);
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::vector<fs::path> files = files_of(argc - 1, argv + 1);
    for (const fs::path& file : files) {
        std::ifstream in(file, std::ios::binary);
        const Bytes seed{std::istreambuf_iterator<char>(in), {}};
        run(seed);
        run_versions(seed);
    }
    std::printf("%zu seeds\n", files.size());
    return files.empty();
}
