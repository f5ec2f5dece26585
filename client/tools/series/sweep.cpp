#include "client/tools/series/sweep.h"

#include <algorithm>
#include <charconv>
#include <set>

namespace metamer::client {
namespace {

std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

/// Whether the row has all the values that the words name, "method=exact".
bool has_values(const std::vector<SweepAxis>& axes, const SweepRow& row,
                const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      if (word == axes[axis].name + "=" + row.values[axis]) return true;
    return false;
  });
}

}  // namespace

Result<SweepAxis> parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    return problem(quoted(text) + " is not NAME=VALUE,VALUE…, such as method=exact,rgb");
  SweepAxis axis{.name = text.substr(0, equals), .values = {}};
  while (axis.name.starts_with('-')) axis.name.erase(0, 1);
  const std::string values = text.substr(equals + 1);
  axis.values = split_at(values, values.find(';') == std::string::npos ? ',' : ';');
  std::set<std::string> seen;
  for (const std::string& value : axis.values) {
    if (value.empty()) return problem(quoted(text) + " has an empty value");
    if (!seen.insert(value).second)
      return problem(quoted(text) + " has the value " + quoted(value) + " twice");
  }
  return axis;
}

Result<std::vector<SweepRow>> sweep_rows(const std::vector<SweepAxis>& axes) {
  std::size_t count = 1;
  for (const SweepAxis& axis : axes) {
    if (axis.values.size() > max_rows / count)
      return problem("these are more than " + std::to_string(max_rows) + " combinations");
    count *= axis.values.size();
  }
  std::vector<SweepRow> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t rest = i, block = count;
    for (const SweepAxis& axis : axes) {
      block /= axis.values.size();
      rows[i].values.push_back(axis.values[rest / block]);
      rest %= block;
      rows[i].label += (rows[i].label.empty() ? "" : " ") + axis.name + "=" + rows[i].values.back();
    }
  }
  return rows;
}

Result<std::size_t> find_row(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows,
                             const std::string& word) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc() && end == word.data() + word.size()) {
    if (1 <= number && number <= rows.size()) return number - 1;
    return problem("there is no row " + std::to_string(number) + " of " +
                   std::to_string(rows.size()));
  }
  std::vector<std::size_t> found;
  const std::vector<std::string> words = split_at(word, ' ');
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].label == word || has_values(axes, rows[i], words)) found.push_back(i);
  if (found.size() == 1) return found.front();
  if (found.empty()) return problem("no row has " + quoted(word));
  return problem(std::to_string(found.size()) + " rows have " + quoted(word) +
                 ": name more of the values, as in " + quoted(rows[found.front()].label));
}

}  // namespace metamer::client
