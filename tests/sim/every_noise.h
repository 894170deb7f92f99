#pragma once

#include "sim/engine/profile.h"

namespace swarmsmith {

/// A profile in which no field has its default.
inline Profile every_noise() {
  return {
      .name = "every-noise",
      .contacts = ContactModel::Box2d,
      .float32_wire = true,
      .proximity = {.range_m = 1.0 / 3,
                    .sd_m = 0.011,
                    .scale_sd = 0.12,
                    .largest_miss_rate = 0.13,
                    .phantom_rate = 0.014,
                    .touch_is_nothing = true},
      .ground_color = {.sd = 1.5, .bias_sd = 16, .labeler = true, .labels = {{1, 2, 3}, {}}},
      .lidar = {.half_width_m = 0.17},
      .neighbours = {.source = NeighbourSensing::Source::Lidar,
                     .miss_rate = 0.18,
                     .weak_share = 0.19,
                     .weak_miss_rate = 0.2,
                     .every_sub_steps = 13},
      .timing = {.delays = {{0, 0.1}, {7, 0.2}, {1000, 0.7}},
                 .least_period = 0.71234,
                 .most_period = 1.21,
                 .jitter = 0.022,
                 .driver_sub_steps = 21},
      .treads = {.step_mps = 0.023, .way = 0.97, .way_sd = 0.024, .turn = 0.85, .turn_sd = 0.025},
      .tracking = {.tag = {-0.023, 0.024}, .scores_tag = true}};
}

}  // namespace swarmsmith
