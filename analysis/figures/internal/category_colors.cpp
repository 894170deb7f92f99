#include "analysis/figures/internal/category_colors.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <set>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/svg.h"

namespace swarmsmith {
namespace {

bool is_number(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool before(const std::string& a, const std::string& b) {
  double x = 0;
  double y = 0;
  if (is_number(a, x) && is_number(b, y)) return x < y;
  return a < b;
}

/// Sets of which no two share a value.
std::vector<std::set<std::string>> value_sets(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::set<std::string>> result;
  for (const auto& list : lists) {
    std::set<std::string> merged(list.begin(), list.end());
    std::erase_if(result, [&](const std::set<std::string>& family) {
      const bool shares = std::ranges::any_of(
          list, [&](const std::string& value) { return family.contains(value); });
      if (shares) merged.insert(family.begin(), family.end());
      return shares;
    });
    if (!merged.empty()) result.push_back(std::move(merged));
  }
  return result;
}

}  // namespace

CategoryColors::CategoryColors(const std::vector<std::vector<std::string>>& lists) {
  for (const auto& set : value_sets(lists)) {
    std::vector<std::string> values(set.begin(), set.end());
    std::ranges::sort(values, before);
    double number = 0;
    const bool are_numbers = std::ranges::all_of(
        values, [&](const std::string& value) { return is_number(value, number); });
    const auto last = static_cast<double>(std::max<std::size_t>(2, values.size()) - 1);
    Family& family = families_.emplace_back();
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::string color =
          are_numbers ? sequential_color(static_cast<double>(i) / last) : distinct_color(i);
      // Beyond the distinct colours they begin again, paler.
      if (!are_numbers && i >= kDistinctColors) color = lightened(color, 0.55);
      family.emplace_back(values[i], std::move(color));
    }
  }
}

std::string CategoryColors::color(const std::string& value) const {
  for (const Family& family : families_) {
    const auto found = std::ranges::find(family, value, &Family::value_type::first);
    if (found != family.end()) return found->second;
  }
  return "#bbbbbb";
}

bool CategoryColors::belongs(const std::vector<std::string>& list, const Family& family) {
  return !list.empty() &&
         std::ranges::find(family, list.front(), &Family::value_type::first) != family.end();
}

}  // namespace swarmsmith
