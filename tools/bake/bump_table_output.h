// The files and reports of the verb bump-table.
#pragma once
#include "bake/relief/map/bake_budget.h"
#include "options.h"
#include "verb.h"
#include <optional>

namespace bake {

struct BumpTableArgs {
    HeightArgs height;
    std::string out, amplitude = "1", extent;
    BumpTableOptions options;
    std::optional<SlopeUnits> units;
    TableLayout layout = TableLayout::slopes;
    Depth depth = Depth::automatic;
    Compression compression = Compression::automatic;
};

/// Writes the slopes, or with layout `bumpslopes` the six moments and their mips, to args.out. `code`: of 16-bit files.
void write_table(const BumpTableArgs& args, const BumpTable& table, Depth depth, const std::optional<SlopeCode>& code,
                 Progress& progress);

/// What the verb prints of a table that was written.
struct BumpTableReport {
    const HeightTexture& height;
    const BumpTable& table;
    std::optional<SlopeCode> code;
    ErrorBudget budget;
    std::optional<FilterAdvice> advice;
    double tilt_deg = 0;            ///< of the normal, by one level of the height
    Vec2d extent{1};                ///< object units
    std::vector<std::string> notes; ///< doubts about the height
};
void print(const BumpTableArgs& args, const BumpTableReport& report, const Stopwatch& watch, bool json);

} // namespace bake
