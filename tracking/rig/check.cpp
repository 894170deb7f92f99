#include "tracking/rig/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace swarmsmith {
namespace {

/// A number with its unit: three decimals for small numbers, fewer for large ones.
std::string numbered(double number, std::string_view unit) {
  const double size = std::fabs(number);
  std::string text = fmt::format("{:.{}f}", number, size < 10 ? 3 : size < 100 ? 2 : 1);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  if (text == "-0") text = "0";
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

}  // namespace

Check answered(const Question& question, std::string subject, Check::Outcome outcome,
               std::optional<double> value, std::optional<double> limit) {
  return {.name = std::string(question.name),
          .subject = std::move(subject),
          .outcome = outcome,
          .value = value,
          .limit = limit,
          .unit = std::string(question.unit),
          .catches = std::string(question.catches)};
}

Check not_asked(const Question& question, std::string subject, std::string reason) {
  Check check = answered(question, std::move(subject), Check::Outcome::NotRun);
  check.reason = std::move(reason);
  return check;
}

Check::Outcome outcome_of(std::span<const Issue> issues, std::size_t first,
                          std::optional<IssueCode> code) {
  auto worst = Check::Outcome::Passed;
  for (const Issue& issue : issues.subspan(std::min(first, issues.size()))) {
    if (code && issue.code != *code) continue;
    worst = std::max(worst, is_error(issue.code) ? Check::Outcome::Failed : Check::Outcome::Warned);
  }
  return worst;
}

std::string value_text(const Check& check) {
  return check.value ? numbered(*check.value, check.unit) : "";
}

std::string limit_text(const Check& check) {
  if (!check.limit) return "";
  const std::string text = numbered(*check.limit, check.unit);
  if (!check.value || *check.value == *check.limit) return "limit " + text;
  // A passed check has its value on the good side of the limit, any other check on the bad side;
  // this shows whether the limit is a minimum or a maximum.
  const bool is_over = *check.value > *check.limit;
  const bool is_least =
      check.limit_is_least.value_or(is_over == (check.outcome == Check::Outcome::Passed));
  return (is_least ? "at least " : "at most ") + text;
}

std::vector<std::string> unasked(std::span<const Check> checks) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const Check& check = checks[i];
    if (check.outcome != Check::Outcome::NotRun) continue;
    const auto is_same = [&](const Check& other) { return other.name == check.name; };
    const auto is_unasked = [&](const Check& other) {
      return is_same(other) && other.outcome == Check::Outcome::NotRun;
    };
    if (std::ranges::any_of(checks.first(i), is_unasked)) continue;
    std::string of;
    for (const Check& other : checks) {
      if (is_unasked(other)) of += (of.empty() ? "" : ", ") + other.subject;
    }
    const bool is_of_all = std::ranges::all_of(checks, [&](const Check& other) {
      return !is_same(other) || other.outcome == Check::Outcome::NotRun;
    });
    names.push_back(is_of_all || of.empty() ? check.name : fmt::format("{} ({})", check.name, of));
  }
  return names;
}

}  // namespace swarmsmith
