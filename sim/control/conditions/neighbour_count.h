#pragma once

#include <string_view>

#include "base/math.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// z(n) of the conditions on the number of neighbours (thesis eq. 5.7). With `unsigned_count`, a
/// negative xi - n becomes a huge number, so that z(n) is 0.
inline double neighbour_sigmoid(double eta, int xi, int neighbours, bool unsigned_count) {
  if (unsigned_count && neighbours > xi && eta > 0) return 0;
  return 1.0 / (1.0 + exp(eta * (xi - neighbours)));
}

/// Enabled with probability z(n) = 1 / (1 + e^(eta (xi - n))) for n neighbours (thesis eq. 5.7).
struct NeighbourCount {
  static constexpr std::string_view kId = "neighbour_count";
  static constexpr std::string_view kLabel = "Neighbour count";
  using Reads = NeighbourTally;

  double eta = 0;  ///< steepness, 0..20 in the search
  int xi = 0;      ///< the count at which the probability is one half

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(xi_parameter("B"), self.xi);
    visitor(eta_parameter("W"), self.eta);
  }
  double enabling(const NeighbourTally& neighbours, const Flavour& flavour) const {
    return neighbour_sigmoid(eta, xi, neighbours.count, flavour.neighbours.unsigned_count);
  }
  friend bool operator==(const NeighbourCount&, const NeighbourCount&) = default;
};

}  // namespace swarmsmith
