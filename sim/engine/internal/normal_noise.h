#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/rng.h"

namespace swarmsmith {

/// Standard normal numbers for sensor noise, several times cheaper than Rng::normal: the ziggurat
/// method with 128 layers (Marsaglia and Tsang, "The ziggurat method for generating random
/// variables", Journal of Statistical Software 5(8), 2000; in the form of Doornik's ZIGNOR, which
/// takes layer and height from separate bits). The distribution is exact. Most draws use one number
/// of the stream, about one in a hundred uses more.
class NormalNoise {
 public:
  /// The tables, made once; safe to call from any thread.
  static const NormalNoise& instance() {
    static const NormalNoise noise;
    return noise;
  }

  /// Draws one number. The stream is passed by value, so that its state stays in registers.
  double draw(Rng rng) const {
    const std::uint64_t bits = rng.next();
    const std::size_t layer = bits % kLayers;
    const double u = share_of(bits);
    if (std::fabs(u) < inside_[layer]) return u * edge_[layer];
    return draw_edge(rng, layer, u);
  }

 private:
  NormalNoise();
  /// Uniform in [-1, 1).
  static double share_of(std::uint64_t bits) {
    return static_cast<double>(bits >> 11U) * 0x1.0p-52 - 1;
  }
  /// The rest of a draw that is not certain to lie under the curve; needed for one draw in a
  /// hundred.
  double draw_edge(Rng rng, std::size_t layer, double u) const;
  static double draw_tail(Rng rng, bool negative);

  static constexpr std::size_t kLayers = 128;
  std::array<double, kLayers + 1> edge_;  ///< right ends of the layers, the widest first
  std::array<double, kLayers + 1> top_;   ///< height of the curve at that point
  std::array<double, kLayers> inside_;    ///< fraction of a layer that is certain to lie under the
                                          ///< curve
};

}  // namespace swarmsmith
