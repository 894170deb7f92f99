#pragma once

#include <span>
#include <string_view>

namespace swarmsmith {

/// Vargha and Delaney's A12: the probability that a value of the first sample is larger than a
/// value of the second one; ties count half. 0.5 means that neither tends to be larger. Neither
/// sample may be empty.
/// Source: Vargha and Delaney 2000, Journal of Educational and Behavioral Statistics 25(2).
double vargha_delaney(std::span<const double> first, std::span<const double> second);

/// The authors' names for effect sizes, by the distance from 0.5: "negligible", "small" from 0.06,
/// "medium" from 0.14, "large" from 0.21.
std::string_view magnitude_of(double a12);

}  // namespace swarmsmith
