#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/paper.h"

namespace tenon {

/// A figure as a table shows it.
/// @param form  see lab_json()
std::string figure_text(double value, const std::string& form);

/// One table in Markdown: what lab_json() keeps of it, with the verdicts on its claims, and why where the paper's file
/// says so.
std::string table_markdown(const Paper& paper, const nlohmann::ordered_json& table);

/// The page of a paper, in Markdown.
std::string page_markdown(const Paper& paper, const std::vector<nlohmann::ordered_json>& tables);

/// The page that leads to the others: each paper with how many of its claims hold.
std::string index_markdown(const std::vector<Paper>& papers, const std::vector<nlohmann::ordered_json>& tables);

}  // namespace tenon
