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
/// ranges of their parameters, and the constants that say what a module does. One code runs all
/// flavours. Each is a file (flavour_file.h); where the value of a constant comes from stands
/// beside it in the built-in ones, sim/control/flavours.

/// A flavour's machines have up to so many states, and transitions from each; those of the thesis
/// have 4 (thesis 5.2).
inline constexpr int kMaxStates = 16;
inline constexpr int kMaxTransitions = 16;

/// One parameter of a module.
struct ParameterSpec {
  enum class Type { Integer, Real, Label };

  std::string name;    ///< as in the thesis: tau, alpha, beta, xi, eta, label
  std::string symbol;  ///< stem of irace's parameter name: RWM of RWM0, BI of BI0x3
  std::string token;   ///< stem of the switch: rwm of --rwm0, p of --p0x3
  Type type = Type::Real;
  /// Range of the search, both ends included; of a label, of its number.
  double low = 0;
  double high = 0;
  int digits = 0;  ///< decimals of a real in the search
  /// What a machine may hold at all, wider than the search.
  double least = 0;
  double most = 0;
  bool least_included = true;

  friend bool operator==(const ParameterSpec&, const ParameterSpec&) = default;
};

/// What a kind of module takes as parameters, with what a flavour has for them unless it says
/// otherwise.
std::vector<ParameterSpec> parameters_of_kind(Module module);

/// Why `value` cannot be the parameter's value, as a sentence; nothing when it can.
std::optional<std::string> complaint_about(const ParameterSpec& parameter, double value);

/// A module in a flavour's tables, with its parameters in the order of `parameters_of`.
struct ModuleSpec {
  Module module = Module::Stop;
  std::string id;  ///< its name outside of the program
  int number = 0;  ///< in the text grammar
  std::vector<ParameterSpec> parameters;

  friend bool operator==(const ModuleSpec&, const ModuleSpec&) = default;
};

/// The colours that ColorDetection can look for (thesis 5.2).
enum class ColorLabel { Green, Blue, Red, Yellow };

/// `green`, `blue`, `red` or `yellow`.
std::string_view name_of(ColorLabel label);

/// A colour of the text grammar and the hue and saturation it stands for.
struct LabelSpec {
  ColorLabel label = ColorLabel::Green;
  int number = 0;  ///< in the text grammar
  double hue_deg = 0;
  double saturation = 1;

  friend bool operator==(const LabelSpec&, const LabelSpec&) = default;
};

/// From distances to the vector of obstacles.
struct ObstacleModel {
  enum class Reading {
    Linear,           ///< 1 at `near_m` and closer, falling to 0 at `far_m`
    InverseDistance,  ///< 1/d within [near_m, far_m], nothing outside: blind when touching
    AsSensed,         ///< the robot's sensors give no distance but a reading in [0, 1]
  };
  Reading reading = Reading::Linear;
  double near_m = kBlindZone_m;
  double far_m = kProximityRange_m;
  /// The vector sum of the sensors is shortened to this length; infinity for never.
  double longest_sum = 1;
  /// A neighbour gives a reading of its own, 1 at `neighbour_near_m` and 0 at `neighbour_far_m`.
  bool neighbours_as_obstacles = false;
  double neighbour_near_m = 0.275;
  double neighbour_far_m = 0.55;
  /// What the sensors are taken for, unit vectors; nothing: the RVR's ring. A robot's, not a
  /// flavour's: code that runs a controller on another robot sets them.
  std::optional<RingDirections> directions;

  friend bool operator==(const ObstacleModel&, const ObstacleModel&) = default;
};

/// What a turn of Exploration is measured in; the two differ where the control period drifts.
enum class TurnClock {
  Cycles,   ///< r control cycles, r the drawn number
  Seconds,  ///< the time of r nominal cycles, by the robot's clock (thesis eq. 7.1)
};

/// `cycles` or `seconds`.
std::string_view name_of(TurnClock clock);

struct ExplorationModel {
  enum class Trigger {
    FrontReadings,  ///< one reading of the front is enough; away from the highest
    VectorSum,      ///< the sum of all readings points to the front; away from its side
    FrontThenSum,   ///< one reading of the front is enough; away from the side of the sum of all
  };
  enum class TurnLength {
    ZeroToTau,    ///< uniform in 0..tau; 0: no turn
    OneBelowTau,  ///< uniform in 0..tau-1, but at least one cycle
  };
  Trigger trigger = Trigger::FrontReadings;
  TurnClock turn_clock = TurnClock::Cycles;
  double threshold = 0.1;
  /// Front of FrontReadings: |y| <= front_slope * x; of VectorSum: x >= 0.
  double front_slope = 1;
  TurnLength turn_length = TurnLength::ZeroToTau;
  double track_m = kTreadDistance_m;  ///< from tread to tread, for random walks' turns by an angle

