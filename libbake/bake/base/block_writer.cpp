#include "bake/base/block_writer.h"
#include "bake/base/error.h"
#include <cerrno>
#include <cstring>
#include <utility>

namespace bake {

BlockWriter::BlockWriter(const std::string& path)
    : path_(path), file_(path), stream_(std::fopen(file_.temporary().c_str(), "wb")) {
    if (!stream_) refuse();
}

BlockWriter::~BlockWriter() {
    if (stream_) std::fclose(stream_);
}

void BlockWriter::write(std::string_view block) {
    if (std::fwrite(block.data(), 1, block.size(), stream_) != block.size()) refuse();
}

void BlockWriter::commit() {
    if (std::fclose(std::exchange(stream_, nullptr)) != 0) refuse();
    file_.commit();
}

void BlockWriter::refuse() {
    throw Error(Refusal::unwritable, path_ + ": cannot be written (" + std::strerror(errno) + "); is the disk full?");
}

} // namespace bake
