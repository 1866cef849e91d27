// Encodings and line ends of text files.
#pragma once
#include "bake/base/file_bytes.h"

namespace bake {

/// Converts UTF-16 and UTF-32, of either byte order, with a byte order mark or without, to UTF-8, and removes the mark of
/// UTF-8. Without a mark the encoding is found from the first characters, which must be ASCII. Other bytes stay as they
/// are. Surrogates without their other half become U+FFFD.
void decode_text(FileBytes& file);

/// Replaces each carriage return that no newline follows, the line end of old Macintosh files, by a newline.
void end_lines_by_newline(FileBytes& file);

} // namespace bake
