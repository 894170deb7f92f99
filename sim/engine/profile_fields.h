#pragma once

#include <cmath>
#include <span>
#include <string_view>

#include "sim/engine/profile.h"
#include "sim/robot/robot_fields.h"

namespace swarmsmith {

inline constexpr FieldLimits kRate{0, 1};
/// Limits of the fraction of a command that a robot carries out.
inline constexpr FieldLimits kGrip{0, 2};
/// Delays of commands and beats of devices are whole sub-steps of 10 ms, up to ten seconds.
inline constexpr int kLongestDelay = 1000;
/// Limits of the control period, as a factor on 0.1 s.
inline constexpr FieldLimits kPeriodFactor{0.01, 10};

inline constexpr FieldChoices<ContactModel> kContactModels = {
    {{"exact", ContactModel::Exact}, {"box2d", ContactModel::Box2d}}};
inline constexpr FieldChoices<NeighbourSensing::Source> kNeighbourSources = {
    {{"camera", NeighbourSensing::Source::Camera}, {"lidar", NeighbourSensing::Source::Lidar}}};
inline constexpr FieldChoices<bool> kWires = {{{"float64", false}, {"float32", true}}};
inline constexpr FieldChoices<bool> kTouches = {{{"obstacle", false}, {"nothing", true}}};
inline constexpr FieldChoices<bool> kScorePoints = {{{"centre", false}, {"tag", true}}};

/// Visits the fields of a profile in the order of its file, each with its key and limits. All code
/// that reads, writes or sends profiles uses this function, so that a new field needs only one
/// line.
///
/// A visitor has `device(name)`, the device of the fields that follow, and for fields `number(key,
/// value, limits)`, `flag(key, value)`, `choice(key, value, choices)`, `colors(key, list)`,
/// `delays(key, list)`, `beat(key, sub_steps)`, `period(key, least, most)` and `point(key, value,
/// limits)`. Fields that were added later are visited through `later(is_ideal, visit)`: a writer
/// leaves them out if they are ideal, so that the texts of older profiles, and the digests of
/// campaigns with them, do not change. Fields that do not apply to all robots are visited through
/// `only(use, visit)`.
template <class AnyProfile, class Visitor>
void visit_profile_fields(AnyProfile& profile, Visitor& visitor) {
  visitor.choice("contacts", profile.contacts, kContactModels);
  visitor.later(!profile.float32_wire,
                [&] { visitor.choice("wire", profile.float32_wire, kWires); });

  visitor.device("proximity");
  visitor.only(kOfDistances, [&] {
    visitor.number("range", profile.proximity.range_m, FieldLimits{0.06, 2});
    visitor.number("sd", profile.proximity.sd_m, FieldLimits{0, 1});
    visitor.number("scale_sd", profile.proximity.scale_sd, FieldLimits{0, 1});
    visitor.number("largest_miss_rate", profile.proximity.largest_miss_rate, kRate);
    visitor.number("phantom_rate", profile.proximity.phantom_rate, kRate);
    visitor.later(!profile.proximity.touch_is_nothing,
                  [&] { visitor.choice("touch", profile.proximity.touch_is_nothing, kTouches); });
  });
  visitor.only(kOfStrengths, [&] {
    visitor.later(profile.proximity.half_width == 0,
                  [&] { visitor.number("half_width", profile.proximity.half_width, kRate); });
  });

  visitor.device("ground_color");
  visitor.only(kOfColors, [&] {
    visitor.number("sd", profile.ground_color.sd, FieldLimits{0, 255});
    visitor.number("bias_sd", profile.ground_color.bias_sd, FieldLimits{0, 255});
    visitor.flag("labeler", profile.ground_color.labeler);
    visitor.colors("labels", profile.ground_color.labels);
  });
  visitor.only(kOfVotes, [&] {
    visitor.later(profile.ground_color.half_width == 0,
                  [&] { visitor.number("half_width", profile.ground_color.half_width, kRate); });
  });

  visitor.device("light");
  visitor.only(kOfLightStrengths, [&] {
    visitor.later(profile.light.half_width == 0,
                  [&] { visitor.number("half_width", profile.light.half_width, kRate); });
  });

  visitor.device("lidar");
  visitor.only(kOfSight, [&] {
    visitor.number("half_width", profile.lidar.half_width_m, FieldLimits{0, 1});
  });

  visitor.device("neighbours");
  visitor.only(kOfSight,
               [&] { visitor.choice("source", profile.neighbours.source, kNeighbourSources); });
  visitor.number("miss_rate", profile.neighbours.miss_rate, kRate);
  visitor.number("weak_share", profile.neighbours.weak_share, kRate);
  visitor.number("weak_miss_rate", profile.neighbours.weak_miss_rate, kRate);
  visitor.only(kOfSight, [&] {
    visitor.later(profile.neighbours.every_sub_steps == 0,
                  [&] { visitor.beat("every", profile.neighbours.every_sub_steps); });
  });

  visitor.device("timing");
  visitor.delays("delays", profile.timing.delays);
  visitor.period("period", profile.timing.least_period, profile.timing.most_period);
  visitor.number("jitter", profile.timing.jitter, FieldLimits{0, 0.5});
  visitor.later(profile.timing.driver_sub_steps == 0,
                [&] { visitor.beat("driver", profile.timing.driver_sub_steps); });

  visitor.device("treads");
  visitor.later(profile.treads.step_mps == 0, [&] {
    visitor.number("step", profile.treads.step_mps, FieldLimits{0, kFastestWheel_mps});
  });
  visitor.later(profile.treads.sd == 0, [&] { visitor.number("sd", profile.treads.sd, kRate); });
  visitor.later(profile.treads.way == 1, [&] { visitor.number("way", profile.treads.way, kGrip); });
  visitor.later(profile.treads.way_sd == 0,
                [&] { visitor.number("way_sd", profile.treads.way_sd, kRate); });
  visitor.later(profile.treads.turn == 1,
                [&] { visitor.number("turn", profile.treads.turn, kGrip); });
  visitor.later(profile.treads.turn_sd == 0,
                [&] { visitor.number("turn_sd", profile.treads.turn_sd, kRate); });

  visitor.device("tracking");
  visitor.point("tag", profile.tracking.tag, FieldLimits{-1, 1});
  visitor.choice("score_point", profile.tracking.scores_tag, kScorePoints);
}

/// Whether the probabilities sum to 1. An empty list, which means no delay, counts as a
/// distribution, too. The sum need not be exact, because decimal fractions are rounded.
inline bool is_distribution(std::span<const ControlTiming::Delay> delays) {
  double sum = delays.empty() ? 1 : 0;
  for (const ControlTiming::Delay& delay : delays) {
    if (!kRate.contain(delay.probability)) return false;
    sum += delay.probability;
  }
  return std::fabs(sum - 1) < 1e-9;
}

}  // namespace swarmsmith
