#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace swarmsmith {

/// What fields of a robot or a profile may be (robot_fields.h, sim/engine/profile_fields.h).

struct Robot;

/// The robots that a field acts on, by what a device of theirs gives. It does nothing for others.
struct FieldUse {
  bool (*acts_on)(const Robot& robot);
  std::string_view robots;  ///< "robots ..." in sentences
};

/// Ends of a field's range, both included.
struct FieldLimits {
  double least = 0;
  double most = 0;

  /// False for what is not a number.
  constexpr bool contain(double value) const { return value >= least && value <= most; }
};

/// What a field may be, with the words for it.
template <class Value>
using FieldChoices = std::array<std::pair<std::string_view, Value>, 2>;

/// The word of a value.
template <class Value>
std::string_view word_of(Value value, const FieldChoices<Value>& choices) {
  return choices[0].second == value ? choices[0].first : choices[1].first;
}

}  // namespace swarmsmith
