// The files and reports of the verb bump-table.
#pragma once
#include "bake/relief/map/bake_budget.h"
#include "bake/relief/map/slope_loss.h"
#include "options.h"

namespace bake {

struct BumpTableArgs {
    HeightInput height;
    std::string out;
    std::optional<Vec2d> extent;
    BumpTableOptions options;
    std::optional<SlopeUnits> units;
    TableLayout layout = TableLayout::slopes;
    bool no_mips = false;
    Depth depth = Depth::automatic;
    Compression compression = Compression::automatic;
};

/// Writes the slopes, or with layout `bumpslopes` the six moments and, unless no_mips, their mips, to args.out. `code`: of 16-bit files.
void write_table(const BumpTableArgs& args, const BumpTable& table, Depth depth, const std::optional<SlopeCode>& code,
                 Progress& progress);

/// What the verb prints of a table that was written.
struct BumpTableReport {
    const HeightTexture& height;
    const BumpTable& table;
    std::optional<SlopeCode> code;
    ErrorBudget budget;
    std::optional<FilterAdvice> advice;
    double loss = 0;                ///< of the slopes, by the filter: slope_loss()
    double tilt_deg = 0;            ///< of the normal, by one level of the height
    Vec2d extent{1};                ///< object units
    std::vector<std::string> notes; ///< doubts about the height
};
std::string to_text(const BumpTableArgs& args, const BumpTableReport& report);
nlohmann::json to_json(const BumpTableArgs& args, const BumpTableReport& report);

} // namespace bake
