// The sweeps of each theme, as the files <theme>_sweeps.cpp define them.
#pragma once
#include "stability/sweep.h"

namespace stability {

std::vector<Sweep> curvature_sweeps();
std::vector<Sweep> slope_sweeps();
std::vector<Sweep> chart_sweeps();
std::vector<Sweep> relief_sweeps();
std::vector<Sweep> warning_sweeps();
std::vector<Sweep> tilt_sweeps();
std::vector<Sweep> shadow_sweeps();
std::vector<Sweep> minification_sweeps();
std::vector<Sweep> sky_sweeps();
std::vector<Sweep> distance_sweeps();
std::vector<Sweep> precision_sweeps();
std::vector<Sweep> thread_sweeps();

} // namespace stability
