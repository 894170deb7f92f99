#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/hash.h"

namespace swarmsmith {

/// A point of a parameter space: one value per parameter, by the parameter's index. For categorical
/// and ordinal parameters the value is the 0-based index of the chosen value, for integers and
/// reals it is the number. A parameter whose condition does not hold is inactive, which differs
/// from every value.
class Configuration {
 public:
  Configuration() = default;
  /// Starts with all parameters inactive.
  explicit Configuration(std::size_t parameters);

  std::size_t size() const { return values_.size(); }
  bool is_active(std::size_t parameter) const { return values_[parameter] == values_[parameter]; }
  /// NaN when inactive.
  double operator[](std::size_t parameter) const { return values_[parameter]; }
  /// The index of an active categorical or ordinal parameter's value.
  std::size_t choice(std::size_t parameter) const {
    return static_cast<std::size_t>(values_[parameter]);
  }

  /// Stores minus zero as zero; NaN makes the parameter inactive.
  void set(std::size_t parameter, double value);
  void deactivate(std::size_t parameter);

  /// Equal configurations have equal digests, on every machine.
  std::uint64_t digest() const;

  /// Whether the same parameters are active and have the same values.
  friend bool operator==(const Configuration& a, const Configuration& b);

 private:
  std::vector<double> values_;  ///< NaN means inactive
};

}  // namespace swarmsmith
