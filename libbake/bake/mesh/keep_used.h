// Removal of values that no index refers to.
#pragma once
#include "bake/mesh/mesh.h"
#include <utility>

namespace bake {

/// Keeps the values that `index` refers to, in the order of their first use, and renumbers the indices. no_index stays.
template <class T> void keep_used(std::vector<T>& values, std::vector<std::uint32_t>& index) {
    std::vector<std::uint32_t> number(values.size(), no_index);
    std::vector<T> out;
    for (std::uint32_t& i : index) {
        if (i == no_index) continue;
        if (number[i] == no_index) {
            number[i] = std::uint32_t(out.size());
            out.push_back(values[i]);
        }
        i = number[i];
    }
    values = std::move(out);
}

} // namespace bake
