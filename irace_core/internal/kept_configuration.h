#pragma once

#include <string>
#include <utility>

#include "irace_core/configuration.h"

namespace swarmsmith::irace {

/// A configuration that can be packed to save memory: a design tries tens of thousands, and few of
/// them are looked at again. Most parameters of a configuration are inactive, and most values are
/// small whole numbers, so that a packed one needs some hundred bytes instead of kilobytes. Not
/// thread-safe.
class KeptConfiguration {
 public:
  KeptConfiguration(Configuration configuration)  // NOLINT(google-explicit-constructor)
      : configuration_(std::move(configuration)) {}

  /// The same bits, whether it was packed or not; valid until the next put_away().
  const Configuration& get() const;
  void put_away();

 private:
  mutable Configuration configuration_;
  mutable std::string packed_;  ///< empty while the configuration is not packed
};

}  // namespace swarmsmith::irace
