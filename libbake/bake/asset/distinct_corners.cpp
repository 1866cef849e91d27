#include "bake/asset/distinct_corners.h"
#include <algorithm>
#include <utility>

namespace bake {

DistinctCorners distinct_corners(const std::vector<std::uint32_t>& position, std::size_t positions,
                                 const std::vector<std::uint64_t>& key) {
    const std::size_t corners = position.size();
    // A counting sort puts the corners of each position side by side.
    std::vector<std::uint32_t> begin(positions + 1), order(corners);
    for (const std::uint32_t p : position) ++begin[p];
    std::uint32_t sum = 0;
    for (std::uint32_t& b : begin) b = std::exchange(sum, sum + b);
    for (std::size_t c = 0; c < corners; ++c) order[begin[position[c]]++] = static_cast<std::uint32_t>(c);

    DistinctCorners out;
    out.corner.resize(corners);
    for (std::size_t p = 0, from = 0; p < positions; ++p) {
        const std::size_t to = begin[p]; // the sort has moved it to the end of the position's corners
        const auto first = order.begin() + static_cast<std::ptrdiff_t>(from),
                   last = order.begin() + static_cast<std::ptrdiff_t>(to);
        if (!key.empty())
            std::sort(first, last,
                      [&key](std::uint32_t a, std::uint32_t b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
        // The first corner of each key numbers itself; numbers then follow first appearance.
        const std::size_t numbered = out.first.size();
        for (auto c = first; c != last; ++c)
            if (c == first || (!key.empty() && key[*c] != key[*(c - 1)])) out.first.push_back(*c);
        std::sort(out.first.begin() + static_cast<std::ptrdiff_t>(numbered), out.first.end());
        std::uint32_t leader = 0, number = 0;
        for (auto c = first; c != last; ++c) {
            if (c == first || (!key.empty() && key[*c] != key[leader])) {
                leader = *c;
                number = static_cast<std::uint32_t>(
                    std::lower_bound(out.first.begin() + static_cast<std::ptrdiff_t>(numbered), out.first.end(),
                                     leader) -
                    out.first.begin());
            }
            out.corner[*c] = number;
        }
        from = to;
    }
    return out;
}

} // namespace bake
