// What bake check reads of the text formats: no more than the record, the materials and the names of pictures.
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/text.h"
#include "bake/mesh/asset/asset.h"
#include <set>
#include <string_view>

namespace bake {
namespace {

/// Calls found(what stands between `before` and `after`) for each place in the text.
template <class Found>
void for_each_between(std::string_view text, std::string_view before, char after, const Found& found) {
    for (std::size_t at = 0; (at = text.find(before, at)) != std::string_view::npos;) {
        at += before.size();
        const std::size_t end = text.find(after, at);
        if (end == std::string_view::npos) return;
        found(text.substr(at, end - at));
        at = end + 1;
    }
}

/// The text between quotation marks that `text` begins with, without the first one. Of escapes those that quoted() writes.
std::string unquoted(std::string_view text) {
    std::string out;
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    for (std::size_t i = 0; i < text.size() && text[i] != '"'; ++i) {
        if (text[i] != '\\' || i + 1 == text.size()) out += text[i];
        else if (text[++i] == 'x' && i + 2 < text.size()) {
            out += char(16 * digit(text[i + 1]) + digit(text[i + 2]));
            i += 2;
        } else out += text[i];
    }
    return out;
}

std::size_t count_of(std::string_view text, std::string_view what) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string_view::npos; at += what.size()) ++count;
    return count;
}

std::string unescaped(std::string_view text) {
    std::string out(text);
    for (const auto& [code, c] : {std::pair("&quot;", "\""), {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
        for (std::size_t at = 0; (at = out.find(code, at)) != std::string::npos; ++at)
            out.replace(at, std::string_view(code).size(), c);
    return out;
}

} // namespace

std::optional<AssetText> asset_text(const std::string& path) {
    const std::string end = ending(path);
    if (end == ".usda") return AssetText::usda;
    if (end == ".mtlx") return AssetText::mtlx;
    return {};
}

TextAssetContent read_text_asset(const std::string& path) {
    const bool usda = asset_text(path) == AssetText::usda;
    const FileBytes file = read_file(path);
    const std::string_view text(file.begin(), file.size);
    if (usda ? !text.starts_with("#usda ") : text.find("<materialx ") == std::string_view::npos)
        throw Error(Refusal::unreadable, path + ": does not begin as a " +
                                             (usda ? "USD layer in text" : "MaterialX document") +
                                             " does; export it again");
    TextAssetContent out;
    std::set<std::string> pictures;
    const std::string record = std::string(usda ? "string bake = \"" : "<!-- bake ");
    if (const std::size_t at = text.find(record); at != std::string_view::npos) {
        const std::string_view rest = text.substr(at + record.size());
        out.record = valid_record(usda ? unquoted(rest) : std::string(rest.substr(0, rest.find(" -->"))));
    }
    if (usda) {
        for_each_between(text, "asset inputs:file = @", '@', [&](std::string_view name) {
            pictures.insert(std::string(name.starts_with("./") ? name.substr(2) : name));
        });
    } else {
        for_each_between(text, "type=\"filename\" value=\"", '"',
                         [&](std::string_view name) { pictures.insert(unescaped(name)); });
    }
    out.pictures.assign(pictures.begin(), pictures.end());
    out.materials = count_of(text, usda ? "def Material \"" : "<surfacematerial ");
    return out;
}

} // namespace bake
