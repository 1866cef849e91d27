// Words that stand for values of an enum.
#pragma once
#include "bake/base/error.h"
#include <initializer_list>
#include <string>
#include <utility>

namespace bake::python {

/// Throws Error{Refusal::usage}, which lists the words, for another one.
template <class Value>
Value choice(const std::string& name, const std::string& word,
             std::initializer_list<std::pair<const char*, Value>> choices) {
    std::string known;
    for (const auto& [text, value] : choices) {
        if (word == text) return value;
        known += (known.empty() ? "" : ", ") + std::string(text);
    }
    throw Error(Refusal::usage, name + ": " + word + " is none of " + known);
}

} // namespace bake::python
