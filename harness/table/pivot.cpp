#include <algorithm>
#include <stdexcept>

#include "harness/table/render.hpp"

namespace pelage {
namespace {

using Keys = std::vector<std::string>;

std::vector<std::size_t> indices(const Table& table, const std::vector<std::string>& names) {
  std::vector<std::size_t> result;
  for (const std::string& name : names) {
    const int index = column_of(table, name);
    if (index < 0)
      throw std::logic_error("the layout names the column " + name + ", but the table has no such column");
    result.push_back(std::size_t(index));
  }
  return result;
}

Keys keys_of(const std::vector<Value>& line, const std::vector<std::size_t>& columns) {
  Keys keys;
  for (const std::size_t c : columns) keys.push_back(line[c].data);
  return keys;
}

/// Returns the combinations of values of `columns` that occur in the table, sorted by precedes().
std::vector<Keys> combinations(const Table& table, const std::vector<std::size_t>& columns) {
  std::vector<Keys> found;
  for (const auto& line : table.lines)
    if (Keys keys = keys_of(line, columns); std::find(found.begin(), found.end(), keys) == found.end())
      found.push_back(std::move(keys));
  std::stable_sort(found.begin(), found.end(), [&](const Keys& a, const Keys& b) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (a[i] != b[i]) return precedes(table.columns[columns[i]], a[i], b[i]);
    return false;
  });
  return found;
}

std::vector<std::string> labels(const Table& table, const std::vector<std::size_t>& columns,
                                const Keys& keys) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < columns.size(); ++i)
    result.push_back(with_value(table.columns[columns[i]], keys[i]));
  return result;
}

}  // namespace

Pivot pivot_of(const Table& table) {
  const auto blocks = indices(table, table.layout.blocks), rows = indices(table, table.layout.rows),
             groups = indices(table, table.layout.groups), values = indices(table, table.layout.values);
  const std::vector<Keys> group_keys = combinations(table, groups), block_keys = combinations(table, blocks);
  Pivot pivot;
  for (const std::size_t c : rows) pivot.keys.push_back(table.columns[c]);
  if (rows.empty()) pivot.keys.emplace_back();  // a column without a heading, for the block's label
  for (const std::size_t c : values) pivot.values.push_back(table.columns[c]);
  for (const Keys& keys : group_keys) pivot.groups.push_back(labels(table, groups, keys));
  for (const Keys& keys : block_keys) pivot.blocks.push_back({labels(table, blocks, keys), {}});
  for (const auto& line : table.lines) {
    const auto index = [](const std::vector<Keys>& all, const Keys& keys) {
      return std::size_t(std::find(all.begin(), all.end(), keys) - all.begin());
    };
    Pivot::Block& block = pivot.blocks[index(block_keys, keys_of(line, blocks))];
    const std::size_t first = index(group_keys, keys_of(line, groups)) * values.size();
    const Keys wanted = keys_of(line, rows);
    const auto fits = [&](const Pivot::Row& row) {
      for (std::size_t i = 0; i < wanted.size(); ++i)
        if (row.keys[i].data != wanted[i]) return false;
      return values.empty() || !row.cells[first];
    };
    auto row = std::find_if(block.rows.begin(), block.rows.end(), fits);
    if (row == block.rows.end()) {
      row = block.rows.insert(
          row, Pivot::Row{{}, std::vector<std::optional<Value>>(group_keys.size() * values.size())});
      for (const std::size_t c : rows) row->keys.push_back(line[c]);
      if (rows.empty()) row->keys.emplace_back();
    }
    for (std::size_t v = 0; v < values.size(); ++v) row->cells[first + v] = line[values[v]];
  }
  return pivot;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

}  // namespace pelage
