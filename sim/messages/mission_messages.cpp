#include "sim/messages/mission_messages.h"

#include <string>
#include <utility>

#include "base/overloaded.h"
#include "sim/messages/internal/arena_messages.h"
#include "sim/messages/score_messages.h"

namespace swarmsmith {
namespace {

constexpr int kMaxRobots = 1000;
constexpr int kMaxCycles = 1'000'000;

void write(const ShuffledPatches& shuffled, pb::ShuffledPatches& out) {
  for (const Rectangle& place : shuffled.places)
    write(place, *out.add_places());
  for (const ShuffledPatches::Share& share : shuffled.shares) {
    pb::ShuffledPatches::Share& to = *out.add_shares();
    write(share.color, *to.mutable_color());
    to.set_count(share.count);
  }
}

void write(const Placement& placement, pb::Placement& out) {
  std::visit(Overloaded{[&](const PlaceInDisc& disc) {
                          write(Disc{disc.centre, disc.radius_m}, *out.mutable_disc());
                        },
                        [&](const PlaceInRectangle& rectangle) {
                          write(rectangle.area, *out.mutable_rectangle());
                        },
                        [&](const PlaceAnywhere&) { out.mutable_anywhere(); },
                        [&](const PlaceAt& fixed) {
                          pb::Placement::Fixed& to = *out.mutable_fixed();
                          for (const Pose& pose : fixed.poses)
                            write(pose, *to.add_poses());
                        }},
             placement);
}

/// Reads what of a mission is not the arena.
class Reader : public ArenaReader {
 public:
  ShuffledPatches shuffled(const pb::ShuffledPatches& message) {
    ShuffledPatches shuffled;
    for (const pb::Rectangle& place : message.places()) {
      shuffled.places.push_back(rectangle(place, "shuffled.places"));
    }
    for (const auto& share : message.shares()) {
      shuffled.shares.push_back({color(share.color(), "shuffled.shares.color"), share.count()});
    }
    return shuffled;
  }

  Placement placement(const pb::Placement& message) {
    switch (message.rule_case()) {
      case pb::Placement::kDisc: {
        const Disc area = disc(message.disc(), "placement");
        return PlaceInDisc{area.centre, area.radius_m};
      }
      case pb::Placement::kRectangle:
        return PlaceInRectangle{rectangle(message.rectangle(), "placement")};
      case pb::Placement::kAnywhere:
        return PlaceAnywhere{};
      case pb::Placement::kFixed: {
        PlaceAt fixed;
        for (const pb::Pose& one : message.fixed().poses())
          fixed.poses.push_back(pose(one, "placement.poses"));
        return fixed;
      }
      case pb::Placement::RULE_NOT_SET:
        complain("placement", "a mission without a placement of its robots");
        break;
    }
    return PlaceAnywhere{};
  }

  ScoreRule rule(const pb::ScoreRule& message) {
    auto rule = from_message(message);
    if (rule) return std::move(*rule);
    complain(rule.error().where, rule.error().message);
    return {};
  }
};

}  // namespace

void to_message(const Mission& mission, pb::Mission& message) {
  message.Clear();
  message.set_name(mission.name);
  write(mission.arena, *message.mutable_arena());
  write(mission.shuffled, *message.mutable_shuffled());
  message.set_robots(mission.robots);
  message.set_cycles(mission.cycles);
  write(mission.body, *message.mutable_body());
  write(mission.placement, *message.mutable_placement());
  to_message(mission.rule, *message.mutable_rule());
}

Expected<Mission> from_message(const pb::Mission& message) {
  Reader reader;
  Mission mission;
  mission.name = message.name();
  mission.arena = reader.arena(message.arena());
  mission.shuffled = reader.shuffled(message.shuffled());
  mission.robots = message.robots();
  mission.cycles = message.cycles();
  mission.body = reader.outline(message.body(), "body");
  mission.placement = reader.placement(message.placement());
  mission.rule = reader.rule(message.rule());
  if (mission.robots < 1 || mission.robots > kMaxRobots) {
    reader.complain("robots", std::to_string(mission.robots) + " robots; wanted 1 to 1000");
  }
  if (mission.cycles < 1 || mission.cycles > kMaxCycles) {
    reader.complain("cycles", std::to_string(mission.cycles) + " cycles; wanted 1 to 1000000");
  }
  if (!reader.complaint.empty()) return bad_input(reader.complaint, reader.where);
  return mission;
}

}  // namespace swarmsmith
