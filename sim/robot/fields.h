#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace swarmsmith {

/// Limits and choices for fields of a robot or a profile (robot_fields.h,
/// sim/engine/profile_fields.h).

struct Robot;

/// The robots on which a field has an effect, depending on the readings of one of their devices.
struct FieldUse {
  bool (*acts_on)(const Robot& robot);
  std::string_view robots;  ///< "robots ..." in messages
};

/// The limits of a field, both included.
struct FieldLimits {
  double least = 0;
  double most = 0;

  /// False for NaN.
  constexpr bool contain(double value) const { return value >= least && value <= most; }
};

/// The values that a field may have, with their words in the file.
template <class Value>
using FieldChoices = std::array<std::pair<std::string_view, Value>, 2>;

/// The word of a value.
template <class Value>
std::string_view word_of(Value value, const FieldChoices<Value>& choices) {
  return choices[0].second == value ? choices[0].first : choices[1].first;
}

}  // namespace swarmsmith
