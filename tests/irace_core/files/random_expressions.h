#pragma once

#include <string>
#include <vector>

#include "base/rng.h"
#include "irace_core/expression.h"

namespace swarmsmith::testing {

/// Random trees over all operations, for properties.
class RandomExpressions {
 public:
  RandomExpressions(Rng& rng, std::vector<std::string> names)
      : rng_(&rng), names_(std::move(names)) {}

  /// Any tree of at most that depth.
  Expression any(int depth);
  /// One that a bound may have: arithmetic over `names`; at least one of them occurs.
  Expression bound(int depth);

 private:
  int below(int n) { return static_cast<int>(rng_->uniform_int(0, n - 1)); }
  Expression leaf();
  Expression number();

  Rng* rng_;
  std::vector<std::string> names_;
};

}  // namespace swarmsmith::testing
