#pragma once

#include <string>
#include <vector>

#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/mission/solid.h"
#include "sim/robot/rvr.h"

namespace swarmsmith {

/// A robot of a picture, through a span of time.
struct PicturedRobot {
  std::vector<Pose> poses;  ///< instant by instant; one makes a picture of that instant
  std::string label;        ///< what it does at the last one, such as its behaviour's name

  friend bool operator==(const PicturedRobot&, const PicturedRobot&) = default;
};

/// An arena from above, with what moves in it.
struct ArenaPicture {
  std::string title;                 ///< first line, bold: the mission
  std::vector<std::string> details;  ///< below it, on as many lines as they need: candidate, seed,
                                     ///< score, times
  Arena arena;                       ///< with the patches of the run
  Outline body = BoxOutline{kBodySide_m, kBodySide_m};  ///< of each robot
  std::vector<PicturedRobot> robots;
  std::vector<std::vector<Pose>> objects;  ///< poses of each of the arena's objects, as of robots
  /// Dots with their time on the trails, so many cycles apart, and trails over the robots at their
  /// ends; 0: none. Of a large swarm none either.
  int cycles_a_mark = 0;
  double width_mm = 84;  ///< a column of a paper; the height follows
};

/// The narrowest and widest pictures that are drawn, mm.
inline constexpr double kLeastPictureWidth_mm = 40;
inline constexpr double kMostPictureWidth_mm = 1000;

/// The picture as SVG (docs/trajectories.md, "Pictures"). The floor is lighter than in the arena,
/// so that trails are seen on it. A trail grows stronger towards its end; robots are solid at the
/// end of the span and hollow at its start, with a mark at their heads.
std::string draw(const ArenaPicture& picture);

}  // namespace swarmsmith
