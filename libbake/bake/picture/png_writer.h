// Writes PNG in blocks of rows that are filtered and compressed in parallel.
#pragma once
#include "bake/base/output_file.h"
#include "bake/picture/image_types.h"
#include <cstdio>
#include <string>
#include <vector>

namespace bake {

/// Writes rows from the top down. The bytes do not depend on the numbers of threads and of calls.
class PngWriter {
public:
    /// Writes to `file`, which is empty; messages name `path`. The depth is u8 or u16. All
    /// functions throw Error{Refusal::unwritable}; this one Error{Refusal::usage} for mips or more than 4 channels.
    PngWriter(const std::string& path, const OutputFile& file, const PictureSize& size, const WriteOptions& options);
    ~PngWriter();
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    /// `rows` rows of integer levels.
    void write(const void* levels, int rows);
    void finish();

private:
    struct Block;
    void compress_rows();
    Block compress(std::size_t begin, std::size_t end) const;
    void put(const void* bytes, std::size_t size);
    void put_chunk(const char* type, const std::vector<unsigned char>& data);
    [[noreturn]] void fail() const;

    std::string path_;
    std::FILE* file_;
    int sample_bytes_, texel_bytes_;
    std::size_t row_bytes_, block_rows_, most_rows_; ///< most_rows_: largest waiting_
    /// The last compressed row, then the rows that wait to be compressed; the high byte of a sample comes first.
    std::vector<unsigned char> rows_;
    std::size_t waiting_ = 0;
    /// `history_` bytes of compressed rows (at most 32 KiB), then filtered rows, each after the number of its filter.
    std::vector<unsigned char> filtered_;
    std::size_t history_ = 0;
    unsigned long checksum_ = 1; ///< Adler-32 of all filtered rows
    bool begun_ = false;         ///< the two bytes of the stream's header are written
};

} // namespace bake
