#include "irace_core/search/search_parts.h"

#include <algorithm>
#include <utility>

#include "base/plain_text.h"

namespace swarmsmith {
namespace stage {

std::string of(std::int64_t whole) {
  return whole > 0 ? " of " + std::to_string(whole) : "";
}

std::string range(std::string_view what, std::int64_t first, std::int64_t last) {
  const std::string begin = std::to_string(first);
  if (last < first) return std::string(what) + "s from " + begin + " on";
  return std::string(what) + "s " + begin + " to " + std::to_string(last);
}

std::int64_t ready(const SearchPoint& point) {
  if (point.runs_wanted == 0) return 0;
  return std::min(point.configurations, point.runs * point.configurations / point.runs_wanted);
}

std::string members(const SearchWords& words, const SearchPoint& point) {
  if (point.configurations == 0) return "";
  return std::to_string(ready(point)) + " of " + counted(point.configurations, words.candidate);
}

std::string each(const SearchPoint& point) {
  return counted(point.runs_wanted / std::max<std::int64_t>(1, point.configurations), "run") +
         " each";
}

}  // namespace stage

StageTexts usual_texts(const SearchWords& words, const SearchPoint& point, std::string name) {
  const std::string all = counted(point.configurations, words.candidate);
  if (words.has_tests) {
    return {.name = name,
            .line = name + ": " + all + ", budget " + std::to_string(point.runs_wanted),
            .stage = name + stage::of(point.iterations)};
  }
  const std::string members = ": " + all + ", " + stage::each(point);
  const std::string there = stage::members(words, point);
  if (point.is_final) {
    return {
        .name = name, .line = name + members, .stage = name + (there.empty() ? "" : ": " + there)};
  }
  // Final stages are not counted.
  const std::int64_t planned = point.iterations > 0 ? point.iterations - point.finals - 1 : 0;
  return {.name = name,
          .line = name + stage::of(planned) + members,
          .stage = name + stage::of(planned) + (stage::ready(point) > 0 ? ", " + there : "")};
}

}  // namespace swarmsmith
