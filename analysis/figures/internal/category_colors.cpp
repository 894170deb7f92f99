#include "analysis/figures/internal/category_colors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

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

/// A value that names a colour is drawn in that colour.
std::optional<std::string> natural_color(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kNatural = {
      {{"black_floor", "#000000"},
       {"gray_floor", "#969696"},
       {"white_floor", "#eeeeee"},
       {"green", "#009e73"},
       {"blue", "#0072b2"},
       {"red", "#d55e00"},
       {"yellow", "#f0e442"}}};
  for (const auto& [name, color] : kNatural)
    if (word == name) return std::string(color);
  return std::nullopt;
}

/// Okabe and Ito's colours, alternately pale and dark, so that parts stacked in this order have
/// visible borders in a black-and-white print, too.
std::string stacked_color(std::size_t number) {
  constexpr std::array<std::pair<std::string_view, double>, 6> kColors = {{{"#e69f00", 0.35},
                                                                           {"#0072b2", 0},
                                                                           {"#56b4e9", 0.5},
                                                                           {"#009e73", 0},
                                                                           {"#cc79a7", 0.45},
                                                                           {"#d55e00", 0}}};
  const auto& [color, paleness] = kColors[number % kColors.size()];
  std::string result = lightened(std::string(color), paleness);
  // Beyond the last colour they repeat, paler.
  return number < kColors.size() ? result : lightened(result, 0.55);
}

/// Merges the lists into sets so that no two sets share a value.
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
    std::size_t words = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (are_numbers) {
        family.emplace_back(values[i], sequential_color(static_cast<double>(i) / last));
        continue;
      }
      const auto natural = natural_color(values[i]);
      family.emplace_back(values[i], natural ? *natural : stacked_color(words++));
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
