#include "bake/base/block_writer.h"
#include "bake/base/error.h"
#include <cerrno>
#include <cstring>
#include <utility>

namespace bake {

BlockWriter::BlockWriter(const std::string& path) : path_(path), file_(path), stream_(file_.open_stream()) {}

BlockWriter::~BlockWriter() {
    if (stream_) std::fclose(stream_);
}

void BlockWriter::write(std::string_view block) {
    if (std::fwrite(block.data(), 1, block.size(), stream_) != block.size()) refuse();
    bytes_ += std::int64_t(block.size());
}

void BlockWriter::commit() {
    if (std::fclose(std::exchange(stream_, nullptr)) != 0) refuse();
    file_.commit();
}

int BlockWriter::descriptor() {
    if (std::fflush(stream_) != 0) refuse();
    return file_.open_descriptor();
}

void BlockWriter::refuse() { refuse_unwritten(path_, std::strerror(errno)); }

} // namespace bake
