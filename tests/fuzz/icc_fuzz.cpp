// ICC profiles.
#include "bake/picture/icc.h"
#include "fuzz/fuzz.h"
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    return fuzz::attempt([&] {
        const ColourTag tag = read_icc(std::string_view(reinterpret_cast<const char*>(data), size));
        volatile float sum = 0;
        for (const ToneCurve& curve : tag.curves)
            for (const float value : {0.0f, 0.25f, 0.5f, 1.0f}) sum = sum + float(curve(value));
        fuzz::require(tag.curves.empty() || tag.curves.size() == 1 || tag.curves.size() == 3, "one curve or three");
    });
}
