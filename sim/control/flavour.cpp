#include "sim/control/flavour.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

// Sources: "thesis" is the facts page on the thesis' text, "program" the one on the published
// implementation (rvr-automode). The search ranges are those of the program's irace file, 6.4.

namespace swarmsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLargestCount = 1'000'000;

using Type = ParameterSpec::Type;

/// Bound of a turn in cycles: 1..100 in the search.
ParameterSpec tau() {
  return {.name = "tau",
          .symbol = "RWM",
          .token = "rwm",
          .type = Type::Integer,
          .low = 1,
          .high = 100,
          .digits = 0,
          .least = 1,
          .most = kLargestCount};
}

/// Weight of the neighbours: 1..5 in the search, two decimals.
ParameterSpec alpha(std::string symbol, std::string token) {
  return {.name = "alpha",
          .symbol = std::move(symbol),
          .token = std::move(token),
          .type = Type::Real,
          .low = 1,
          .high = 5,
          .digits = 2,
          .least = 0,
          .most = kLargest,
          .least_included = false};
}

ParameterSpec beta() {
  return {.name = "beta",
          .symbol = "P",
          .token = "p",
          .type = Type::Real,
          .low = 0,
          .high = 1,
          .digits = 2,
          .least = 0,
          .most = 1};
}

/// The count at which the sigmoid is one half; the flavours search from different ends.
ParameterSpec xi(std::string symbol, int lowest) {
  return {.name = "xi",
          .symbol = std::move(symbol),
          .token = "p",
          .type = Type::Integer,
          .low = static_cast<double>(lowest),
          .high = 10,
          .digits = 0,
          .least = 0,
          .most = kLargestCount};
}

ParameterSpec eta(std::string symbol) {
  return {.name = "eta",
          .symbol = std::move(symbol),
          .token = "w",
          .type = Type::Real,
          .low = 0,
          .high = 20,
          .digits = 2,
          .least = 0,
          .most = kLargest};
}

ParameterSpec label() {
  return {.name = "label",
          .symbol = "L",
          .token = "l",
          .type = Type::Label,
          .low = 0,
          .high = 3,
          .digits = 0,
          .least = 0,
          .most = 3};
}

/// Program 5; the thesis names the same modules and gives no numbers.
std::vector<ModuleSpec> watermelon_behaviours() {
  return {{Module::Exploration, 0, {tau()}},
          {Module::Stop, 1, {}},
          {Module::Attraction, 2, {alpha("ATT", "att")}},
          {Module::Repulsion, 3, {alpha("REP", "rep")}}};
}

/// Program 6.1. `lowest_xi`: 0 in the thesis, 1 in the program (program 9, row 17).
std::vector<ModuleSpec> watermelon_conditions(int lowest_xi) {
  return {{Module::BlackFloor, 0, {beta()}},
          {Module::GrayFloor, 1, {beta()}},
          {Module::WhiteFloor, 2, {beta()}},
          {Module::NeighbourCount, 3, {xi("B", lowest_xi), eta("W")}},
          {Module::InvertedNeighbourCount, 4, {xi("BI", lowest_xi), eta("WI")}},
          {Module::FixedProbability, 5, {beta()}},
          {Module::ColorDetection, 6, {beta(), label()}}};
}

/// Program 6.1, labels; thesis 7 has the same hues.
std::vector<LabelSpec> watermelon_labels() {
  return {{ColorLabel::Green, 0, 120, 1},
          {ColorLabel::Blue, 1, 240, 1},
          {ColorLabel::Red, 2, 0, 1},
          {ColorLabel::Yellow, 3, 60, 1}};
}