  friend bool operator==(const ExplorationModel&, const ExplorationModel&) = default;
};

/// w' of Attraction and Repulsion: the sum of alpha^power / (offset + d) in each neighbour's
/// direction, times a gain.
struct NeighbourModel {
  double per_metre = 1;          ///< unit of d: 1 metres, 100 centimetres
  double shortest_m = 0;         ///< a smaller distance counts as this one
  double offset = 0;             ///< in units of d
  bool alpha_truncated = false;  ///< to an integer, whenever it is used
  int repulsion_power = 1;
  double attraction_gain = 1;
  double repulsion_gain = 1;
  /// Counts are subtracted without a sign: more neighbours than xi are as if there were none
  /// (epuck facts, 4.5).
  bool unsigned_count = false;

  friend bool operator==(const NeighbourModel&, const NeighbourModel&) = default;
};

/// w' of Phototaxis and Anti-phototaxis: the sum of the ring's readings, each min(1, lux /
/// full_lux), in their directions.
struct LightModel {
  double full_lux = 1000;     ///< a reading of 1
  double least_vector = 0.1;  ///< a shorter sum is not light
  double least_reading = 0;   ///< and no reading above this; 0: whatever the readings
  bool unit_vector = false;   ///< the light is all or nothing: of length 1
  std::optional<RingDirections> directions{};  ///< as those of ObstacleModel

  friend bool operator==(const LightModel&, const LightModel&) = default;
};

/// Where a behaviour goes that has something to follow: along w' - obstacle_gain * obstacles.
struct SteeringModel {
  double obstacle_gain = 5;
  double attraction_obstacle_gain = 5;  ///< of Attraction
  /// Without anything to follow (no neighbour, no light), w' is (1, 0); else it is zero.
  bool forward_by_default = true;
  /// A shorter result means straight ahead.
  double shortest_result = 0.1;
  /// The tread on the near side runs at no less than this part of the speed.
  double least_inner = -1;

  friend bool operator==(const SteeringModel&, const SteeringModel&) = default;
};

/// Grey levels from `low` to `high`, both included, in thousandths of 0..255: the grey level is
/// 299 R + 587 G + 114 B, an exact integer.
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
  double hue_tolerance_deg = 15;  ///< a label's hue differs by less
  bool hue_wraps = true;          ///< 359 degrees is near to 0
  /// A label's saturation differs by less; infinity for not looked at.
  double saturation_tolerance = 0;
  /// The three channels are grey levels of three ground sensors, and it is enough that one of them
  /// is in a range (epuck facts, section 5.2.1).
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
  /// The reference model that its modules read; control software of the flavour runs on robots with
  /// this one alone.
  std::string reference{kRvrModel};
  int most_states = 4;       ///< of a machine
  int most_transitions = 4;  ///< from a state
  std::vector<ModuleSpec> behaviours;
  std::vector<ModuleSpec> conditions;
  double speed_mps = 0.30;
  ObstacleModel obstacles;
  ExplorationModel exploration;
  NeighbourModel neighbours;
  LightModel light;  ///< of no meaning to a flavour without the two phototaxes
  SteeringModel steering;
  FloorModel floor;

  /// The entry of a module in the tables, by its kind or its id, or null when the flavour lacks it.
  const ModuleSpec* find(Module module) const;
  const ModuleSpec* find(std::string_view id) const;

  friend bool operator==(const Flavour&, const Flavour&) = default;
};

/// The built-in ones that the RVR has. The thesis as written, its silent points decided (thesis
/// facts, sections 5 to 8 and 14).
const Flavour& watermelon();

/// The program published with the thesis, defects included (rvr-automode facts, sections 4 to 6).
const Flavour& watermelon_argos3();

/// Chocolate's modules on an RVR with a ring of light sensors (thesis facts, sections 6.1 and 7).
const Flavour& chocolate();

/// All that are built in, in the order of their listing.
std::span<const Flavour* const> all_flavours();

/// Those of them whose reference model this is.
std::vector<const Flavour*> flavours_for(std::string_view reference);

/// `own`, or without it the built-in flavour with this name; an unknown name is an error that lists
/// the known ones.
Expected<const Flavour*> find_flavour(std::string_view name, const Flavour* own = nullptr);

/// The same as a value of one's own, with the turn clock that a method chose.
Expected<Flavour> find_flavour(std::string_view name, TurnClock turn_clock,
                               const Flavour* own = nullptr);

/// A flavour of one's own, kept until the program ends as the built-in ones are: what refers to it
/// may outlive the file that it was read from. Equal flavours are kept once, so that pointers are
/// equal where flavours are; null for one that is built in, whose name is enough.
const Flavour* kept_flavour(Flavour flavour);

}  // namespace swarmsmith
