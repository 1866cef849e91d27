// A manifest that tests of bake batch run.
#pragma once
#include "cli/command.h"

namespace bake::test {

/// Writes m.toml and its files: a flat map of each of three heights, a displaced mesh, and a map of what that lacks.
inline void write_manifest(const fs::path& folder, const std::string& more = "") {
    fs::create_directories(folder / "heights");
    for (const char* name : {"a.png", "b.png", "c.png"})
        fs::copy_file(own_meshes() / "dots.png", folder / "heights" / name, fs::copy_options::overwrite_existing);
    fs::copy_file(own_meshes() / "torus.obj", folder / "torus.obj", fs::copy_options::overwrite_existing);
    write_file((folder / "m.toml").string(),
               "manifest = 1\n"
               "[[bake]]\nname = \"flat_{stem}\"\nverb = \"normal-map\"\nfiles = [\"heights/*.png\"]\n"
               "options = {amplitude = \"0.1\"}\noutputs = {out = \"flat_{stem}.png\"}\n"
               "[[bake]]\nname = \"rest\"\nverb = \"normal-map\"\nfiles = [\"torus.obj\"]\n"
               "inputs = {height = \"heights/a.png\", residual-of = \"moved.ply\"}\n"
               "options = {amplitude = \"0.05\", size = \"32\"}\noutputs = {out = \"rest.png\"}\n"
               "[[bake]]\nname = \"moved\"\nverb = \"displace\"\nfiles = [\"torus.obj\"]\n"
               "inputs = {height = \"heights/a.png\"}\noptions = {amplitude = \"0.05\", levels = \"1\"}\n"
               "outputs = {out = \"moved.ply\"}\n" +
                   more);
}

} // namespace bake::test