Flavour make_watermelon() {
  return {.name = "watermelon",
          .behaviours = watermelon_behaviours(),
          .conditions = watermelon_conditions(0),
          .speed_mps = 0.30,                                        // thesis 5: V of the runs
          .obstacles = {.reading = ObstacleModel::Reading::Linear,  // thesis 5, table 5.1
                        .near_m = 0.05,
                        .far_m = 0.4,
                        .longest_sum = kInfinity,         // thesis 6: w_o is a plain sum
                        .neighbours_as_obstacles = true,  // thesis 6.2, after its 7.1
                        .neighbour_near_m = 0.275,        // thesis 6.2, the program's two distances
                        .neighbour_far_m = 0.55},
          .exploration = {.trigger = ExplorationModel::Trigger::FrontReadings,  // thesis 6.1
                          .threshold = 0.1,
                          .front_slope = 1,  // thesis 5: front is within 45 degrees
                          .turn_length = ExplorationModel::TurnLength::ZeroToTau},
          .neighbours = {.per_metre = 1,      // thesis 6.2: metres,
                         .shortest_m = 0.10,  // at least this in the quotient
                         .offset = 0,
                         .alpha_truncated = false,
                         .repulsion_power = 1,    // eq. 5.6
                         .attraction_gain = 1.2,  // k_w of eq. 5.5
                         .repulsion_gain = 1,     // thesis 14, row 7: no k_w in eq. 5.6
                         .obstacle_gain = 5,      // k_o of eq. 5.5, k of eq. 5.6
                         .forward_when_alone = true,
                         .shortest_result = 0.1},
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
          .behaviours = watermelon_behaviours(),
          .conditions = watermelon_conditions(1),
          .speed_mps = 0.30,                                                 // program 2
          .obstacles = {.reading = ObstacleModel::Reading::InverseDistance,  // program 4.1
                        .near_m = 0.05,                                      // the blind zone
                        .far_m = 0.4,
                        .longest_sum = 1,
                        // Program 4.1: the term exists, but compares centimetres with 0.55.
                        .neighbours_as_obstacles = false,
                        .neighbour_near_m = 0.275,
                        .neighbour_far_m = 0.55},
          .exploration = {.trigger = ExplorationModel::Trigger::VectorSum,  // program 5
                          .threshold = 0.1,
                          .front_slope = 0,  // not looked at: within 90 degrees
                          .turn_length = ExplorationModel::TurnLength::OneBelowTau},
          .neighbours = {.per_metre = 100,  // program 4.2: centimetres,
                         .shortest_m = 0,
                         .offset = 1,              // 1 + d
                         .alpha_truncated = true,  // program 5, as all below
                         .repulsion_power = 2,     // the parameter enters twice
                         .attraction_gain = 1.2,
                         .repulsion_gain = 1,
                         .obstacle_gain = 5,
                         .forward_when_alone = false,
                         .shortest_result = 0.1},
          // Program 6.1, of 255: at most 0.10; between 0.1 and 160, ends left out; 220 and more.
          .floor = {.black = {0, 100},
                    .gray = {101, 159'999},
                    .white = {220'000, 255'000},
                    .labels = watermelon_labels(),
                    .hue_tolerance_deg = 15,
                    .hue_wraps = false,
                    .saturation_tolerance = 0.2}};
}

const std::array<const Flavour*, 2>& all_flavours() {
  static const std::array<const Flavour*, 2> kAll = {&watermelon(), &watermelon_argos3()};
  return kAll;
}

/// A bound as people write it: 5, 0.5, 1000000.
std::string text_of(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> complaint_about(const ParameterSpec& parameter, double value) {
  if (parameter.type != Type::Real && value != std::floor(value)) {
    return parameter.name + " must be an integer";
  }
  const bool above = parameter.least_included ? value >= parameter.least : value > parameter.least;
  if (above && value <= parameter.most) return std::nullopt;
  std::string range = parameter.least_included ? "at least " : "more than ";
  range += text_of(parameter.least);
  if (parameter.most < kLargest) range += " and at most " + text_of(parameter.most);
  return parameter.name + " must be " + range;
}

const ModuleSpec* Flavour::find(Module module) const {
  for (const auto* table : {&behaviours, &conditions}) {
    for (const ModuleSpec& spec : *table) {
      if (spec.module == module) return &spec;
    }
  }
  return nullptr;
}

const Flavour& watermelon() {
  static const Flavour kFlavour = make_watermelon();
  return kFlavour;
}

const Flavour& watermelon_argos3() {
  static const Flavour kFlavour = make_watermelon_argos3();
  return kFlavour;
}

Expected<const Flavour*> find_flavour(std::string_view name) {
  std::string known;
  for (const Flavour* flavour : all_flavours()) {
    if (flavour->name == name) return flavour;
    known += (known.empty() ? "" : ", ") + flavour->name;
  }
  return unexpected(ErrorKind::NotFound,
                    "there is no flavour `" + std::string(name) + "`; known are: " + known);
}

}  // namespace swarmsmith
