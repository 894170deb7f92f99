#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tracking/motion/resampling.h"

namespace swarmsmith {

/// How a robot travels against how it heads. Treads cannot go sideways: whatever they do, the
/// middle between them moves along the robot's heading. So travel tells where a tag really sits,
/// and when something else moved the robot.

/// One step from an instant to the next, in the axes of the measured pose half way.
struct TravelStep {
  double from_s = 0;
  double to_s = 0;
  double ahead_m = 0;  ///< along the measured heading
  double aside_m = 0;  ///< to its left
  double turn_rad = 0;
  double turn_sigma_rad = 0;
  double noise_m = 0;     ///< of the way, one sigma
  double sigma_m = 0;     ///< of what is interpolated, beyond a sample's noise
  bool touches = false;   ///< a wall, an obstacle or a robot, or just did, and may slide from it
  bool is_steady = true;  ///< neither gains nor loses speed, when a body slides over its treads
};

/// What all of a run's free steps say of a tag. A heading that is off by `turned`, and what goes
/// with each turn, move so in each step: aside * cos(turned) + ahead * sin(turned) = by_turn *
/// turn. Both are fitted with weights that leave single pushes out. What goes with turns is the
/// place of the measured point, and skids. A robot that drives one and the same arc leaves open
/// which it is: then the heading is fitted alone.
struct TravelFit {
  double way_m = 0;  ///< along the treads, without touch
  bool knows_heading = false;
  double turned_rad = 0;  ///< the measured heading minus the true one, if it drives ahead mostly
  double turned_sigma_rad = 0;
  double backward_share = 0;  ///< of the way, by the measured heading
  bool knows_by_turn = false;
  double by_turn_m = 0;
  double step_sigma_m = 0;  ///< of one step to the side
  /// Of the measured point, from where the robot turns about on the spot, by the true heading.
  bool knows_place = false;
  double ahead_m = 0;
  double aside_m = 0;
  double place_sigma_m = 0;
  /// How far it goes to the side, over how far ahead and by how much it turns, in one step: below 0
  /// for bodies that skid out of their old direction. None skids into its new one.
  double skid = 0;
  double skid_sigma = 0;  ///< 0 when it is not known
};
TravelFit fit_travel(std::span<const TravelStep> steps);

/// A stretch in which the robot went sideways more than noise and slip allow.
struct Slide {
  double from_s = 0;
  double to_s = 0;
  double aside_m = 0;
  double limit_m = 0;
};
/// The stretch that is furthest beyond its limit, or nearest to it; over a second and over five.
/// Nothing without free steps.
std::optional<Slide> worst_slide(std::span<const TravelStep> steps, const TravelFit& fit);

}  // namespace swarmsmith
