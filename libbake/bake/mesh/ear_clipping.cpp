#include "bake/mesh/ear_clipping.h"
#include "bake/base/progress.h"

namespace bake {
namespace {

bool is_convex(const EarPolygon& g, std::uint32_t i) noexcept {
    return signed_area(g.points[g.before[i]], g.points[i], g.points[g.after[i]]) > 0;
}

/// Whether the edge from the corner i towards q starts inside the angle of i, which is convex.
bool starts_inside(const EarPolygon& g, std::uint32_t i, const Vec2d& q) noexcept {
    return signed_area(g.points[i], g.points[g.after[i]], q) > 0 &&
           signed_area(g.points[g.before[i]], g.points[i], q) > 0;
}

/// Whether corner i is the tip of a spike of no width or coincides with a neighbour: it can be removed without a change of
/// shape. A corner inside a straight side stays, because a triangle across it would make a T-junction.
bool is_spike(const EarPolygon& g, std::uint32_t i) noexcept {
    const Vec2d a = g.points[g.before[i]], b = g.points[i], c = g.points[g.after[i]];
    return signed_area(a, b, c) == 0 && glm::dot(a - b, c - b) >= 0;
}

// Waiting for a blocker.

void wait(EarPolygon& g, std::uint32_t i, std::uint32_t list) {
    g.candidates.erase(i);
    g.waits_in[i] = list;
    g.previous_waiting[i] = no_index;
    g.next_waiting[i] = g.first_waiting[list];
    if (g.next_waiting[i] != no_index) g.previous_waiting[g.next_waiting[i]] = i;
    g.first_waiting[list] = i;
}

void stop_waiting(EarPolygon& g, std::uint32_t i) {
    if (g.waits_in[i] == no_index) return;
    const std::uint32_t before = g.previous_waiting[i], after = g.next_waiting[i];
    (before == no_index ? g.first_waiting[g.waits_in[i]] : g.next_waiting[before]) = after;
    if (after != no_index) g.previous_waiting[after] = before;
    g.waits_in[i] = no_index;
}

/// The corners of a list become candidates.
void release(EarPolygon& g, std::uint32_t list) {
    for (std::uint32_t i = g.first_waiting[list]; i != no_index; i = g.next_waiting[i]) {
        g.waits_in[i] = no_index;
        g.candidates.insert(i);
    }
    g.first_waiting[list] = no_index;
}

void stop_blocking(EarPolygon& g, std::uint32_t i) {
    if (!g.blocks[i]) return;
    g.blocks[i] = 0;
    g.blockers.remove(i);
    release(g, 2 * i);
    release(g, 2 * i + 1);
}

/// Of many corners on a straight side, half are convex by rounding, and all others lie on the line of their triangles: from
/// this number of blockers on, such triangles are cut without a search.
constexpr std::size_t many_blockers = 256;

/// Whether the polygon stays simple without corner i, which is convex. If it does not, the corner waits.
bool is_ear(EarPolygon& g, std::uint32_t i) {
    const std::uint32_t before = g.before[i], after = g.after[i];
    const Vec2d a = g.points[before], b = g.points[i], c = g.points[after];
    const EarRegion ear(a, b, c);
    if (ear.is_flat() && g.blockers.size() > many_blockers) return true;
    bool coincides = false;
    const std::uint32_t blocker = g.blockers.find(ear, i, g.steps, [&](std::uint32_t k) {
        const Vec2d& p = g.points[k];
        // Where the polygon touches itself, as at the bridge to a hole, two corners coincide.
        if (k == before || k == after || p == a || p == c) return false;
        coincides = p == b;
        g.coinciding += coincides;
        return !coincides || starts_inside(g, i, g.points[g.before[k]]) || starts_inside(g, i, g.points[g.after[k]]);
    });
    if (blocker == no_index) return true;
    wait(g, i, 2 * blocker + (coincides ? 1 : 0));
    return false;
}

/// Connects the neighbours of corner i, whose triangle is written.
void cut(EarPolygon& g, std::uint32_t i, EarTriangle*& out) {
    const std::uint32_t sides[] = {g.before[i], g.after[i]};
    *out++ = {sides[0], i, sides[1]};
    g.gone[i] = 1;
    --g.left;
    stop_waiting(g, i);
    g.candidates.erase(i);
    stop_blocking(g, i);
    g.after[sides[0]] = sides[1];
    g.before[sides[1]] = sides[0];
    for (const std::uint32_t k : sides) {
        g.convex[k] = is_convex(g, k);
        stop_waiting(g, k);
        if (g.convex[k]) {
            stop_blocking(g, k);
            g.candidates.insert(k);
        } else {
            g.candidates.erase(k);
            release(g, 2 * k + 1); // a side of k has moved
        }
    }
}

/// Spikes are removed immediately: the interior of the polygon is undefined between their sides.
void cut_spikes(EarPolygon& g, EarTriangle*& out) {
    while (!g.suspects.empty()) {
        const std::uint32_t i = g.suspects.back();
        g.suspects.pop_back();
        if (g.left <= 3 || g.gone[i] || !is_spike(g, i)) continue;
        g.suspects.insert(g.suspects.end(), {g.before[i], g.after[i]});
        cut(g, i, out);
    }
}

void start(EarPolygon& g) {
    const auto n = std::uint32_t(g.points.size());
    g.steps = g.coinciding = 0;
    g.left = n;
    g.before.resize(n), g.after.resize(n), g.convex.resize(n), g.blocks.resize(n);
    g.gone.assign(n, 0);
    g.first_waiting.assign(2 * std::size_t(n), no_index);
    g.next_waiting.resize(n), g.previous_waiting.resize(n);
    g.waits_in.assign(n, no_index);
    for (std::uint32_t i = 0; i < n; ++i) {
        g.before[i] = i > 0 ? i - 1 : n - 1;
        g.after[i] = i + 1 < n ? i + 1 : 0;
    }
    g.candidates.reset(n);
    std::vector<std::uint32_t>& blockers = g.suspects; // not in use yet
    blockers.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
        g.convex[i] = is_convex(g, i);
        g.blocks[i] = !g.convex[i];
        if (g.convex[i]) g.candidates.insert(i);
        else blockers.push_back(i);
    }
    g.blockers.reset(g.points, blockers);
    g.suspects.clear();
    for (std::uint32_t i = n; i > 0; --i) g.suspects.push_back(i - 1);
}

/// Many times what polygons without crossings take. At most two of their corners at one place are blockers.
bool takes_too_long(const EarPolygon& g) noexcept {
    const double n = double(g.points.size());
    return double(g.steps) > 10000 + n * (2000 + std::sqrt(n)) || double(g.coinciding) > 10000 + 100 * n;
}

void cut_ears(EarPolygon& g, EarTriangle*& out) {
    std::uint32_t looked_at = 0;
    for (std::uint32_t i = 0; g.left > 3 && !takes_too_long(g);) {
        if (++looked_at % 1024 == 0) throw_if_interrupted();
        while (g.gone[i]) i = g.after[i];
        const std::uint32_t next = g.candidates.next(i);
        i = next == no_index ? g.candidates.next(0) : next;
        if (i == no_index) return;
        if (!is_ear(g, i)) continue;
        g.suspects.insert(g.suspects.end(), {g.before[i], g.after[i]});
        cut(g, i, out);
        cut_spikes(g, out);
        i = g.after[g.after[i]]; // every other corner first: better shaped triangles than those of a fan
    }
}

} // namespace

void clip_ears(EarPolygon& g, EarTriangle* out) {
    start(g);
    cut_spikes(g, out);
    cut_ears(g, out);
    // The last triangle, or a fan.
    std::uint32_t first = 0;
    while (g.gone[first]) ++first;
    for (std::uint32_t k = g.after[first]; g.after[k] != first; k = g.after[k]) *out++ = {first, k, g.after[k]};
}

} // namespace bake
