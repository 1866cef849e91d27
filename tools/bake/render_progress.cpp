#include "render_progress.h"
#include "bake/base/job.h"
#include "bake/base/text.h"
#include <algorithm>
#include <chrono>

namespace bake {

bool is_visible(const CommonArgs& common) noexcept { return !common.quiet && !common.json; }

std::function<std::string()> progress_text(const Passes& passes, const SamplingArgs& args) {
    const auto start = std::chrono::steady_clock::now();
    return [&passes, &args, start] {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const double spp = double(passes.samples_done()) / double(passes.pixel_count());
        const double rate = seconds > 0 ? double(passes.rays_done()) / seconds : 0;
        std::string line = format("%.4g of %s%d spp, %.2f M rays/s", spp,
                                  args.noise || args.time_limit ? "at most " : "", passes.spp(), rate * 1e-6);
        double share = args.noise ? 0 : spp / passes.spp();
        double left = share > 0 ? seconds / share - seconds : -1;
        if (args.time_limit) {
            const double by_time = std::max(0.0, *args.time_limit - seconds);
            left = left < 0 ? by_time : std::min(left, by_time);
            share = std::max(share, std::min(1.0, seconds / *args.time_limit));
        }
        if (share > 0) line = format("%.0f %%, ", 100 * share) + line;
        if (left >= 0) line += (args.noise ? ", at most " : ", ") + format("%.0f s left", left);
        return "render " + line;
    };
}

void tell_progress(const Passes& passes) {
    if (const Job& job = current_job(); job.watch)
        job.watch("render", passes.samples_done(), passes.pixel_count() * passes.spp());
}

} // namespace bake
