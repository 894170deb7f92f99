#pragma once

namespace swarmsmith {

/// Elementary functions that use only + - * / and square root, for which IEEE 754 defines every bit
/// of the result. The functions of the C library differ in their last bits between CPUs, since it
/// selects variants by the features of the CPU. Everything that decides a race or moves a robot
/// uses these functions instead. Their errors are below three units in the last place, tested
/// against the C library.

inline constexpr double kPi = 3.141592653589793;

struct SinCos {
  double sin;
  double cos;
};

/// Sine and cosine of an angle in radians; |angle_rad| up to 1e5.
SinCos sin_cos(double angle_rad);
inline double sin(double angle_rad) {
  return sin_cos(angle_rad).sin;
}
inline double cos(double angle_rad) {
  return sin_cos(angle_rad).cos;
}

/// Angle of the point (x, y) in (-pi, pi]; 0 for the origin.
double atan2(double y, double x);

/// e^x; 0 below -745.2, infinity above 709.8.
double exp(double x);
/// Natural logarithm; -infinity at 0, NaN below.
double log(double x);
/// base^exponent for base > 0, as exp(exponent * log(base)); relative error below 1e-13 for results
/// between 1e-100 and 1e100.
double pow(double base, double exponent);

/// Lower tail of the standard normal distribution, and its inverse (p in (0, 1)). The inverse:
/// Wichura, Algorithm AS 241, Applied Statistics 37 (1988), relative error about 1e-16.
double normal_cdf(double x);
double normal_quantile(double p);

/// The angle minus the multiple of 2 pi that brings it into (-pi, pi]. Beyond 1000 rad, rounding
/// may leave it outside.
double wrap_angle(double angle_rad);

/// Length of (x, y).
double hypot(double x, double y);

}  // namespace swarmsmith
