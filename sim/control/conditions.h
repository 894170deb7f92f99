#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/control/module.h"
#include "sim/control/reference_model.h"

namespace swarmsmith {

struct Flavour;

/// Conditions, one a transition of the machine. A condition says with which probability its
/// transition is enabled in this cycle; which readings it accepts is the flavour's data. Sources:
/// thesis facts, section 7, and rvr-automode facts, section 6.1.

/// The colours that ColorDetection can look for (thesis 5.2).
enum class ColorLabel { Green, Blue, Red, Yellow };

/// `green`, `blue`, `red` or `yellow`.
std::string_view name_of(ColorLabel label);

/// The floor's grey level is low.
struct BlackFloor {
  double probability = 0;  ///< beta, in [0, 1]

  friend bool operator==(const BlackFloor&, const BlackFloor&) = default;
};

/// The floor's grey level is in the middle.
struct GrayFloor {
  double probability = 0;  ///< beta, in [0, 1]

  friend bool operator==(const GrayFloor&, const GrayFloor&) = default;
};

/// The floor's grey level is high.
struct WhiteFloor {
  double probability = 0;  ///< beta, in [0, 1]

  friend bool operator==(const WhiteFloor&, const WhiteFloor&) = default;
};

/// Always, with probability z(n) = 1 / (1 + e^(eta (xi - n))) for n neighbours (thesis eq. 5.7).
struct NeighbourCount {
  double eta = 0;  ///< steepness, 0..20 in the search
  int xi = 0;      ///< the count with probability one half

  friend bool operator==(const NeighbourCount&, const NeighbourCount&) = default;
};

/// Always, with probability 1 - z(n).
struct InvertedNeighbourCount {
  double eta = 0;  ///< steepness, 0..20 in the search
  int xi = 0;      ///< the count with probability one half

  friend bool operator==(const InvertedNeighbourCount&, const InvertedNeighbourCount&) = default;
};

/// Always.
struct FixedProbability {
  double probability = 0;  ///< beta, in [0, 1]

  friend bool operator==(const FixedProbability&, const FixedProbability&) = default;
};

/// The floor's colour is perceived as the label.
struct ColorDetection {
  double probability = 0;  ///< beta, in [0, 1]
  ColorLabel label = ColorLabel::Green;

  friend bool operator==(const ColorDetection&, const ColorDetection&) = default;
};

using Condition = std::variant<BlackFloor, GrayFloor, WhiteFloor, NeighbourCount,
                               InvertedNeighbourCount, FixedProbability, ColorDetection>;

Module module_of(const Condition& condition);

/// The parameters' values, in the order of the flavour's table; a label as its enumerator's index.
std::vector<double> parameters_of(const Condition& condition);

/// The inverse of the two above. Throws std::invalid_argument when `module` is no condition or the
/// number of parameters is another.
Condition make_condition(Module module, std::span<const double> parameters);

/// Probability with which the condition enables its transition in this cycle; 0 when the reading
/// is not the one it waits for. Asks `senses` only for what it needs.
double enabling_probability(const Condition& condition, Senses& senses, const Flavour& flavour);

/// z(n) of the neighbour counts (thesis eq. 5.7).
double neighbour_sigmoid(double eta, int xi, int neighbours);

}  // namespace swarmsmith
