// Converts claims with their verdicts to text, to a table and to JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/claims/judge.hpp"

namespace pelage::claims {

/// Returns all claims as text for a terminal. The last line contains the number of claims with each verdict.
std::string text_of(const std::vector<Judged>& judged);

/// Returns text_of() without the claims about experiments that have no rows. Instead of these claims, the
/// line before the counts contains their number and the names of their experiments.
std::string short_text_of(const std::vector<Judged>& judged);

/// Returns a table whose first line contains the names of the columns. Numbers are unrounded. `pelage claims`
/// and `pelage report` write this table as CSV.
std::vector<std::vector<std::string>> table_of(const std::vector<Judged>& judged);

/// Returns a Markdown table for documents. Numbers have three significant digits. Numbers between 0.98 and
/// 1.02, except 1 itself, have four decimals. Numbers of at least 100 are rounded to whole numbers.
std::string markdown_of(const std::vector<Judged>& judged);

/// Returns a list of claims with the fields of table_of(); numbers are JSON numbers, and values that are
/// absent are null.
nlohmann::ordered_json json_of(const std::vector<Judged>& judged);

/// Returns the effect and its interval as text, for instance "0.309 [0.298, 0.321]". Returns "" if the effect
/// was not computed.
std::string effect_text(const Judged& judged);

}  // namespace pelage::claims
