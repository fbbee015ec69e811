// Converts claims with their verdicts to text, to a table and to JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/claims/judge.hpp"

namespace pelage::claims {

/// Returns the claims as text for a terminal, followed by the number of claims with each verdict. If `all` is
/// false, a line names the experiments without rows in place of the claims about them.
std::string text_of(const std::vector<Judged>& judged, bool all);

/// Returns a table with unrounded numbers, whose first line contains the names of the columns.
std::vector<std::vector<std::string>> table_of(const std::vector<Judged>& judged);

/// Returns a Markdown table for documents. Numbers are rounded as in effect_text().
std::string markdown_of(const std::vector<Judged>& judged);

/// Returns a list of claims with the fields of table_of(), as JSON numbers, and null for absent values.
nlohmann::ordered_json json_of(const std::vector<Judged>& judged);

/// Returns the paper, the section and the reading, for instance "silva2010-wet-fur, section 5, reading
/// paper".
std::string source_of(const Claim& claim);

/// Returns the effect and its interval as text, for instance "0.309 [0.298, 0.321]"; "" without an effect.
std::string effect_text(const Judged& judged);

/// Returns which case decides and the range of all effects: " for torus; 3 effects from 0.2 to 0.8"; "" for a
/// single effect.
std::string effects_text(const Judged& judged);

}  // namespace pelage::claims
