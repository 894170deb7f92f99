#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

struct Flavour;
struct Machine;

/// Where everything of a drawn state machine stands on the page: circles are states, pointed boxes
/// conditions, each on the curve from its transition's source to its target. All pictures of a
/// machine are written from this one layout. Lengths are mm.

/// One line of text, centred on `at`, which is on the base line.
struct LabelLine {
  PagePoint at;
  std::string text;
  double size = 0;
  bool is_name = false;  ///< of a module, else its parameters
};

struct StateShape {
  PagePoint centre;
  double radius = 0;
  bool initial = false;
  bool reachable = true;  ///< else it is grey, with all that leaves it
  std::vector<LabelLine> lines;
};

struct ConditionShape {
  std::size_t source = 0;  ///< indices of states
  std::size_t target = 0;
  PagePoint centre;
  double width = 0;  ///< of the box with its points
  double height = 0;
  std::vector<LabelLine> lines;
  /// Quadratic Bezier curve from the source's circle to the arrow head: begin, control, end.
  std::array<PagePoint, 3> curve;
  std::array<PagePoint, 3> head;  ///< corners of the arrow head; the first is its tip
};

struct MachineLayout {
  double width = 0;
  double height = 0;
  std::vector<StateShape> states;          ///< in the machine's order
  std::vector<ConditionShape> conditions;  ///< by source, then in the order of its transitions
  std::vector<LabelLine> notes;            ///< at the foot: what grey means, where there is some
};

/// How far the points of a condition's box reach beyond its text.
inline constexpr double kBoxPoint = 1.5;
/// Distance of the two circles of the initial state.
inline constexpr double kInitialRing = 0.8;

/// The box's corners, from the left point clockwise.
std::array<PagePoint, 6> corners_of(const ConditionShape& shape);

/// Narrower pages hold no two states beside a condition.
inline constexpr double kNarrowestMachine_mm = 60;

/// One state stands in the middle, two in a row, three in a triangle, four in a rectangle with the
/// least busy pairs across, more on an ellipse; state 0 comes first. Conditions stand near the
/// middle of their edges, moved until neither boxes nor states overlap and as few curves as
/// possible cross or pass under a box, in a fixed number of steps. The height follows. A pure
/// function.
///
/// Throws std::invalid_argument when the machine has no state, a transition leads nowhere or back
/// to its own state, a module is none of the flavour's, or the page is narrower than
/// `kNarrowestMachine_mm`.
MachineLayout lay_out(const Machine& machine, const Flavour& flavour, double width_mm);

}  // namespace swarmsmith
