// The line that bake render shows on a terminal.
#pragma once
#include "bake/preview/passes.h"
#include "sampling_options.h"

namespace bake {

/// Whether the command may show progress.
bool is_visible(const CommonArgs& common) noexcept;
/// "render 37 %, 4 of 16 spp, 2.13 M rays/s, 12 s left", told anew by each call. With --noise the time that is left is
/// not known.
std::function<std::string()> progress_text(const Passes& passes, const SamplingArgs& args);

/// Tells Job::watch of the samples so far and in all; with --noise or --time-limit all are at most that many.
void tell_progress(const Passes& passes);

} // namespace bake
