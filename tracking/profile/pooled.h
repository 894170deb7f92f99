#pragma once

#include <span>
#include <vector>

namespace swarmsmith {

/// A figure of one robot in one run.
struct Estimate {
  double value = 0;
  double error = 0;  ///< one standard error
};

/// What many of them tell together.
struct Pooled {
  double mean = 0;
  double error = 0;   ///< one standard error of the mean
  double spread = 0;  ///< between robots and runs, beyond what the errors explain
  double low = 0;     ///< 95 % interval of the mean
  double high = 0;
  std::size_t count = 0;
};

/// Weighed by error and spread (DerSimonian and Laird 1986); the interval is Student's, with the
/// variance of Hartung and Knapp (2001) where it is larger. Of a single estimate it is that of its
/// error alone. At least one.
Pooled pooled(std::span<const Estimate> estimates);

/// Two groups; the second is worse.
struct Groups {
  std::vector<Estimate> usual;
  std::vector<Estimate> weak;  ///< empty: they are one group
};

/// By the gap that separates them best: rates are two groups when the means of the groups differ by
/// more than a tenth, by over five standard errors and by over three times the spread within them.
Groups grouped(std::vector<Estimate> rates);

}  // namespace swarmsmith
