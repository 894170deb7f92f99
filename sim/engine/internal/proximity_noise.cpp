#include "sim/engine/internal/proximity_noise.h"

#include <cmath>
#include <limits>

#include "sim/engine/internal/two.h"

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The same as in rays.h, for two distances at once.
Two limited(Two distance_m, double range_m) {
  const Two seen = distance_m > range_m ? both(kInfinity) : distance_m;
  return distance_m < kBlindZone_m ? both(-kInfinity) : seen;
}

}  // namespace

ProximityNoise::ProximityNoise(const ProximitySensing& sensing, const Rng& run, int robot,
                               std::size_t sensors)
    : sensing_(&sensing),
      per_cycle_(numbers_per_cycle(sensors)),
      ideal_(sensing.sd_m == 0 && sensing.scale_sd == 0 && sensing.phantom_rate == 0 &&
             sensing.largest_miss_rate == 0),
      only_normal_(sensing.sd_m > 0 && sensing.scale_sd == 0 && sensing.phantom_rate == 0 &&
                   sensing.largest_miss_rate == 0) {
  if (sensing.sd_m > 0) normal_ = NoiseStream(run, "proximity", robot);
  if (sensing.scale_sd > 0) scale_ = NoiseStream(run, "proximity scale", robot);
  if (sensing.phantom_rate > 0) phantom_ = NoiseStream(run, "proximity phantom", robot);
  if (sensing.largest_miss_rate > 0) {
    miss_ = NoiseStream(run, "proximity miss", robot);
    Rng rates = run.split("proximity miss rates", static_cast<std::uint64_t>(robot));
    for (double& rate : miss_rates_)
      rate = rates.uniform(0, sensing.largest_miss_rate);
  }
}

void ProximityNoise::apply(std::span<double> readings, std::int64_t cycle) const {
  const double range = sensing_->range_m;
  std::size_t pairs = 0;
  for (; pairs + 2 <= readings.size(); pairs += 2)
    store_two(limited(load_two(&readings[pairs]), range), &readings[pairs]);
  if (pairs < readings.size()) readings[pairs] = limited(readings[pairs], range);
  if (ideal_) return;
  const auto first = static_cast<std::uint64_t>(cycle) * per_cycle_;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    double& reading = readings[i];
    if (!only_normal_) {
      reading = read(reading, i, first + i);
    } else if (std::isfinite(reading)) {
      reading = limited(reading + sensing_->sd_m * normal_.normal(first + i), range);
    }
  }
}

double ProximityNoise::read(double distance_m, std::size_t sensor, std::uint64_t index) const {
  if (sensing_->phantom_rate > 0) {
    Rng phantom = phantom_.at(index);
    if (phantom.bernoulli(sensing_->phantom_rate)) {
      return phantom.uniform(kBlindZone_m, sensing_->range_m);
    }
  }
  if (distance_m == kInfinity) return distance_m;
  if (sensing_->largest_miss_rate > 0 && miss_.at(index).bernoulli(miss_rates_[sensor])) {
    return kInfinity;
  }
  if (!std::isfinite(distance_m)) return distance_m;
  if (sensing_->scale_sd > 0) distance_m *= 1 + sensing_->scale_sd * scale_.normal(index);
  if (sensing_->sd_m > 0) distance_m += sensing_->sd_m * normal_.normal(index);
  return limited(distance_m, sensing_->range_m);
}

}  // namespace swarmsmith
