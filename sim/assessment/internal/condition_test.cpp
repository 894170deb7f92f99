#include "sim/assessment/internal/condition_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "base/assert.h"
#include "base/math.h"
#include "base/overloaded.h"
#include "sim/mission/colors.h"

namespace swarmsmith::assessment {
namespace {

constexpr double kDiscRadius_m = 0.5;  // as the black spot of aggregation

Rgb color_named(std::string_view name) {
  const std::optional<Rgb> color = color_from_name(name);
  SWARMSMITH_ASSERT(color.has_value(), "the floor's colours have names");
  return *color;
}

/// The gray floor with a disc in its middle, which exploring robots cross repeatedly.
Arena arena_with_disc(Rgb color) {
  Arena arena = dodecagon_of_the_thesis();
  arena.patches.push_back({Disc{.centre = {0, 0}, .radius_m = kDiscRadius_m}, color});
  return arena;
}

/// A stripe for each label's colour, side by side over the whole arena. There is no gray between
/// them: with noise its hue is arbitrary, and robots would seldom reach the wanted stripe.
Arena arena_with_stripes(const std::vector<LabelSpec>& labels) {
  constexpr double kSide_m = 2.6;
  Arena arena = dodecagon_of_the_thesis();
  const double width_m = kSide_m / static_cast<double>(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double x_m = (static_cast<double>(i) + 0.5) * width_m - 0.5 * kSide_m;
    arena.patches.push_back({Rectangle{.centre = {x_m, 0}, .width_m = width_m, .height_m = kSide_m},
                             color_named(name_of(labels[i].label))});
  }
  return arena;
}

/// The hue in degrees from red, for a colour that is not gray: each side of the hexagon of full
/// colours is a sixth of a turn.
double hue_of(Rgb color, int largest, int spread) {
  const auto slope = [&](int a, int b) {
    return 60.0 * static_cast<double>(a - b) / static_cast<double>(spread);
  };
  double hue = 0;
  if (color.r == largest) {
    hue = slope(color.g, color.b);
  } else if (color.g == largest) {
    hue = 120 + slope(color.b, color.r);
  } else {
    hue = 240 + slope(color.r, color.g);
  }
  return hue < 0 ? hue + 360 : hue;
}

/// Thesis facts, section 7: the closest hue within the tolerance; the program also checks the
/// saturation.
bool is_seen_as(Rgb color, ColorLabel wanted, const FloorModel& floor) {
  const int largest = std::max({color.r, color.g, color.b});
  const int spread = largest - std::min({color.r, color.g, color.b});
  if (spread == 0) return false;
  const double hue = hue_of(color, largest, spread);
  const double saturation = static_cast<double>(spread) / static_cast<double>(largest);
  std::optional<ColorLabel> closest;
  double least = floor.hue_tolerance_deg;
  for (const LabelSpec& label : floor.labels) {
    const double apart = std::fabs(hue - label.hue_deg);
    const double difference = floor.hue_wraps ? std::min(apart, 360 - apart) : apart;
    const bool like = std::fabs(saturation - label.saturation) < floor.saturation_tolerance;
    if (!like || difference >= least) continue;
    least = difference;
    closest = label.label;
  }
  return closest == wanted;
}

std::vector<ConditionTest> on_stripes(Module module, const std::vector<LabelSpec>& labels) {
  std::vector<ConditionTest> tests;
  for (const LabelSpec& label : labels) {
    const std::string name(name_of(label.label));
    tests.push_back({.module = module,
                     .trigger = Trigger::Label,
                     .gray = {},
                     .label = label.label,
                     .floor = name + " stripe",
                     .wanted = color_named(name),
                     .arena = arena_with_stripes(labels)});
  }
  return tests;
}

/// Walls, other robots, a light, and floor in three greys: in this arena a condition without its
/// own test can get readings from every sensor.
ConditionTest among_everything(Module module) {
  Arena arena = arena_with_disc(color_named("black"));
  arena.patches.push_back({Disc{.centre = {0.8, 0}, .radius_m = 0.3}, color_named("white")});
  arena.lights.push_back({.x_m = 1.226, .y_m = 0});
  return {.module = module,
          .trigger = Trigger::Readings,
          .gray = {},
          .floor = "any place",
          .arena = std::move(arena)};
}

ConditionTest on_disc(Module module, GrayRange gray, std::string_view color, std::string floor) {
  const Rgb wanted = color_named(color);
  return {.module = module,
          .trigger = Trigger::Gray,
          .gray = gray,
          .floor = std::move(floor),
          .wanted = wanted,
          .arena = arena_with_disc(wanted)};
}

/// The recorded readings of a robot in a cycle, with which a condition is evaluated again.
class RecordedSenses final : public Senses {
 public:
  explicit RecordedSenses(const Readings& readings) : readings_(readings) {}

  ProximityReadings proximity() override { return readings_.proximity_m; }
  const Rgb& ground_color() override { return readings_.ground_color; }
  std::span<const Neighbour> neighbours() override { return readings_.neighbours; }
  int neighbour_count() override { return readings_.neighbour_count; }
  LightReadings light() override { return readings_.light_lux; }
  double time_s() override {
    SWARMSMITH_ASSERT(false, "no condition asks for the time");
    return 0;
  }

