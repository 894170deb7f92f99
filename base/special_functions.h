#pragma once

#include <cstdint>
#include <vector>

namespace swarmsmith {

/// Natural logarithm of the gamma function, x > 0.
double log_gamma(double x);

/// P(X >= x) for a chi-square variable; `dof` > 0, x >= 0. Relative error about 1e-13.
double chi_square_upper_tail(double x, double dof);

/// P(|T| >= t) for Student's t; `dof` > 0, t >= 0.
double student_t_two_sided_tail(double t, double dof);

/// The t > 0 with P(T > t) = upper_tail, for 0 < upper_tail < 1/2 and dof >= 1. Relative error
/// about 1e-12.
double student_t_upper_quantile(double upper_tail, double dof);

/// Quantiles for one fixed tail and many degrees of freedom. Those for few degrees of freedom,
/// which are used often, are computed only once.
class StudentQuantiles {
 public:
  explicit StudentQuantiles(double upper_tail) : upper_tail_(upper_tail) {}
  double operator()(std::int64_t dof);

 private:
  double upper_tail_;
  std::vector<double> known_;  ///< by degrees of freedom; 0: not computed yet
};

}  // namespace swarmsmith
