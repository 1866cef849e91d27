// Files for tests of comparisons, in a folder of their own.
#pragma once
#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "verdict/metric/pictures.h"

namespace bake::test {

struct Files {
    Folder folder;
    std::string write(const std::string& name, const Image<float>& image, const WriteOptions& options = {}) const {
        write_image(folder / name, image, options);
        return folder / name;
    }
    /// Floats in an .exr of full precision.
    std::string exr(const std::string& name, const Image<float>& image) const {
        return write(name, image, {.depth = Depth::float32});
    }
    /// 8-bit levels, untagged.
    std::string png(const std::string& name, const Image<float>& image) const {
        return write(name, image, {.depth = Depth::u8});
    }
};

/// What the call is refused with; empty if it is not.
template <class Call> std::string refusal(Refusal why, const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.refusal == why);
        return error.what();
    }
    return "";
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace bake::test
