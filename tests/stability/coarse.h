// A sweep with few steps, for tests.
#pragma once
#include "stability/sweep.h"
#include <cmath>
#include <doctest/doctest.h>

namespace stability {

inline std::vector<Row> coarse(const std::string& name, int steps) {
    std::vector<Row> rows = sweep_named(name).rows(steps);
    REQUIRE(!rows.empty());
    for (const Row& row : rows) REQUIRE_MESSAGE(std::isfinite(row.measured), name);
    return rows;
}

} // namespace stability
