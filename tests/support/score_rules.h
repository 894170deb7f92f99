#pragma once

#include <string>
#include <vector>

#include "sim/mission/score.h"

namespace swarmsmith {

/// Gives each parameter of a kind, whatever it is, a value that is not its default.
struct OddParameters {
  When when;
  int colors = 0;

  void operator()(const ScoreField& field, double& value) const {
    value = field.allows(value + 0.1) ? value + 0.1 : field.least;
  }
  void operator()(const ScoreField& field, int& value) const {
    value = field.allows(value + 1) ? value + 1 : static_cast<int>(field.least);
  }
  void operator()(const ScoreField& /*field*/, bool& value) const { value = !value; }
  /// Grey, then black.
  void operator()(const ScoreField& /*field*/, Rgb& value) {
    value = colors++ == 0 ? Rgb{127, 127, 127} : Rgb{0, 0, 0};
  }
  void operator()(const ScoreField& /*field*/, When& value) const { value = when; }
  void operator()(const ScoreField& field, std::string& value) const {
    value = field.choices.empty() ? "x * (1 + gray) + t" : std::string(field.choices.back());
  }
  void operator()(const ScoreField& /*field*/, std::vector<Reward>& value) const {
    value = {{{1, 2, 3}, -0.3}, {{0, 0, 0}, 0.7}, {{127, 127, 127}, 0.1}};
  }
};

/// Two rules of every kind in the list, one for the end and one for the sum.
inline std::vector<ScoreRule> rules_of_every_kind() {
  std::vector<ScoreRule> rules;
  for (const std::string& kind : score_kinds()) {
    for (const When when : {When::End, When::Sum}) {
      OddParameters odd{when};
      visit_fields(rules.emplace_back(*score_of_kind(kind)), odd);
    }
  }
  return rules;
}

}  // namespace swarmsmith
