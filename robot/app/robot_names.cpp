#include "robot/app/robot_names.h"

#include <algorithm>

#include "base/plain_text.h"
#include "base/text/csv.h"
#include "robot/runtime/order.h"

namespace swarmsmith {
namespace {

constexpr const char* kStem = "rvr";
constexpr std::int64_t kMostRobots = 1000;

bool is_number(std::string_view word) {
  return !word.empty() && word.size() < 10 &&
         word.find_first_not_of("0123456789") == std::string_view::npos;
}

std::int64_t number_of(std::string_view word) {
  return integer_in(word).value_or(0);
}

}  // namespace

Expected<std::string> robot_name(const std::string& word) {
  if (is_number(word)) {
    if (number_of(word) < 1) return bad_input("robots are numbered from 1", "--robot");
    return kStem + std::to_string(number_of(word));
  }
  if (!is_plain_name(word) || (word[0] >= '0' && word[0] <= '9') || word[0] == '-')
    return bad_input(
        "`" + word + "` is not a valid robot name (a letter, then letters, digits or _)",
        "--robot");
  return word;
}

std::optional<int> index_in_name(const std::string& name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const std::string_view number = std::string_view(name).substr(digits);
  if (!is_number(number) || number_of(number) < 1 || number_of(number) - 1 > kMostIndex)
    return std::nullopt;
  return static_cast<int>(number_of(number) - 1);
}

Expected<std::vector<std::string>> robot_names(const std::string& words) {
  std::vector<std::string> names;
  for (const std::string_view part : split(words, ',')) {
    const std::string word(part);
    const std::size_t dash = word.find('-');
    if (dash != std::string::npos && is_number(word.substr(0, dash)) &&
        is_number(word.substr(dash + 1))) {
      const std::int64_t first = number_of(word.substr(0, dash));
      const std::int64_t last = number_of(word.substr(dash + 1));
      if (first < 1 || last < first || last - first >= kMostRobots)
        return bad_input("`" + word + "` is not a range of robots, such as 1-3", "--robots");
      for (std::int64_t i = first; i <= last; ++i)
        names.push_back(kStem + std::to_string(i));
      continue;
    }
    auto name = robot_name(word);
    if (!name) return bad_input(name.error().message, "--robots");
    names.push_back(std::move(*name));
  }
  std::vector<std::string> sorted = names;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    return bad_input("the robot " + *twice + " is named twice", "--robots");
  return names;
}

}  // namespace swarmsmith
