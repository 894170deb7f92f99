#pragma once

#include <array>

#include "base/rng.h"

namespace swarmsmith {

/// Standard normal numbers for sensor noise, several times cheaper than Rng::normal: the ziggurat
/// method with 128 layers (Marsaglia and Tsang, "The ziggurat method for generating random
/// variables", Journal of Statistical Software 5(8), 2000; in the form of Doornik's ZIGNOR, which
/// takes layer and height from separate bits). Exact in distribution. Most draws take one number of
/// the stream, about one in a hundred takes more.
class NormalNoise {
 public:
  /// The tables, made once; any thread.
  static const NormalNoise& instance();

  double draw(Rng& rng) const;

 private:
  NormalNoise();
  static double draw_tail(Rng& rng, bool negative);

  static constexpr std::size_t kLayers = 128;
  std::array<double, kLayers + 1> edge_;  ///< right ends of the layers, the widest first
  std::array<double, kLayers> inside_;    ///< share of a layer that lies under the curve for sure
};

}  // namespace swarmsmith
