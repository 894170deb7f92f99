#pragma once

#include <string_view>

#include "sim/control/conditions/neighbour_count.h"
#include "sim/control/module_parts.h"

namespace swarmsmith {

/// Enabled with probability 1 - z(n) for n neighbours, z as in NeighbourCount.
struct InvertedNeighbourCount {
  static constexpr std::string_view kId = "inverted_neighbour_count";
  static constexpr std::string_view kLabel = "Inverted\nneighbour count";
  using Reads = NeighbourTally;

  double eta = 0;  ///< steepness, 0..20 in the search
  int xi = 0;      ///< the count at which the probability is one half

  template <class Self, class Visitor>
  static void parameters(Self& self, Visitor& visitor) {
    visitor(xi_parameter("BI"), self.xi);
    visitor(eta_parameter("WI"), self.eta);
  }
  double enabling(const NeighbourTally& neighbours, const Flavour& flavour) const {
    return 1.0 - neighbour_sigmoid(eta, xi, neighbours.count, flavour.neighbours.unsigned_count);
  }
  friend bool operator==(const InvertedNeighbourCount&, const InvertedNeighbourCount&) = default;
};

}  // namespace swarmsmith
