#include "bake/preview/relief_entry.h"
#include "bake/relief/height/sample_type.h"

namespace bake {

ReliefOptions relief_options(const ReliefEntry& entry, const ImageInfo& file, double diagonal) {
    ReliefOptions options;
    if (entry.shade) options.method = *entry.shade;
    options.filter = entry.filter;
    options.height.amplitude = entry.amplitude ? (entry.relative ? diagonal : 1) * double(*entry.amplitude)
                                               : default_amplitude(file, diagonal);
    options.height.midlevel = entry.midlevel ? double(*entry.midlevel) : default_midlevel(file);
    options.height.wrap_u = options.height.wrap_v = entry.wrap;
    return options;
}

} // namespace bake
