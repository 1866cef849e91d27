#include "bake/preview/relief_entry.h"
#include "bake/relief/height/sample_type.h"

namespace bake {

ReliefOptions relief_options(const ReliefEntry& entry, const ImageInfo& file, double diagonal) {
    const bool lengths = is_float(file);
    ReliefOptions options;
    if (entry.shade) options.method = *entry.shade;
    options.filter = entry.filter;
    const double whole = entry.relative || (!entry.amplitude && !lengths) ? diagonal : 1;
    options.height.amplitude = whole * double(entry.amplitude.value_or(lengths ? 1.0f : 0.01f));
    options.height.midlevel = entry.midlevel ? double(*entry.midlevel) : default_midlevel(file);
    options.height.wrap_u = options.height.wrap_v = entry.wrap;
    return options;
}

} // namespace bake
