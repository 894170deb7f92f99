#pragma once

#include <span>
#include <vector>

namespace swarmsmith {

/// A figure of one robot in one run.
struct Estimate {
  double value = 0;
  double error = 0;  ///< one standard error
};

/// The combined result of several estimates.
struct Pooled {
  double mean = 0;
  double error = 0;   ///< one standard error of the mean
  double spread = 0;  ///< between robots and runs, beyond what the errors explain
  double low = 0;     ///< 95 % interval of the mean
  double high = 0;
  std::size_t count = 0;
};

/// Combines estimates, weighted by error and spread (DerSimonian and Laird 1986). The interval is
/// Student's, with the variance of Hartung and Knapp (2001) if it is larger. For a single estimate,
/// the interval follows from its error alone. Needs at least one estimate.
Pooled pooled(std::span<const Estimate> estimates);

/// Two groups of robots; the second one is worse.
struct Groups {
  std::vector<Estimate> usual;
  std::vector<Estimate> weak;  ///< empty if there is only one group
};

/// Splits rates at the gap that separates them best. There are two groups only if the means of the
/// groups differ by more than a tenth, by over five standard errors, and by over three times the
/// spread within the groups.
Groups grouped(std::vector<Estimate> rates);

}  // namespace swarmsmith
