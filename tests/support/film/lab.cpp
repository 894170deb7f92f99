#include "tests/support/film/lab.h"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/math.h"

namespace swarmsmith::film {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// What a camera is made of, and how high it hangs to see the arena.
struct LensKind {
  double focal_share;  ///< of the image's width
  double k1;
  double k2;
  double height_m;
  Lens lens = Lens::Pinhole;
};

LensKind kind_of(const LabOptions& options) {
  if (options.cameras > 1) return {0.85, -0.285, 0.095, 2.7};
  switch (options.lens) {
    case LabLens::Narrow:
      return {0.8, -0.12, 0.03, 3.6};
    case LabLens::Fisheye:
      return {0.42, -0.012, 0.001, 1.8, Lens::Fisheye};
    case LabLens::Wide:
      break;
  }
  return {0.583, -0.285, 0.095, 2.7};
}

CameraModel lens_of(ImageSize size, const LensKind& kind, Rng rng) {
  const double f = kind.focal_share * size.width * (1 + rng.uniform(-0.01, 0.01));
  const bool is_fisheye = kind.lens == Lens::Fisheye;
  const double spread = is_fisheye ? 0.1 : 1;
  return {
      size,
      kind.lens,
      f,
      f * (1 + rng.uniform(-0.002, 0.002)),
      (size.width - 1) / 2.0 + rng.uniform(-0.006, 0.006) * size.width,
      (size.height - 1) / 2.0 + rng.uniform(-0.006, 0.006) * size.width,
      {kind.k1 + spread * rng.uniform(-0.01, 0.01), kind.k2 + spread * rng.uniform(-0.005, 0.005),
       rng.uniform(-0.0006, 0.0006), rng.uniform(-0.0006, 0.0006), 0}};
}

/// One camera above the middle; of two, each sees a good half.
std::vector<LabCamera> cameras_of(const LabOptions& options, Rng rng) {
  const LensKind kind = kind_of(options);
  std::vector<LabCamera> cameras;
  for (int i = 0; i < options.cameras; ++i) {
    Rng own = rng.split("camera", static_cast<std::uint64_t>(i));
    // Of two, each stands on its side and sees a good half of the arena from wall to wall.
    const double side = options.cameras == 1 ? 0 : 0.55 * (2 * i - 1);
    const double turned = options.cameras == 1 ? 0 : 90 * kDegree;
    // Tilts of 2 to 4 degrees, as they come about when a bracket is screwed on by hand.
    const double tilt = own.uniform(2, 4) * kDegree;
    const double towards = own.uniform(0, 2 * std::numbers::pi);
    const Point target{side + own.uniform(-0.02, 0.02), own.uniform(-0.02, 0.02)};
    const Point3 centre{target.x + kind.height_m * std::tan(tilt) * std::cos(towards),
                        target.y + kind.height_m * std::tan(tilt) * std::sin(towards),
                        kind.height_m};
    const CameraModel lens = lens_of(options.size, kind, own.split("lens"));
    cameras.push_back({options.cameras == 1 ? "ceiling"
                       : i == 0             ? "west"
                                            : "east",
                       {lens, looking_at(centre, target, turned + own.uniform(-3, 3) * kDegree)}});
  }
  return cameras;
}

nlohmann::json json_of(const Pose& pose) {
  return {{"x", pose.x}, {"y", pose.y}, {"theta", pose.theta}};
}

/// Across the robot's centre from the first, and turned by a quarter.
void mount_second(LabRobot& robot) {
  constexpr double kBehind_m = 0.125;
  const double length = std::hypot(robot.offset.x_m, robot.offset.y_m);
  const double x = -kBehind_m * robot.offset.x_m / length;
  const double y = -kBehind_m * robot.offset.y_m / length;
  robot.second_tag = robot.tag + 20;
  robot.second_offset = {y, -x, robot.offset.yaw_rad + 90 * kDegree};
}

}  // namespace

Lab lab_of(const LabOptions& options) {
  const Rng rng = Rng(options.seed).split("lab");
  Lab lab;
  lab.size = options.size;
  lab.board.charuco = !options.chessboard;
  lab.cameras = cameras_of(options, rng);
  Rng survey = rng.split("survey");
  // Each camera must see four at least.
  const int count = options.cameras == 1 ? 6 : 10;
  for (int i = 0; i < count; ++i) {
    const double angle = (15 + 360.0 / count * i) * kDegree;
    const Pose declared{std::round(1.08 * std::cos(angle) * 1000) / 1000,
                        std::round(1.08 * std::sin(angle) * 1000) / 1000,
                        wrap_angle((i % 4) * 90 * kDegree)};
    const double sigma = options.survey_sigma_m;
    FilmedTag tag{100 + i, declared};
    tag.pose.x += survey.normal(0, sigma);
    tag.pose.y += survey.normal(0, sigma);
    // A tag of 0.1 m that is laid along a line to a millimetre at both ends.
    tag.pose.theta += survey.normal(0, sigma / tag.edge_m);
    lab.references.push_back(tag);
    lab.declared.push_back(declared);
  }
  // The first two are those of the task's robots, whose turrets took the middle.
  const std::vector<TagOffset> offsets{
      {0.072, 0, 0}, {0.03, -0.05, 8 * kDegree}, {-0.045, 0.04, -90 * kDegree}};
  Rng mounting = rng.split("mounting");
  for (int i = 0; i < options.robots; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const TagOffset offset =
        k < offsets.size() ? offsets[k]
                           : TagOffset{mounting.uniform(-0.07, 0.07), mounting.uniform(-0.07, 0.07),
                                       mounting.uniform(-3, 3)};
    LabRobot& robot = lab.robots.emplace_back();
    robot = {fmt::format("rvr{}", i + 1), i + 1, 0.10, 0.20, offset};
    if (options.two_tags) mount_second(robot);
  }
  return lab;
}

