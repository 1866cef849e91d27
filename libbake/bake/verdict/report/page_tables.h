// The parts of the page that need no script: tables, bars and commands as HTML, from the JSON of the comparison. What is
// missing there is left out.
#pragma once
#include "bake/base/shell_word.h"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace bake {

/// The number at a path such as "object/flip/mean", or `otherwise`.
double number_or(const nlohmann::ordered_json& json, const std::string& path, double otherwise);
int integer_or(const nlohmann::ordered_json& json, const std::string& path, int otherwise);
std::string text_or(const nlohmann::ordered_json& json, const std::string& path, const std::string& otherwise);

/// One item of a list of facts; nothing for an empty text.
std::string page_fact(const char* name, const std::string& value);
struct PageCommand {
    std::string label;   ///< HTML
    std::string method;  ///< the picture that a click on it shows; empty: none
    std::string command; ///< text; empty: it is left out
};
std::string command_list(const std::vector<PageCommand>& commands);
std::string page_title(const nlohmann::ordered_json& report);
std::string heading(const nlohmann::ordered_json& report);
/// A definition list of what is the same for all methods.
std::string facts(const nlohmann::ordered_json& report);
/// Below the picture number `index`.
std::string caption(const nlohmann::ordered_json& report, const std::string& method, std::size_t index);
/// A table over the object with the costs, and one over the frame. The best value of each column is marked. Without values
/// over the object it is one table.
std::string error_tables(const nlohmann::ordered_json& report);
/// Stacked bars of the shares by cause. Shares below 0 lie on the left of 0.
std::string share_bars(const nlohmann::ordered_json& report);
/// The command of the whole report and of each method.
std::string commands(const nlohmann::ordered_json& report);

} // namespace bake
