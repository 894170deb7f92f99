#include "storage/stored_enums.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace swarmsmith {
namespace {

/// Larger than any stored number of an enumerator: keys in messages have three bits for a purpose.
constexpr std::int64_t kNumbers = 8;

template <class Value, class IsOne>
std::vector<Value> all_of(const IsOne& is_one) {
  std::vector<Value> values;
  for (std::int64_t number = 0; number < kNumbers; ++number) {
    const auto value = static_cast<Value>(number);
    if (is_one(value)) values.push_back(value);
  }
  return values;
}

template <class Value>
std::optional<Value> value_of(const std::vector<Value>& all, std::int64_t number) {
  const auto found =
      std::ranges::find(all, number, [](Value value) { return static_cast<std::int64_t>(value); });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

template <class Value>
std::string numbers_of(const std::vector<Value>& values) {
  std::vector<int> numbers;
  for (const Value value : values)
    numbers.push_back(static_cast<int>(value));
  return numbers.empty() ? "(NULL)" : fmt::format("({})", fmt::join(numbers, ", "));
}

std::vector<Purpose> purposes_that(bool (*is_meant)(const PurposeFacts&)) {
  std::vector<Purpose> purposes = all_purposes();
  std::erase_if(purposes, [&](Purpose purpose) { return !is_meant(*facts_of(purpose)); });
  return purposes;
}

std::optional<Purpose> find_purpose(std::string_view text, std::string_view PurposeFacts::*field) {
  const std::vector<Purpose> all = all_purposes();
  const auto found = std::ranges::find_if(
      all, [&](Purpose purpose) { return (*facts_of(purpose)).*field == text; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::vector<Purpose> all_purposes() {
  return all_of<Purpose>([](Purpose purpose) { return facts_of(purpose).has_value(); });
}

std::vector<EvaluationStatus> all_statuses() {
  return all_of<EvaluationStatus>([](EvaluationStatus status) { return !word_of(status).empty(); });
}

std::vector<DesignState> all_design_states() {
  return all_of<DesignState>([](DesignState state) { return !word_of(state).empty(); });
}

std::optional<Purpose> purpose_of(std::int64_t number) {
  return value_of(all_purposes(), number);
}

std::optional<EvaluationStatus> status_of(std::int64_t number) {
  return value_of(all_statuses(), number);
}

std::optional<DesignState> state_of(std::int64_t number) {
  return value_of(all_design_states(), number);
}

std::optional<Purpose> purpose_of_letter(std::string_view letter) {
  return find_purpose(letter, &PurposeFacts::letter);
}

std::optional<Purpose> purpose_of_word(std::string_view word) {
  return find_purpose(word, &PurposeFacts::word);
}

std::string_view word_of(EvaluationStatus status) {
  switch (status) {
    case EvaluationStatus::Ok:
      return "ok";
    case EvaluationStatus::Rejected:
      return "rejected";
  }
  return {};
}

std::string numbers_in_sql(bool (*is_meant)(const PurposeFacts&)) {
  return numbers_of(purposes_that(is_meant));
}

std::string numbers_in_sql(const std::vector<EvaluationStatus>& statuses) {
  return numbers_of(statuses);
}

std::string numbers_in_sql(const std::vector<DesignState>& states) {
  return numbers_of(states);
}

std::string words_in_sql(bool (*is_meant)(const PurposeFacts&)) {
  std::vector<std::string> words;
  for (const Purpose purpose : purposes_that(is_meant))
    words.push_back(fmt::format("'{}'", facts_of(purpose)->word));
  return words.empty() ? "(NULL)" : fmt::format("({})", fmt::join(words, ", "));
}

std::string verdicts_in_sql() {
  return fmt::format("('{}')", fmt::join(kVerdicts, "', '"));
}

}  // namespace swarmsmith
