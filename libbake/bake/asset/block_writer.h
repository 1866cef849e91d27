// Large files written in blocks that all threads fill, one after the other, atomically.
#pragma once
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace bake {

/// The file appears under its name on commit(), and not at all without. Every function throws
/// Error{Refusal::unwritable} when the disk is full or the folder is not writable.
class BlockWriter {
public:
    explicit BlockWriter(const std::string& path);
    ~BlockWriter();
    BlockWriter(const BlockWriter&) = delete;
    BlockWriter& operator=(const BlockWriter&) = delete;

    void write(const std::string& block);
    void commit();

private:
    [[noreturn]] void refuse();

    std::string path_;
    OutputFile file_;
    std::FILE* stream_;
};

/// Writes rows [0, rows) in order; append_row(block, row) appends the bytes of one to a block. The bytes do not depend
/// on the number of threads; memory is that of some tens of thousand rows.
template <class AppendRow> void write_rows(BlockWriter& out, std::size_t rows, AppendRow&& append_row) {
    const std::size_t block_rows = 4096, most_blocks = 64;
    std::vector<std::string> blocks(std::min(most_blocks, (rows + block_rows - 1) / block_rows));
    for (std::size_t first = 0; first < rows; first += block_rows * most_blocks) {
        const std::size_t count = std::min(block_rows * most_blocks, rows - first);
        for_rows(static_cast<std::int64_t>(count), block_rows, [&](std::int64_t begin, std::int64_t end) {
            std::string& block = blocks[static_cast<std::size_t>(begin) / block_rows];
            for (std::int64_t row = begin; row < end; ++row) append_row(block, first + static_cast<std::size_t>(row));
        });
        for (std::string& block : blocks) {
            out.write(block);
            block.clear();
        }
    }
}

} // namespace bake
