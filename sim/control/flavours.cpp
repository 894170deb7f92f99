#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"
#include "sim/control/flavour.h"

// Sources: "thesis" and "program" with a number are sections of the thesis facts and of the
// rvr-automode facts (docs/reference); "its 7.1" and equations have the thesis' own numbers.

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// rvr-automode facts, section 6.1; thesis facts, section 7, have the same hues.
std::vector<LabelSpec> watermelon_labels() {
  return {{ColorLabel::Green, 0, 120, 1},
          {ColorLabel::Blue, 1, 240, 1},
          {ColorLabel::Red, 2, 0, 1},
          {ColorLabel::Yellow, 3, 60, 1}};
}

/// The conditions with another least xi of the search.
std::vector<ModuleSpec> with_least_xi(std::vector<ModuleSpec> conditions, double least) {
  for (ModuleSpec& condition : conditions) {
    for (ParameterSpec& parameter : condition.parameters) {
      if (parameter.name == "xi") parameter.low = least;
    }
  }
  return conditions;
}

Flavour make_watermelon() {
  return {.name = "watermelon",
          .behaviours = behaviours_of("watermelon"),
          .conditions = conditions_of("watermelon"),
          .speed_mps = 0.30,                                        // thesis 5: V of the runs
          .obstacles = {.reading = ObstacleModel::Reading::Linear,  // thesis 5, table 5.1
                        .near_m = kBlindZone_m,
                        .far_m = kProximityRange_m,
                        .longest_sum = kInfinity,         // thesis 6: w_o is a plain sum
                        .neighbours_as_obstacles = true,  // thesis 6.2, after its 7.1
                        .neighbour_near_m = 0.275,        // thesis 6.2, the program's two distances
                        .neighbour_far_m = 0.55},
          .exploration = {.trigger = ExplorationModel::Trigger::FrontReadings,  // thesis 6.1
                          .turn_clock = TurnClock::Cycles,                      // thesis 6.3
                          .threshold = 0.1,
                          .front_slope = 1,  // thesis 5: front is within 45 degrees
                          .turn_length = ExplorationModel::TurnLength::ZeroToTau},
          .neighbours = {.per_metre = 1,      // thesis 6.2: metres,
                         .shortest_m = 0.10,  // at least this in the quotient
                         .offset = 0,
                         .alpha_truncated = false,
                         .repulsion_power = 1,      // eq. 5.6
                         .attraction_gain = 1.2,    // k_w of eq. 5.5
                         .repulsion_gain = 1},      // thesis 14, row 7: no k_w in eq. 5.6
          .steering = {.obstacle_gain = 5,          // k_o of eq. 5.5, k of eq. 5.6
                       .forward_by_default = true,  // thesis 6
                       .shortest_result = 0.1},     // thesis 6.2
          // Thesis 7, of 255,000: below 0.05; 0.5 +- 0.13, ends included; above 0.78.
          .floor = {.black = {0, 12'749},
                    .gray = {94'350, 160'650},
                    .white = {198'901, 255'000},
                    .labels = watermelon_labels(),
                    .hue_tolerance_deg = 15,  // thesis 7: under 15 degrees, circular, hue alone
                    .hue_wraps = true,
                    .saturation_tolerance = kInfinity}};
}

Flavour make_watermelon_argos3() {
  return {.name = "watermelon-argos3",
          .behaviours = behaviours_of("watermelon-argos3"),
          // Program 9, row 17: from 1, the thesis from 0.
          .conditions = with_least_xi(conditions_of("watermelon-argos3"), 1),
          .speed_mps = 0.30,                                                 // program 2
          .obstacles = {.reading = ObstacleModel::Reading::InverseDistance,  // program 4.1
                        .near_m = kBlindZone_m,
                        .far_m = kProximityRange_m,
                        .longest_sum = 1,
                        // Program 4.1: the term exists, but compares centimetres with 0.55.
                        .neighbours_as_obstacles = false,
                        .neighbour_near_m = 0.275,
                        .neighbour_far_m = 0.55},
          .exploration = {.trigger = ExplorationModel::Trigger::VectorSum,  // program 5
                          .turn_clock = TurnClock::Cycles,  // program 9, row 19: in simulation
                          .threshold = 0.1,
                          .front_slope = 0,  // not looked at: within 90 degrees
                          .turn_length = ExplorationModel::TurnLength::OneBelowTau},
          .neighbours = {.per_metre = 100,  // program 4.2: centimetres,
                         .shortest_m = 0,
                         .offset = 1,              // 1 + d
                         .alpha_truncated = true,  // program 5, as all below
                         .repulsion_power = 2,     // the parameter enters twice
                         .attraction_gain = 1.2,
                         .repulsion_gain = 1},
          .steering = {.obstacle_gain = 5, .forward_by_default = false, .shortest_result = 0.1},
          // Program 6.1, of 255: at most 0.10; between 0.1 and 160, ends left out; 220 and more.
          .floor = {.black = {0, 100},
                    .gray = {101, 159'999},
                    .white = {220'000, 255'000},
                    .labels = watermelon_labels(),
                    .hue_tolerance_deg = 15,
                    .hue_wraps = false,
                    .saturation_tolerance = 0.2}};
}

/// The modules of Chocolate, and Vanilla, on the RVR: the thesis' equations 5.1 to 5.4; what these
/// leave open is as in `watermelon`.
Flavour make_chocolate() {
  Flavour flavour = make_watermelon();
  flavour.name = "chocolate";
  flavour.behaviours = behaviours_of(flavour.name);
  flavour.conditions = conditions_of(flavour.name);
  flavour.obstacles.neighbours_as_obstacles = false;        // thesis 6.1
  flavour.neighbours.attraction_gain = 1;                   // eq. 5.3 has no k_w
  flavour.light = {.full_lux = 1000, .least_vector = 0.1};  // thesis 6.1; 14, row 11
  flavour.steering.obstacle_gain = 5;                       // k of eq. 5.1 to 5.4
  // Thesis 6.1, the e-puck's thresholds, of 255,000: at most 0.1; between; 0.95 and more.
  flavour.floor = {
      .black = {0, 25'500}, .gray = {25'501, 242'249}, .white = {242'250, 255'000}, .labels = {}};
  return flavour;
}

Flavour make_chocolate_epuck() {
  Flavour flavour = make_chocolate();
  flavour.name = "chocolate-epuck";
  flavour.conditions = with_least_xi(flavour.conditions, 1);  // e-puck 4.6
  flavour.speed_mps = 0.12;                                   // e-puck 4.1
  flavour.obstacles = {.reading = ObstacleModel::Reading::Strength,
                       .longest_sum = 1,
                       .neighbours_as_obstacles = false};
  flavour.exploration = {.trigger = ExplorationModel::Trigger::VectorSum,  // e-puck 4.4
                         .turn_clock = TurnClock::Cycles,
                         .threshold = 0.1,
                         .front_slope = 0,
                         .turn_length = ExplorationModel::TurnLength::OneBelowTau};
  flavour.neighbours = {.per_metre = 100,  // e-puck 4.1: alpha / (1 + cm),
                        .shortest_m = -1,  // of the gap between two bodies, which may be negative
                        .offset = 1,
                        .alpha_truncated = true,
                        .repulsion_power = 2,
                        .attraction_gain = 1,
                        .repulsion_gain = 1};
  flavour.light = {.law = LightModel::Law::AllOrNothing, .least_reading = 0.2, .least_vector = 0.1};
  flavour.steering = {.obstacle_gain = 5,
                      .attraction_obstacle_gain = 6,
                      .forward_by_default = false,
                      .shortest_result = 0.1};
  return flavour;
}

}  // namespace

const Flavour& watermelon() {
  static const Flavour kFlavour = make_watermelon();
  return kFlavour;
}

const Flavour& watermelon_argos3() {
  static const Flavour kFlavour = make_watermelon_argos3();
  return kFlavour;
}

const Flavour& chocolate() {
  static const Flavour kFlavour = make_chocolate();
  return kFlavour;
}

const Flavour& chocolate_epuck() {
  static const Flavour kFlavour = make_chocolate_epuck();
  return kFlavour;
}

std::span<const Flavour* const> all_flavours() {
  static const std::array<const Flavour*, 4> kAll = {&watermelon(), &watermelon_argos3(),
                                                     &chocolate(), &chocolate_epuck()};
  return kAll;
}

}  // namespace swarmsmith
