#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/control/module.h"
#include "sim/control/readings.h"
#include "sim/control/reference_model.h"
#include "sim/control/treads.h"

namespace swarmsmith {

/// A flavour of the method as plain data: its modules, their numbers in the text grammar, the
/// ranges of their parameters, and the constants of the modules. The same code runs all flavours.
/// Each flavour is a file (flavour_file.h); the files of the built-in ones, sim/control/flavours,
/// give the source of each constant beside it.

/// Upper limits for the number of states of a flavour's machines and of transitions from each
/// state; the machines of the thesis have at most 4 of each (thesis 5.2).
inline constexpr int kMaxStates = 16;
inline constexpr int kMaxTransitions = 16;

/// One parameter of a module.
struct ParameterSpec {
  enum class Type { Integer, Real, Label };

  std::string name;    ///< as in the thesis: tau, alpha, beta, xi, eta, label
  std::string symbol;  ///< stem of irace's parameter name: RWM of RWM0, BI of BI0x3
  std::string token;   ///< stem of the switch: rwm of --rwm0, p of --p0x3
  Type type = Type::Real;
  /// Range of the search, both ends included; for a label, the range of its number.
  double low = 0;
  double high = 0;
  int digits = 0;  ///< decimals of a real parameter in the search
  /// Range of the values that a machine may have; wider than the range of the search.
  double least = 0;
  double most = 0;
  bool least_included = true;

  friend bool operator==(const ParameterSpec&, const ParameterSpec&) = default;
};

/// The parameters of a kind of module, with the ranges and names that a flavour uses unless it sets
/// others.
std::vector<ParameterSpec> parameters_of_kind(Module module);

/// The reason, as a sentence, why the parameter cannot have this value; nothing if it can.
std::optional<std::string> complaint_about(const ParameterSpec& parameter, double value);

/// A module in a flavour's tables, with its parameters in the order of `parameters_of`.
struct ModuleSpec {
  Module module = Module::Stop;
  std::string id;  ///< its name outside the program
  int number = 0;  ///< in the text grammar
  std::vector<ParameterSpec> parameters;

  friend bool operator==(const ModuleSpec&, const ModuleSpec&) = default;
};

/// The colours that ColorDetection can look for (thesis 5.2).
enum class ColorLabel { Green, Blue, Red, Yellow };

/// `green`, `blue`, `red` or `yellow`.
std::string_view name_of(ColorLabel label);

/// A colour label of the text grammar, with its hue and saturation.
struct LabelSpec {
  ColorLabel label = ColorLabel::Green;
  int number = 0;  ///< in the text grammar
  double hue_deg = 0;
  double saturation = 1;

  friend bool operator==(const LabelSpec&, const LabelSpec&) = default;
};

/// How distances become the vector of obstacles.
struct ObstacleModel {
  enum class Reading {
    Linear,           ///< 1 at `near_m` and closer, falling linearly to 0 at `far_m`
    InverseDistance,  ///< 1/d within [near_m, far_m], 0 outside: obstacles in contact are not seen
    AsSensed,         ///< the robot's sensors do not give a distance but a reading in [0, 1]
  };
  Reading reading = Reading::Linear;
  double near_m = kBlindZone_m;
  double far_m = kProximityRange_m;
  /// The vector sum of the sensors is shortened to this length; infinity: it is never shortened.
  double longest_sum = 1;
  /// A neighbour adds a reading: 1 at `neighbour_near_m`, 0 at `neighbour_far_m`.
  bool neighbours_as_obstacles = false;
  double neighbour_near_m = 0.275;
  double neighbour_far_m = 0.55;
  /// Directions assumed for the sensors, as unit vectors; without them, the RVR's ring. They belong
  /// to the robot, not to the flavour: code that runs a controller on another robot sets them.
  std::optional<RingDirections> directions;

  friend bool operator==(const ObstacleModel&, const ObstacleModel&) = default;
};

/// The unit in which a turn of Exploration is measured; the two differ when the control period
/// drifts.
enum class TurnClock {
  Cycles,   ///< r control cycles, where r is the drawn number
  Seconds,  ///< the duration of r nominal cycles, by the robot's clock (thesis eq. 7.1)
};

/// `cycles` or `seconds`.
std::string_view name_of(TurnClock clock);

struct ExplorationModel {
  enum class Trigger {
    FrontReadings,  ///< one reading of a front sensor is enough; turns away from the highest
    VectorSum,      ///< the sum of all readings points to the front; turns away from its side
    FrontThenSum,   ///< one reading of a front sensor is enough; turns away from the side of the
                    ///< sum of all
  };
  enum class TurnLength {
    ZeroToTau,    ///< uniform in 0..tau; 0: no turn
    OneBelowTau,  ///< uniform in 0..tau-1, but at least one cycle
  };
  Trigger trigger = Trigger::FrontReadings;
  TurnClock turn_clock = TurnClock::Cycles;
  double threshold = 0.1;
  /// The front: |y| <= front_slope * x for FrontReadings, x >= 0 for VectorSum.
  double front_slope = 1;
  TurnLength turn_length = TurnLength::ZeroToTau;
  double track_m = kTreadDistance_m;  ///< distance between the treads, used when random walks turn
                                      ///< by an angle