 private:
  const Readings& readings_;
};

}  // namespace

std::vector<ConditionTest> tests_of(const ModuleSpec& spec, const Flavour& flavour) {
  using Tests = std::vector<ConditionTest>;
  const FloorModel& floor = flavour.floor;
  ConditionTest anywhere{
      .module = spec.module, .gray = {}, .floor = "base floor", .arena = dodecagon_of_the_thesis()};
  anywhere.wanted = anywhere.arena.floor;
  return std::visit(
      Overloaded{[&](const BlackFloor&) {
                   return Tests{on_disc(spec.module, floor.black, "black", "black spot")};
                 },
                 [&](const WhiteFloor&) {
                   return Tests{on_disc(spec.module, floor.white, "white", "white disc")};
                 },
                 [&](const GrayFloor&) {
                   ConditionTest test = on_disc(spec.module, floor.gray, "black", "base floor");
                   test.wanted = test.arena.floor;
                   return Tests{test};
                 },
                 [&](const ColorDetection&) { return on_stripes(spec.module, floor.labels); },
                 [&](const FixedProbability&) { return Tests{anywhere}; },
                 [&](const NeighbourCount&) {
                   anywhere.trigger = Trigger::Neighbours;
                   return Tests{anywhere};
                 },
                 [&](const InvertedNeighbourCount&) {
                   anywhere.trigger = Trigger::NeighboursInverted;
                   return Tests{anywhere};
                 },
                 [&](const auto&) { return Tests{among_everything(spec.module)}; }},
      swarmsmith::make_condition(spec.module, std::vector<double>(spec.parameters.size())));
}

bool satisfies(const ConditionTest& test, Rgb reading, const FloorModel& floor) {
  switch (test.trigger) {
    case Trigger::Gray: {
      const auto is_in = [&](int gray) { return test.gray.low <= gray && gray <= test.gray.high; };
      if (floor.any_channel)
        return is_in(1000 * reading.r) || is_in(1000 * reading.g) || is_in(1000 * reading.b);
      return is_in(299 * reading.r + 587 * reading.g + 114 * reading.b);
    }
    case Trigger::Label:
      return is_seen_as(reading, test.label, floor);
    case Trigger::Always:
    case Trigger::Neighbours:
    case Trigger::NeighboursInverted:
    case Trigger::Readings:
      break;
  }
  return true;
}

Condition make_condition(const ConditionTest& test, const ModuleSpec& spec,
                         const ConditionParameters& parameters) {
  std::vector<double> values;
  for (const ParameterSpec& parameter : spec.parameters) {
    if (parameter.name == "beta") {
      values.push_back(parameters.beta);
    } else if (parameter.name == "eta") {
      values.push_back(parameters.eta);
    } else if (parameter.name == "xi") {
      values.push_back(parameters.xi);
    } else if (parameter.name == "label") {
      values.push_back(static_cast<double>(test.label));
    } else {
      values.push_back(std::floor((parameter.low + parameter.high) / 2));
    }
  }
  return swarmsmith::make_condition(spec.module, values);
}

double due_probability(const ConditionTest& test, const Condition& condition, double probability,
                       const Readings& readings, const Flavour& flavour) {
  if (test.trigger == Trigger::Readings) {
    RecordedSenses senses(readings);
    return enabling_probability(condition, senses, flavour);
  }
  return satisfies(test, readings.ground_color, flavour.floor) ? probability : 0;
}

bool is_over_wanted(const ConditionTest& test, const Subject& subject, const Pose& pose) {
  const SinCos heading = sin_cos(pose.theta);
  const auto is_wanted = [&](const Point& place) {
    const Point seen = {pose.x + heading.cos * place.x - heading.sin * place.y,
                        pose.y + heading.sin * place.x + heading.cos * place.y};
    return floor_at(test.arena, seen) == test.wanted;
  };
  const std::vector<Point>& places = subject.robot.ground.places;
  return subject.flavour.floor.any_channel ? std::ranges::any_of(places, is_wanted)
                                           : std::ranges::all_of(places, is_wanted);
}

void for_each_cycle(const ConditionTest& test, const Machine& machine, const Subject& subject,
                    const std::function<void(const ObservedCycle&)>& tell) {
  const Mission mission = mission_in(test.arena, subject.robot);
  Sensors sensors = Sensor::GroundColor | Sensor::Neighbours;
  if (test.trigger == Trigger::Readings) sensors = sensors | Sensor::Proximity | Sensor::LightRing;
  for (int seed = 1; seed <= kConditionRuns; ++seed) {
    std::array<int, kRobots> states{};
    std::array<bool, kRobots> entered{};
    entered.fill(true);
    const auto observe = [&](const Snapshot& now) {
      if (now.cycle == 0) return;
      for (std::size_t i = 0; i < states.size(); ++i) {
        const RobotRecord& record = now.robots[i];
        const bool fired = record.state != states[i];
        tell({.seed = seed,
              .robot = static_cast<int>(i),
              .state = states[i],
              .tested = !entered[i],
              .fired = fired,
              .record = record});
        states[i] = record.state;
        entered[i] = fired;
      }
    };
    watch({machine, subject, mission}, starts_anywhere(mission, seed), seed,
          Recorder(observe, sensors));
  }
}

}  // namespace swarmsmith::assessment
