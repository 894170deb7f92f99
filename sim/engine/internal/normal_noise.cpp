#include "sim/engine/internal/normal_noise.h"

#include <cmath>

#include "base/math.h"

namespace swarmsmith {
namespace {

/// Start of the tail, and area of each layer, for 128 layers.
constexpr double kTail = 3.442619855899;
constexpr double kArea = 9.91256303526217e-3;

/// The normal density without its constant factor.
double curve(double x) {
  return exp(-0.5 * x * x);
}

}  // namespace

NormalNoise::NormalNoise() {
  edge_[0] = kArea / curve(kTail);
  edge_[1] = kTail;
  for (std::size_t i = 2; i < kLayers; ++i) {
    edge_[i] = std::sqrt(-2 * log(kArea / edge_[i - 1] + curve(edge_[i - 1])));
  }
  edge_[kLayers] = 0;
  for (std::size_t i = 0; i < kLayers; ++i)
    inside_[i] = edge_[i + 1] / edge_[i];
  for (std::size_t i = 0; i < edge_.size(); ++i)
    top_[i] = curve(edge_[i]);
}

double NormalNoise::draw_edge(Rng rng, std::size_t layer, double u) const {
  if (layer == 0) return draw_tail(rng, u < 0);
  const double x = u * edge_[layer];
  const double top = top_[layer + 1];
  const double bottom = top_[layer];
  if (bottom + rng.uniform() * (top - bottom) < curve(x)) return x;
  return draw(rng);
}

double NormalNoise::draw_tail(Rng rng, bool negative) {
  for (;;) {
    // 1 - uniform() is never 0.
    const double x = -log(1 - rng.uniform()) / kTail;
    const double y = -log(1 - rng.uniform());
    if (2 * y >= x * x) return negative ? -(kTail + x) : kTail + x;
  }
}

}  // namespace swarmsmith
