#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/film/boards.h"
#include "tests/support/film/clip.h"
#include "tests/support/film/scene.h"

namespace swarmsmith::film {

/// A laboratory as it truly is, beside what its people believe of it (the survey).

struct LabCamera {
  std::string name;
  View view;
};

struct LabRobot {
  std::string name;
  int tag = 0;
  double edge_m = 0.10;
  double height_m = 0.20;
  TagOffset offset;
  int second_tag = -1;  ///< behind the first, on a mast; -1: none
  double second_edge_m = 0.10;
  double second_height_m = 0.23;
  TagOffset second_offset;
};

struct Lab {
  ImageSize size{960, 540};
  std::vector<LabCamera> cameras;  ///< one over the middle, or two that see 60 % each
  std::vector<FilmedTag> references;
  std::vector<Pose> declared;  ///< of the references, as surveyed
  std::vector<LabRobot> robots;
  BoardKind board;
};

/// Lenses that laboratories have: about 90 degrees across, 65, and a fisheye of 140.
enum class LabLens { Wide, Narrow, Fisheye };

struct LabOptions {
  ImageSize size{960, 540};
  std::uint64_t seed = 1;
  int cameras = 1;
  int robots = 3;
  double survey_sigma_m = 0;     ///< of each coordinate of a reference tag
  LabLens lens = LabLens::Wide;  ///< of one camera
  bool chessboard = false;       ///< in place of a board with markers
  bool two_tags = false;         ///< on each robot
};

/// Lens, place, tags and offsets of a seed.
Lab lab_of(const LabOptions& options);

/// The arena file that its people would write.
std::string arena_toml(const Lab& lab, const Shooting& shooting);

/// What is true: {"cameras": [...], "references": [...], "robots": [...]}, numbers to the bit.
std::string truth_json(const Lab& lab);

/// The empty arena with the reference tags.
Scene empty_scene(const Lab& lab);
FilmedRobot filmed(const LabRobot& robot, Path path);
/// Its second tag alone, as a plate without a body.
FilmedRobot filmed_second(const LabRobot& robot, Path path);

/// A robot that turns on the spot for so long, while its treads creep.
Path spin_path(Point centre, double turns, double seconds, Point creep_m_s);
/// Straight ahead from a pose.
Path straight_path(const Pose& from, double length_m, double seconds);

}  // namespace swarmsmith::film
