// The sweeps of each theme, as the files <theme>_sweeps.cpp define them.
#pragma once
#include "stability/sweep.h"

namespace stability {

std::vector<Sweep> curvature_sweeps();

} // namespace stability
