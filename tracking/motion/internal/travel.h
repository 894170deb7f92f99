#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tracking/motion/resampling.h"

namespace swarmsmith {

/// Compares a robot's direction of travel with its heading. Treads cannot move sideways: the
/// midpoint between them always moves along the robot's heading. So the travel shows where a tag
/// really is on its robot, and when something else moved the robot.

/// The motion between two consecutive instants, in the axes of the measured pose half way.
struct TravelStep {
  double from_s = 0;
  double to_s = 0;
  double ahead_m = 0;  ///< along the measured heading
  double aside_m = 0;  ///< to its left
  double turn_rad = 0;
  double turn_sigma_rad = 0;
  double noise_m = 0;     ///< noise of the distance, one sigma
  double sigma_m = 0;     ///< error of interpolation, beyond the noise of a sample
  bool touches = false;   ///< the robot touches something, or did shortly before, and may slide
  bool is_steady = true;  ///< false when its speed changes, as its body may then slide
};

/// The position and direction of a tag, estimated from all free steps of a run. With a heading
/// error `turned`, each step fulfils aside * cos(turned) + ahead * sin(turned) = by_turn * turn.
/// `turned` and `by_turn` are fitted with weights that suppress single pushes. `by_turn` contains
/// the position of the measured point, and skids. If a robot only drives one and the same arc, the
/// two cannot be separated; then only the heading is fitted.
struct TravelFit {
  double way_m = 0;  ///< distance along the treads, without contacts
  bool knows_heading = false;
  double turned_rad = 0;  ///< measured minus true heading, if it mostly drives ahead
  double turned_sigma_rad = 0;
  double backward_share = 0;  ///< share of the distance, by the measured heading
  bool knows_by_turn = false;
  double by_turn_m = 0;
  double step_sigma_m = 0;  ///< one step's scatter to the side
  /// Position of the measured point relative to the point about which the robot turns on the spot,
  /// in the axes of the true heading.
  bool knows_place = false;
  double ahead_m = 0;
  double aside_m = 0;
  double place_sigma_m = 0;
  /// Distance to the side, divided by the distance ahead and by the turn, in one step. It is
  /// negative for bodies that skid in their old direction; no body skids in its new direction.
  double skid = 0;
  double skid_sigma = 0;  ///< 0 if not known
};
TravelFit fit_travel(std::span<const TravelStep> steps);

/// A period in which the robot moved farther sideways than noise and slip allow.
struct Slide {
  double from_s = 0;
  double to_s = 0;
  double aside_m = 0;
  double limit_m = 0;
};
/// The period that exceeds its limit most, or is nearest to it; periods of one second and of five
/// seconds are tried. Nothing without free steps.
std::optional<Slide> worst_slide(std::span<const TravelStep> steps, const TravelFit& fit);

}  // namespace swarmsmith
