#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

struct Flavour;
struct Machine;

/// Positions of all parts of a drawn state machine: circles are states; pointed boxes are
/// conditions, each on the curve from its transition's source to its target. All formats of a
/// machine's picture are written from this layout. Lengths are mm.

/// One line of text, centred on `at`, which is on the baseline.
struct LabelLine {
  PagePoint at;
  std::string text;
  double size = 0;
  bool is_name = false;  ///< a module's name, else its parameters
};

struct StateShape {
  PagePoint centre;
  double radius = 0;
  bool initial = false;
  bool reachable = true;  ///< if not, the state and its transitions are grey
  std::vector<LabelLine> lines;
};

struct ConditionShape {
  std::size_t source = 0;  ///< index of a state
  std::size_t target = 0;
  PagePoint centre;
  double width = 0;  ///< of the box with its points
  double height = 0;
  std::vector<LabelLine> lines;
  /// Quadratic Bezier curve from the source's circle to the arrow head: start, control point, end.
  std::array<PagePoint, 3> curve;
  std::array<PagePoint, 3> head;  ///< corners of the arrow head; the first is its tip
};

struct MachineLayout {
  double width = 0;
  double height = 0;
  std::vector<StateShape> states;          ///< in the machine's order
  std::vector<ConditionShape> conditions;  ///< ordered by source, then as in the machine
  std::vector<LabelLine> notes;            ///< at the bottom: the meaning of grey, if there is any
};

/// How far the points of a condition's box extend beyond its text.
inline constexpr double kBoxPoint = 1.5;
/// The distance between the two circles of the initial state.
inline constexpr double kInitialRing = 0.8;

/// The box's corners, clockwise from the left point.
std::array<PagePoint, 6> corners_of(const ConditionShape& shape);

/// A narrower page has no room for two states and a condition side by side.
inline constexpr double kNarrowestMachine_mm = 60;

/// Computes the layout. One state is in the middle; two states are in a row, three in a triangle,
/// four in a rectangle with the least busy pairs on the diagonals, more on an ellipse; state 0
/// comes first. Conditions are near the middle of their edges, moved until boxes and states do not
/// overlap and as few curves as possible cross or pass under a box, in a fixed number of steps. The
/// height follows from the width. A pure function.
///
/// Throws std::invalid_argument if the machine has no state, a transition leads nowhere or back to
/// its own state, a module does not belong to the flavour, or the page is narrower than
/// `kNarrowestMachine_mm`.
MachineLayout lay_out(const Machine& machine, const Flavour& flavour, double width_mm);

}  // namespace swarmsmith
