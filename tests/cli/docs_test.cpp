// The examples of the README and of the pages in docs/, run as they are printed.
#include "cli/command.h"
#include <sstream>

using namespace bake::test;

namespace {

/// A fenced block of a page: ```language, lines, ```.
struct Block {
    std::string language, text;
};

std::vector<Block> blocks_of(const fs::path& page) {
    std::vector<Block> blocks;
    std::istringstream in(contents(page.string()));
    bool inside = false;
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("```")) {
            if (inside = !inside; inside) blocks.push_back({line.substr(3), ""});
        } else if (inside) {
            blocks.back().text += line + "\n";
        }
    return blocks;
}

/// Whether a shell runs the block in the folder without an error, `bake` being the command to test.
bool runs(const Folder& folder, const std::string& block) {
    const fs::path script = fs::path(folder / "block.sh"), log = fs::path(folder / "block.log");
    write_file(script.string(), block);
    const std::string command = "cd '" + folder.path.string() + "' && PATH='" +
                                fs::path(std::getenv("BAKE")).parent_path().string() + "':\"$PATH\" sh -eu '" +
                                script.string() + "' >'" + log.string() + "' 2>&1";
    const bool good = std::system(command.c_str()) == 0;
    if (!good) MESSAGE(contents(log.string()));
    return good;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("docs: every example runs where meshes/ is") {
        std::vector<fs::path> pages = {source_folder() / "README.md"};
        for (const auto& entry : fs::directory_iterator(source_folder() / "docs"))
            if (entry.path().extension() == ".md") pages.push_back(entry.path());
        int examples = 0;
        for (const fs::path& page : pages) {
            const Folder folder;
            fs::create_directory_symlink(own_meshes(), folder / "meshes");
            for (const Block& block : blocks_of(page)) {
                // A file of an example begins with its name: "# spheres.toml".
                if (block.language == "toml" && block.text.starts_with("# "))
                    write_file(folder / block.text.substr(2, block.text.find('\n') - 2), block.text);
                if (block.language != "sh") continue;
                CAPTURE(block.text);
                CHECK_MESSAGE(runs(folder, block.text), page.filename());
                ++examples;
            }
        }
        CHECK(examples >= 10);
    }
}
