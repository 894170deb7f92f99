#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/rows.h"

namespace swarmsmith {

/// What the values mean that stores keep as numbers or words: the one table of each. Code that
/// distinguishes purposes takes it from here, and an enumerator without a line does not compile.

struct PurposeFacts {
  /// Which scores of a design's replay hold it; only what a replay asks for is part of the answer.
  enum class Replay : std::uint8_t {
    None,       ///< later, or ahead: stays as it is
    Race,       ///< counts if a race has used it
    Tests,      ///< always counts
    Evaluator,  ///< always counts
  };

  std::string_view word;    ///< as in views
  std::string_view letter;  ///< behind the number of its evaluations' ids; empty of races
  Replay replay = Replay::None;
  bool own_source = false;     ///< made under the campaign's own profile, or by its program
  bool simulated = false;      ///< by workers of the campaign: `replay` and `verify` make it again
  std::string_view counts_as;  ///< its word among the winners' scores; empty: it is none
  std::string_view why;        ///< as people read why it was made; empty: they need more words
};

/// Nothing for a number that is not a purpose.
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

/// Every value, by number.
std::vector<Purpose> all_purposes();
std::vector<EvaluationStatus> all_statuses();
std::vector<DesignState> all_design_states();

/// Of a stored number; nothing of one that no version knows yet.
std::optional<Purpose> purpose_of(std::int64_t number);
std::optional<EvaluationStatus> status_of(std::int64_t number);
std::optional<DesignState> state_of(std::int64_t number);
/// Of an evaluation's letter, or none for an empty text.
std::optional<Purpose> purpose_of_letter(std::string_view letter);
/// Of the word in views.
std::optional<Purpose> purpose_of_word(std::string_view word);

/// "ok", "rejected": as in views.
std::string_view word_of(EvaluationStatus status);

/// For SQL: "(2, 6)", the numbers of the values that are meant. Never empty: "(NULL)".
std::string numbers_in_sql(bool (*is_meant)(const PurposeFacts&));
std::string numbers_in_sql(const std::vector<EvaluationStatus>& statuses);
std::string numbers_in_sql(const std::vector<DesignState>& states);
/// The same of the words in views: "('test', 'transfer')".
std::string words_in_sql(bool (*is_meant)(const PurposeFacts&));

constexpr bool is_any(const PurposeFacts&) {
  return true;
}
/// Counts in the answer whether a race used it or not.
constexpr bool always_counts(const PurposeFacts& facts) {
  return facts.replay == PurposeFacts::Replay::Tests ||
         facts.replay == PurposeFacts::Replay::Evaluator;
}
/// A replay asks for it.
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
/// A test that counts as a score among the winners'.
constexpr bool is_transfer(const PurposeFacts& facts) {
  return is_test(facts) && facts.counts_as == "score";
}
constexpr bool is_score_of_winner(const PurposeFacts& facts) {
  return !facts.counts_as.empty();
}

/// What a person or a program says of a real run (tracking/rig/issue.h has the same).
inline constexpr std::array<std::string_view, 3> kVerdicts = {"VALID", "DEGRADED", "INVALID"};
/// "('VALID', 'DEGRADED', 'INVALID')".
std::string verdicts_in_sql();

}  // namespace swarmsmith
