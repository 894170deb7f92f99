#include "base/special_functions.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>

namespace swarmsmith {
namespace {

void expect_relative(double ours, double theirs, double error) {
  EXPECT_NEAR(ours, theirs, error * std::fabs(theirs));
}

TEST(SpecialFunctions, LogGammaAgreesWithBoost) {
  for (double x = 0.5; x < 2000; x *= 1.37) {
    EXPECT_NEAR(log_gamma(x), boost::math::lgamma(x), 1e-13 * (1 + std::fabs(log_gamma(x)))) << x;
  }
}

TEST(SpecialFunctions, ChiSquareTailAgreesWithBoost) {
  for (const int dof : {1, 2, 3, 7, 20, 63, 150, 511, 1023}) {
    const boost::math::chi_squared theirs(dof);
    for (const double scale : {0.1, 0.5, 0.8, 1.0, 1.1, 1.3, 2.0, 3.0}) {
      SCOPED_TRACE(::testing::Message() << dof << " degrees of freedom, times " << scale);
      const double x = dof * scale;
      expect_relative(chi_square_upper_tail(x, dof),
                      boost::math::cdf(boost::math::complement(theirs, x)), 2e-12);
    }
  }
  EXPECT_EQ(chi_square_upper_tail(0, 4), 1);
}

TEST(SpecialFunctions, StudentTailAgreesWithBoost) {
  for (const double dof : {1.0, 2.0, 5.0, 31.0, 400.0, 1900.0}) {
    const boost::math::students_t theirs(dof);
    for (const double t : {0.01, 0.5, 1.0, 1.9, 2.5, 4.0, 9.0}) {
      expect_relative(student_t_two_sided_tail(t, dof),
                      2 * boost::math::cdf(boost::math::complement(theirs, t)), 2e-12);
    }
  }
}

TEST(SpecialFunctions, StudentQuantileAgreesWithBoost) {
  for (const double tail : {0.1, 0.05, 0.025, 0.005, 0.0005}) {
    for (const double dof :
         {1.0, 2.0, 3.0, 4.0, 10.0, 76.0, 304.0, 999.0, 1000.0, 1999.0, 5e3, 4e4, 1e6}) {
      SCOPED_TRACE(::testing::Message() << "tail " << tail << ", " << dof << " degrees of freedom");
      const boost::math::students_t theirs(dof);
      expect_relative(student_t_upper_quantile(tail, dof),
                      boost::math::quantile(boost::math::complement(theirs, tail)), 1e-12);
    }
  }
}

TEST(SpecialFunctions, RememberedQuantilesAreTheSame) {
  StudentQuantiles quantiles(0.025);
  for (const std::int64_t dof : {4, 300, 4, 300'000}) {
    EXPECT_EQ(quantiles(dof), student_t_upper_quantile(0.025, static_cast<double>(dof)));
  }
}

}  // namespace
}  // namespace swarmsmith
