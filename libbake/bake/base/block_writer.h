// Large files written in blocks that all threads fill, one after the other, atomically.
#pragma once
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace bake {

/// The file appears under its name on commit(), as OutputFile's, and not at all without. Every function throws
/// Error{Refusal::unwritable} when the disk is full or the folder is not writable.
class BlockWriter {
public:
    explicit BlockWriter(const std::string& path);
    ~BlockWriter();
    BlockWriter(const BlockWriter&) = delete;
    BlockWriter& operator=(const BlockWriter&) = delete;

    void write(std::string_view block);
    void commit();
    /// A descriptor of the file as written up to now, for reading, which the caller closes.
    int descriptor();
    std::int64_t bytes() const noexcept { return bytes_; } ///< written

private:
    [[noreturn]] void refuse();

    std::string path_;
    OutputFile file_;
    std::FILE* stream_;
    std::int64_t bytes_ = 0;
};

/// Puts the four bytes of a float or an integer, low byte first on any machine, and moves `to` behind them.
template <class T> void put_bytes(char*& to, T value) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) *to++ = char(bits >> (8 * i));
}

/// Writes rows [0, rows) in order; append_row(block, row) appends the text of one to a block. The bytes do not depend
/// on the number of threads; memory is that of some tens of thousand rows.
template <class AppendRow> void write_rows(BlockWriter& out, std::size_t rows, AppendRow&& append_row) {
    const std::size_t grain = 8192;
    auto blocks = std::vector<std::string>(std::size_t(slot_count()));
    in_order(
        std::int64_t((rows + grain - 1) / grain),
        [&](std::int64_t band, int slot) {
            std::string& block = blocks[std::size_t(slot)];
            block.clear();
            const std::size_t first = std::size_t(band) * grain;
            for (std::size_t row = first; row < std::min(rows, first + grain); ++row) append_row(block, row);
        },
        [&](std::int64_t, int slot) { out.write(blocks[std::size_t(slot)]); });
}

/// The same for rows whose bytes are counted beforehand: rows [first, end) take bytes(first, end), and
/// fill(first, end, to) writes them all.
template <class Bytes, class Fill> void write_blocks(BlockWriter& out, std::size_t rows, Bytes&& bytes, Fill&& fill) {
    const std::size_t grain = 1 << 15;
    auto blocks = std::vector<std::vector<char>>(std::size_t(slot_count()));
    const auto size = [&](std::int64_t band) {
        const std::size_t first = std::size_t(band) * grain;
        return bytes(first, std::min(rows, first + grain));
    };
    in_order(
        std::int64_t((rows + grain - 1) / grain),
        [&](std::int64_t band, int slot) {
            std::vector<char>& block = blocks[std::size_t(slot)];
            if (block.size() < size(band)) block.resize(size(band));
            const std::size_t first = std::size_t(band) * grain;
            fill(first, std::min(rows, first + grain), block.data());
        },
        [&](std::int64_t band, int slot) {
            out.write({blocks[std::size_t(slot)].data(), size(band)});
        });
}

/// The same for rows of `row_bytes` each; fill_row(to, row) writes one.
template <class FillRow>
void write_fixed_rows(BlockWriter& out, std::size_t rows, std::size_t row_bytes, FillRow&& fill_row) {
    write_blocks(
        out, rows, [row_bytes](std::size_t first, std::size_t end) { return (end - first) * row_bytes; },
        [&](std::size_t first, std::size_t end, char* to) {
            for (std::size_t row = first; row < end; ++row, to += row_bytes) fill_row(to, row);
        });
}

} // namespace bake
