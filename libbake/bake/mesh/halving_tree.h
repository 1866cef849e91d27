// The shape of a balanced search tree over items in an order of their own.
//
// Bentley, Multidimensional binary search trees used for associative searching, Communications of the ACM 18 (1975).
#pragma once
#include "bake/base/progress.h"
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

/// Node 1 has all items; the children of node n are 2 n and 2 n + 1 and have a half of its items each. All leaves are at
/// the same depth.
class HalvingTree {
public:
    explicit HalvingTree(std::size_t items = 0, std::size_t most_in_leaf = 8) : items_(items) {
        while (items >> depth_ > most_in_leaf) ++depth_;
    }
    /// Numbers of nodes are below this; 0 is none.
    std::size_t nodes() const noexcept { return std::size_t(2) << depth_; }
    bool is_leaf(std::size_t node) const noexcept { return node >= nodes() / 2; }
    /// The places of the first item of a node, and of the one behind its last.
    std::size_t begin_of(std::size_t node) const noexcept { return place(node, 0); }
    std::size_t end_of(std::size_t node) const noexcept { return place(node, 1); }

    /// Puts the items in order. box(node, items) is called once for each node, each one before its children, and returns
    /// the axis along which its items are halved: by key(item, axis). Throws Error{Refusal::interrupted} on Ctrl-C.
    template <class Item, class Box, class Key>
    void build(std::vector<Item>& items, const Box& box, const Key& key) const {
        for (std::size_t n = 1; n < nodes(); ++n) {
            const std::span<Item> own(items.data() + begin_of(n), items.data() + end_of(n));
            const int axis = box(n, std::span<const Item>(own));
            if (own.size() > 65536) throw_if_interrupted();
            if (is_leaf(n)) continue;
            const auto middle = own.begin() + std::ptrdiff_t(end_of(2 * n) - begin_of(n));
            std::nth_element(own.begin(), middle, own.end(),
                             [&](const Item& a, const Item& b) { return key(a, axis) < key(b, axis); });
        }
    }

private:
    std::size_t place(std::size_t node, std::size_t more) const noexcept {
        const int depth = std::bit_width(node) - 1;
        return items_ * (node - (std::size_t(1) << depth) + more) >> depth;
    }

    std::size_t items_;
    int depth_ = 0; ///< of the leaves
};

} // namespace bake
