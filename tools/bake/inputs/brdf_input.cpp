#include "inputs/brdf_input.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/preview/nearest_key.h"
#include "inputs/number_option.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace bake {
namespace {

struct Key {
    const char* name;
    double value; ///< unless given
    double least, most;
};

struct Model {
    const char* name;
    std::vector<Key> keys;
    const char* meaning;
};

const Key exponent{"n", 32, 0, 1e6}, specular{"specular", 1, -10, 10}, roughness{"roughness", 0.5, 0, 1};

const std::vector<Model>& models() {
    static const std::vector<Model> all = {
        {"lambert", {{"albedo", 0.8, -10, 10}}, "f = albedo / pi"},
        {"phong", {exponent, specular}, "f cos = specular (r.v)^n / pi"},
        {"blinn", {exponent, specular}, "f cos = specular (n.h)^n / pi"},
        {"normalised-phong", {exponent, specular}, "with the cosine and the factor that conserves energy"},
        {"normalised-blinn", {exponent, specular}, "the same with (n.h)^n"},
        {"ggx",
         {roughness, {"f0", 0.04, 0, 1}},
         "microfacets of alpha = roughness^2, with their light of several bounces"},
        {"covered-lambert", {{"albedo", 0.8, 0, 1}}, "lambert under the ggx of the sum"},
        {"metallic-roughness", {{"base", 0.8, 0, 1}, {"metallic", 0, 0, 1}, roughness}, "the material of glTF"}};
    return all;
}

template <class Items> std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    for (const auto& item : items) names.emplace_back(item.name);
    return names;
}

std::string listed(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
}

std::string unknown(const std::string& word, const std::string& what, const std::vector<std::string>& names) {
    if (word.empty()) return what + " is missing (" + listed(names) + ")";
    const std::string meant = nearest_key(word, names);
    return word + " is not " + what + (meant.empty() ? "" : "; did you mean " + meant + "?") + " (" + listed(names) +
           ")";
}

/// The terms of a sum. A plus before a number, as in 1e+3, is no sum.
std::vector<std::string> terms_of(const std::string& text) {
    std::vector<std::string> out(1);
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '+' &&
            (i + 1 == text.size() || std::string("0123456789.").find(text[i + 1]) == std::string::npos))
            out.emplace_back();
        else out.back() += text[i];
    return out;
}

/// The values of a model's keys, in the order of its keys.
std::vector<double> read_values(const std::string& flag, const Model& model, const std::string& text) {
    std::vector<double> values;
    std::vector<bool> given(model.keys.size());
    for (const Key& key : model.keys) values.push_back(key.value);
    std::istringstream entries(text);
    for (std::string entry; std::getline(entries, entry, ',');) {
        const std::size_t equals = entry.find('=');
        const std::string name = entry.substr(0, equals);
        const auto key =
            std::find_if(model.keys.begin(), model.keys.end(), [&](const Key& k) { return k.name == name; });
        if (key == model.keys.end())
            throw Error(Refusal::usage,
                        flag + ": " + unknown(name, std::string("a key of ") + model.name, names_of(model.keys)));
        const auto index = std::size_t(key - model.keys.begin());
        if (given[index]) throw Error(Refusal::usage, flag + ": " + name + " is given twice; remove one");
        given[index] = true;
        values[index] = number_of(flag + " " + model.name + ":" + name,
                                  equals == std::string::npos ? "" : entry.substr(equals + 1), key->least, key->most);
    }
    return values;
}

/// The lobes of the model at `index` of models().
Bsdf lobes_of(std::size_t index, const std::vector<double>& values) {
    constexpr LobeKind kinds[] = {
        LobeKind::lambert,          LobeKind::phong, LobeKind::blinn,  LobeKind::normalised_phong,
        LobeKind::normalised_blinn, LobeKind::ggx,   LobeKind::lambert};
    if (index == std::size(kinds))
        return metallic_roughness(Vec3f(float(values[0])), float(values[1]), float(values[2]));
    Bsdf out;
    out.count = 1;
    Lobe& lobe = out.lobes[0];
    lobe.kind = kinds[index];
    lobe.weight = Vec3f(float(values.back()));
    if (lobe.kind == LobeKind::ggx) lobe.roughness = float(values[0]);
    else lobe.exponent = float(values[0]);
    lobe.covered = index + 1 == std::size(kinds);
    return out;
}

} // namespace

std::string brdf_models() {
    std::string out;
    for (const Model& model : models()) {
        std::string spelled = model.name;
        char mark = ':';
        for (const Key& key : model.keys) {
            spelled += mark + format("%s=%g", key.name, key.value);
            mark = ',';
        }
        out += format("  %-52s %s\n", spelled.c_str(), model.meaning);
    }
    return out;
}

Bsdf parse_brdf(const std::string& flag, const std::string& text) {
    Bsdf out;
    for (const std::string& term : terms_of(text)) {
        const std::size_t colon = term.find(':');
        const std::string name = term.substr(0, colon);
        const auto names = names_of(models());
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) throw Error(Refusal::usage, flag + ": " + unknown(name, "a model", names));
        const auto index = std::size_t(found - names.begin());
        const Model& model = models()[index];
        std::vector<double> values;
        if (colon == std::string::npos)
            for (const Key& key : model.keys) values.push_back(key.value);
        else values = read_values(flag, model, term.substr(colon + 1));
        const Bsdf added = lobes_of(index, values);
        if (out.count + added.count > Bsdf::most_lobes)
            throw Error(Refusal::usage, flag + ": a sum of more than " + std::to_string(Bsdf::most_lobes) + " lobes");
        for (int i = 0; i < added.count; ++i) out.lobes[std::size_t(out.count++)] = added.lobes[std::size_t(i)];
    }
    return out;
}

} // namespace bake
