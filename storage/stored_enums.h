#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// The meanings of the values that stores keep as numbers or words, in one table for each
/// enumeration. Code that distinguishes purposes uses this table. An enumerator without a line in
/// it does not compile.

struct PurposeFacts {
  /// How a replay of the design uses the score. Only scores that a replay asks for are part of the
  /// answer.
  enum class Replay : std::uint8_t {
    None,       ///< not used: made after the race, or ahead of it
    Race,       ///< counts if a race has used it
    Tests,      ///< always counts
    Evaluator,  ///< always counts
  };

  std::string_view word;    ///< as in the views
  std::string_view letter;  ///< suffix of the ids of its evaluations; empty for races
  Replay replay = Replay::None;
  bool own_source = false;  ///< made with the campaign's own profile, or by its program
  bool simulated = false;  ///< made by workers of the campaign; `replay` and `verify` can repeat it
  std::string_view
      counts_as;         ///< its name among the scores of winners; empty: it is not one of them
  std::string_view why;  ///< why it was made, as shown to users; empty: this needs a longer text
};

/// Empty for a number that is not a purpose.
constexpr std::optional<PurposeFacts> facts_of(Purpose purpose) {
  using Replay = PurposeFacts::Replay;
  switch (purpose) {
    case Purpose::Race:
      return PurposeFacts{"race", "", Replay::Race, true, true, "", ""};
    case Purpose::LookAhead:
      return PurposeFacts{"look-ahead", "l", Replay::None, true, true, "", ""};
    case Purpose::Test:
      return PurposeFacts{"test", "t", Replay::Tests, true, true, "test", ""};
    case Purpose::Audit:
      return PurposeFacts{
          "audit", "a", Replay::None, true, false, "", "an audit: a second worker, bits compared"};
    case Purpose::Score:
      return PurposeFacts{
          "score", "s", Replay::None, false, false, "score", "a person scored the candidate"};
    case Purpose::Evaluator:
      return PurposeFacts{
          "evaluator", "v", Replay::Evaluator, true, false, "", "a call of the targetEvaluator"};
    case Purpose::Transfer:
      return PurposeFacts{"transfer",
                          "p",
                          Replay::Tests,
                          false,
                          true,
                          "score",
                          "a test of its candidate under a further profile"};
  }
  return std::nullopt;
}

/// All values, by number.
std::vector<Purpose> all_purposes();
std::vector<EvaluationStatus> all_statuses();
std::vector<DesignState> all_design_states();

/// The value of a stored number; empty for a number that this version does not know.
std::optional<Purpose> purpose_of(std::int64_t number);
std::optional<EvaluationStatus> status_of(std::int64_t number);
std::optional<DesignState> state_of(std::int64_t number);
/// The purpose of this letter in an evaluation's id; an empty text has none.
std::optional<Purpose> purpose_of_letter(std::string_view letter);
/// The purpose of this word in the views.
std::optional<Purpose> purpose_of_word(std::string_view word);

/// "ok", "rejected", as in the views.
std::string_view word_of(EvaluationStatus status);

/// For SQL: "(2, 6)", the numbers of the selected values. Never an empty list, but "(NULL)".
std::string numbers_in_sql(bool (*is_meant)(const PurposeFacts&));
std::string numbers_in_sql(const std::vector<EvaluationStatus>& statuses);
std::string numbers_in_sql(const std::vector<DesignState>& states);
/// The same with the words of the views: "('test', 'transfer')".
std::string words_in_sql(bool (*is_meant)(const PurposeFacts&));

constexpr bool is_any(const PurposeFacts&) {
  return true;
}
/// Whether an evaluation counts in the answer even if no race used it.
constexpr bool always_counts(const PurposeFacts& facts) {
  return facts.replay == PurposeFacts::Replay::Tests ||
         facts.replay == PurposeFacts::Replay::Evaluator;
}
/// Whether a replay asks for the evaluation.
constexpr bool is_of_replay(const PurposeFacts& facts) {
  return facts.replay != PurposeFacts::Replay::None;
}
constexpr bool has_own_source(const PurposeFacts& facts) {
  return facts.own_source;
}
constexpr bool is_simulated(const PurposeFacts& facts) {
  return facts.simulated;
}
constexpr bool is_test(const PurposeFacts& facts) {
  return facts.replay == PurposeFacts::Replay::Tests;
}
/// Whether it is a test that also counts among the scores of winners.
constexpr bool is_transfer(const PurposeFacts& facts) {
  return is_test(facts) && facts.counts_as == "score";
}
constexpr bool is_score_of_winner(const PurposeFacts& facts) {
  return !facts.counts_as.empty();
}

/// The verdicts of users and programs on a real run (the same as in tracking/rig/issue.h).
inline constexpr std::array<std::string_view, 3> kVerdicts = {"VALID", "DEGRADED", "INVALID"};
/// "('VALID', 'DEGRADED', 'INVALID')".
std::string verdicts_in_sql();

}  // namespace swarmsmith
