#pragma once

#include <string>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/solid.h"
#include "sim/robot/rvr.h"

namespace swarmsmith {

/// A robot in a picture, over a period of time.
struct PicturedRobot {
  std::vector<Pose> poses;  ///< instant by instant; a single pose gives a picture of that instant
  std::string label;        ///< its activity at the last instant, such as the name of its behaviour

  friend bool operator==(const PicturedRobot&, const PicturedRobot&) = default;
};

/// An arena from above, with the robots and objects that move in it.
struct ArenaPicture {
  std::string title;  ///< first line, bold: the mission
  std::vector<std::string>
      details;  ///< below the title, on as many lines as needed: candidate, seed, score, times
  Arena arena;  ///< with the patches of the run
  Outline body = BoxOutline{kBodySide_m, kBodySide_m};  ///< of each robot
  std::vector<PicturedRobot> robots;
  std::vector<std::vector<Pose>>
      objects;  ///< poses of each object of the arena, with the same instants as for robots
  /// Number of cycles between the dots on the trails, which are labelled with their times. Trails
  /// are then drawn on top of the robots at their ends. 0: no dots. Large swarms have no dots
  /// either.
  int cycles_a_mark = 0;
  double width_mm = 84;  ///< the column width of a paper; the height follows from it
};

/// The minimum and maximum width of pictures, mm.
inline constexpr double kLeastPictureWidth_mm = 40;
inline constexpr double kMostPictureWidth_mm = 1000;

/// The picture as SVG (docs/trajectories.md, "Pictures"). The floor is drawn lighter than in the
/// arena, so that trails are visible on it. A trail becomes stronger towards its end. Robots are
/// filled at the end of the period and outlined at its start, with a mark at their fronts.
std::string draw(const ArenaPicture& picture);

}  // namespace swarmsmith