std::string arena_toml(const Lab& lab, const Shooting& shooting) {
  std::string text = "format = 1\nfamily = \"tag36h11\"\n";
  for (const LabCamera& camera : lab.cameras) {
    text += fmt::format(
        "\n[[camera]]\nname = \"{0}\"\nmodel = \"{0}.camera.toml\"\nplace = \"{0}.place.toml\"\n"
        "stamp = \"middle\"\nexposure = \"{1:g} ms\"\nreadout = \"{2:g} ms\"\n"
        "height = [1.5, 4.5]\n",
        camera.name, shooting.exposure_s * 1000, shooting.readout_s * 1000);
  }
  for (std::size_t i = 0; i < lab.references.size(); ++i) {
    const Pose& pose = lab.declared[i];
    text += fmt::format(
        "\n[[reference]]\ntag = {}\nx = {:.4f}\ny = {:.4f}\nangle = {:.2f}\nedge = {:g}\n",
        lab.references[i].tag, pose.x, pose.y, pose.theta / kDegree, lab.references[i].edge_m);
  }
  for (const LabRobot& robot : lab.robots) {
    text += fmt::format(
        "\n[[robot]]\nname = \"{0}\"\ntag = {1}\nedge = {2:g}\nheight = {3:g}\n"
        "offset = \"{0}.offset.toml\"\n",
        robot.name, robot.tag, robot.edge_m, robot.height_m);
    if (robot.second_tag < 0) continue;
    text += fmt::format("[[robot.more_tags]]\ntag = {}\nedge = {:g}\nheight = {:g}\n",
                        robot.second_tag, robot.second_edge_m, robot.second_height_m);
  }
  return text;
}

std::string truth_json(const Lab& lab) {
  nlohmann::json truth;
  truth["size"] = {lab.size.width, lab.size.height};
  const BoardKind& board = lab.board;
  const std::string word =
      board.charuco
          ? fmt::format("charuco:{}x{}:{:g}:{:g}:4x4_50", board.columns, board.rows, board.square_m,
                        board.marker_m)
          : fmt::format("chessboard:{}x{}:{:g}", board.columns - 1, board.rows - 1, board.square_m);
  for (const LabCamera& camera : lab.cameras) {
    const CameraModel& model = camera.view.camera;
    const Point3 centre = camera.view.place.centre();
    const Point3& moved = camera.view.place.translation;
    truth["cameras"].push_back({{"name", camera.name},
                                {"lens", model.lens == Lens::Fisheye ? "fisheye" : "pinhole"},
                                {"fx", model.fx},
                                {"fy", model.fy},
                                {"cx", model.cx},
                                {"cy", model.cy},
                                {"distortion", model.distortion},
                                {"rotation", camera.view.place.rotation},
                                {"translation", {moved.x, moved.y, moved.z}},
                                {"centre", {centre.x, centre.y, centre.z}}});
  }
  for (std::size_t i = 0; i < lab.references.size(); ++i) {
    truth["references"].push_back({{"tag", lab.references[i].tag},
                                   {"true", json_of(lab.references[i].pose)},
                                   {"declared", json_of(lab.declared[i])}});
  }
  for (const LabRobot& robot : lab.robots) {
    truth["robots"].push_back({{"name", robot.name},
                               {"tag", robot.tag},
                               {"edge", robot.edge_m},
                               {"height", robot.height_m},
                               {"x", robot.offset.x_m},
                               {"y", robot.offset.y_m},
                               {"yaw", robot.offset.yaw_rad}});
  }
  truth["board"] = word;
  return truth.dump(1) + "\n";
}

Scene empty_scene(const Lab& lab) {
  Scene scene;
  scene.arena = dodecagon_of_the_thesis();
  scene.tags = lab.references;
  return scene;
}

FilmedRobot filmed(const LabRobot& robot, Path path) {
  FilmedRobot made;
  made.tag = robot.tag;
  made.edge_m = robot.edge_m;
  made.height_m = robot.height_m;
  made.offset = robot.offset;
  made.path = std::move(path);
  return made;
}

FilmedRobot filmed_second(const LabRobot& robot, Path path) {
  FilmedRobot made;
  made.tag = robot.second_tag;
  made.edge_m = robot.second_edge_m;
  made.height_m = robot.second_height_m;
  made.offset = robot.second_offset;
  made.path = std::move(path);
  made.side_m = 0;
  return made;
}

Path spin_path(Point centre, double turns, double seconds, Point creep_m_s) {
  std::vector<Pose> poses;
  const int steps = static_cast<int>(std::lround(seconds * 10));
  for (int i = 0; i <= steps; ++i) {
    const double t = i * 0.1;
    poses.push_back({centre.x + creep_m_s.x * t, centre.y + creep_m_s.y * t,
                     wrap_angle(0.4 + 2 * std::numbers::pi * turns * i / steps)});
  }
  return Path(std::move(poses));
}

Path straight_path(const Pose& from, double length_m, double seconds) {
  std::vector<Pose> poses;
  const int steps = static_cast<int>(std::lround(seconds * 10));
  for (int i = 0; i <= steps; ++i) {
    const double way = length_m * i / steps;
    poses.push_back(
        {from.x + way * std::cos(from.theta), from.y + way * std::sin(from.theta), from.theta});
  }
  return Path(std::move(poses));
}

}  // namespace swarmsmith::film
