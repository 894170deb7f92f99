#include "sim/files/internal/read_mission.h"

#include <string>

#include "sim/files/internal/read_floor.h"
#include "sim/files/read_place.h"

namespace swarmsmith {
namespace {

constexpr Limits<double> kRadius{0.01, 1000};

/// Missing keys keep the mission's values, if its placement is a disc, too. Without any key of a
/// disc the placement stays as it is.
Placement read_disc(TableReader& training, const Mission& mission) {
  const auto* before = std::get_if<PlaceInDisc>(&mission.placement);
  PlaceInDisc disc = before != nullptr ? *before : PlaceInDisc{};
  disc.centre.x = training.number("x", kCoordinate).value_or(disc.centre.x);
  disc.centre.y = training.number("y", kCoordinate).value_or(disc.centre.y);
  disc.radius_m = training.number("radius", kRadius).value_or(disc.radius_m);
  if (before == nullptr && !training.has("radius")) {
    const bool is_meant = training.has("placement") || training.has("x") || training.has("y");
    if (!is_meant) return mission.placement;
    training.complain("radius",
                      "placement = \"uniform\" in an arena of this shape needs a `radius`");
  }
  return disc;
}

PlaceAt read_poses(TableReader& training) {
  PlaceAt fixed;
  for (TableReader& table : training.tables("poses")) {
    const Point place = need_point(table);
    fixed.poses.push_back({place.x, place.y, read_heading(table)});
    table.finish();
  }
  if (!training.has("poses")) {
    training.complain("poses",
                      "placement = \"fixed\" needs `poses`, one per robot, such as "
                      "[ { x = 0, y = 0, angle = 90 } ]");
  }
  return fixed;
}

}  // namespace

void read_placement(TableReader& instances, Mission& mission) {
  auto training = instances.table("training");
  if (!training) return;
  static const std::vector<std::string> kRules = {"uniform", "rectangle", "anywhere", "fixed"};
  const auto given = training->choice("placement", kRules);
  // The other keys belong to a rule that is not known.
  if (training->has("placement") && !given) return;
  // A radius without a placement means a disc.
  const std::string rule = given.value_or("uniform");
  if (rule == "uniform") mission.placement = read_disc(*training, mission);
  if (rule == "rectangle") mission.placement = PlaceInRectangle{read_rectangle(*training, false)};
  if (rule == "anywhere") mission.placement = PlaceAnywhere{};
  if (rule == "fixed") mission.placement = read_poses(*training);
  mission.ignores_obstacles =
      training->boolean("ignores_obstacles").value_or(mission.ignores_obstacles);
  training->finish();
}

}  // namespace swarmsmith