  friend bool operator==(const ExplorationModel&, const ExplorationModel&) = default;
};

/// w' of Attraction and Repulsion: the sum over the neighbours of alpha^power / (offset + d) in the
/// direction of each, times a gain.
struct NeighbourModel {
  double per_metre = 1;          ///< unit of d: 1 for metres, 100 for centimetres
  double shortest_m = 0;         ///< smaller distances count as this one
  double offset = 0;             ///< in units of d
  bool alpha_truncated = false;  ///< to an integer, each time it is used
  int repulsion_power = 1;
  double attraction_gain = 1;
  double repulsion_gain = 1;
  /// Counts are subtracted as unsigned integers: with more than xi neighbours, NeighbourCount is
  /// never enabled (epuck facts, 4.5).
  bool unsigned_count = false;

  friend bool operator==(const NeighbourModel&, const NeighbourModel&) = default;
};

/// w' of Phototaxis and Anti-phototaxis: the sum of the ring's readings, min(1, lux / full_lux)
/// each, in the directions of the sensors.
struct LightModel {
  double full_lux = 1000;     ///< illuminance that gives a reading of 1
  double least_vector = 0.1;  ///< a shorter sum does not count as light
  double least_reading = 0;   ///< at least one reading must be above this; 0: no such requirement
  bool unit_vector = false;   ///< the light is all or nothing: its vector has length 1
  std::optional<RingDirections> directions{};  ///< as in ObstacleModel

  friend bool operator==(const LightModel&, const LightModel&) = default;
};

/// How behaviours with a target steer: along w' - obstacle_gain * obstacles.
struct SteeringModel {
  double obstacle_gain = 5;
  double attraction_obstacle_gain = 5;  ///< obstacle gain of Attraction
  /// w' without a target (no neighbour, no light): (1, 0) if true, else zero.
  bool forward_by_default = true;
  /// If the result is shorter than this, the robot drives straight ahead.
  double shortest_result = 0.1;
  /// The inner tread runs at no less than this fraction of the speed.
  double least_inner = -1;

  friend bool operator==(const SteeringModel&, const SteeringModel&) = default;
};

/// Grey levels from `low` to `high`, both included, in thousandths of 0..255. The grey level is 299
/// R + 587 G + 114 B, an exact integer.
struct GrayRange {
  int low = 0;
  int high = 0;

  bool contains(int gray) const { return low <= gray && gray <= high; }
  friend bool operator==(const GrayRange&, const GrayRange&) = default;
};

struct FloorModel {
  GrayRange black;
  GrayRange gray;
  GrayRange white;
  std::vector<LabelSpec> labels;
  double hue_tolerance_deg = 15;  ///< the hue must differ from the label's hue by less than this
  bool hue_wraps = true;          ///< whether hues wrap around, so that 359 degrees is near 0
  /// The saturation must differ from the label's by less than this; infinity: saturation is
  /// ignored.
  double saturation_tolerance = 0;
  /// The three channels are the grey levels of three ground sensors, and one of them in the range
  /// is enough (epuck facts, section 5.2.1).
  bool any_channel = false;

  bool sees(const GrayRange& range, const Rgb& color) const {
    if (!any_channel) return range.contains(gray_level(color));
    return range.contains(1000 * color.r) || range.contains(1000 * color.g) ||
           range.contains(1000 * color.b);
  }
  friend bool operator==(const FloorModel&, const FloorModel&) = default;
};

struct Flavour {
  std::string name;
  /// The reference model that its modules read; control software of the flavour runs only on robots
  /// with this reference model.
  std::string reference{kRvrModel};
  int most_states = 4;       ///< most states of a machine
  int most_transitions = 4;  ///< most transitions from a state
  std::vector<ModuleSpec> behaviours;
  std::vector<ModuleSpec> conditions;
  double speed_mps = 0.30;
  ObstacleModel obstacles;
  ExplorationModel exploration;
  NeighbourModel neighbours;
  LightModel light;  ///< not used by a flavour without Phototaxis and Anti-phototaxis
  SteeringModel steering;
  FloorModel floor;

  /// The entry of a module in the tables, found by its kind or its id; null when the flavour does
  /// not have it.
  const ModuleSpec* find(Module module) const;
  const ModuleSpec* find(std::string_view id) const;

  friend bool operator==(const Flavour&, const Flavour&) = default;
};

/// The built-in flavour for the RVR that follows the thesis as written; its gaps are filled
/// according to thesis facts, sections 5 to 8 and 14.
const Flavour& watermelon();

/// The flavour of the program published with the thesis, defects included (rvr-automode facts,
/// sections 4 to 6).
const Flavour& watermelon_argos3();

/// Chocolate's modules on an RVR with a ring of light sensors (thesis facts, sections 6.1 and 7).
const Flavour& chocolate();

/// All built-in flavours, in the order in which they are listed.
std::span<const Flavour* const> all_flavours();

/// The built-in flavours for this reference model.
std::vector<const Flavour*> flavours_for(std::string_view reference);

/// Returns `own` if it is given, else the built-in flavour with this name; an unknown name is an
/// error that lists the known ones.
Expected<const Flavour*> find_flavour(std::string_view name, const Flavour* own = nullptr);

/// The same as a copy, with the turn clock that a method chose.
Expected<Flavour> find_flavour(std::string_view name, TurnClock turn_clock,
                               const Flavour* own = nullptr);

/// Keeps a custom flavour until the program ends, as the built-in ones are kept: pointers to it may
/// outlive the file that it was read from. Equal flavours are kept only once, so that equal
/// flavours have equal pointers. Null for a built-in flavour, for which the name is enough.
const Flavour* kept_flavour(Flavour flavour);

}  // namespace swarmsmith
