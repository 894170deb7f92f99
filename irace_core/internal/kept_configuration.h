#pragma once

#include <string>
#include <utility>

#include "irace_core/configuration.h"

namespace swarmsmith::irace {

/// A configuration that can be put away: a design tries tens of thousands, and few of them are
/// looked at again. Most parameters of one are inactive, and most values small whole numbers: what
/// is put away takes some hundred bytes where it took kilobytes. Not for several threads.
class KeptConfiguration {
 public:
  KeptConfiguration(Configuration configuration)  // NOLINT(google-explicit-constructor)
      : configuration_(std::move(configuration)) {}

  /// The same bits, whether it was put away or not; valid until it is put away.
  const Configuration& get() const;
  void put_away();

 private:
  mutable Configuration configuration_;
  mutable std::string packed_;  ///< empty while it is there
};

}  // namespace swarmsmith::irace
