#include "sim/messages/mission_messages.h"

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "base/overloaded.h"
#include "sim/messages/score_messages.h"

namespace swarmsmith {
namespace {

constexpr int kMaxRobots = 1000;
constexpr int kMaxCycles = 1'000'000;

void write(Rgb color, pb::Color& out) {
  out.set_r(color.r);
  out.set_g(color.g);
  out.set_b(color.b);
}

void write(Point point, pb::Point& out) {
  out.set_x_m(point.x);
  out.set_y_m(point.y);
}

void write(const Disc& disc, pb::Disc& out) {
  write(disc.centre, *out.mutable_centre());
  out.set_radius_m(disc.radius_m);
}

void write(const Rectangle& rectangle, pb::Rectangle& out) {
  write(rectangle.centre, *out.mutable_centre());
  out.set_width_m(rectangle.width_m);
  out.set_height_m(rectangle.height_m);
}

void write(const Patch& patch, pb::Patch& out) {
  std::visit(
      Overloaded{[&](const Disc& disc) { write(disc, *out.mutable_disc()); },
                 [&](const Rectangle& rectangle) { write(rectangle, *out.mutable_rectangle()); }},
      patch.shape);
  write(patch.color, *out.mutable_color());
}

void write(const Arena& arena, pb::Arena& out) {
  for (const Wall& wall : arena.walls) {
    pb::Wall& to = *out.add_walls();
    write(wall.from, *to.mutable_from());
    write(wall.to, *to.mutable_to());
  }
  write(arena.floor, *out.mutable_floor());
  for (const Patch& patch : arena.patches)
    write(patch, *out.add_patches());
}

void write(const ShuffledPatches& shuffled, pb::ShuffledPatches& out) {
  for (const Rectangle& place : shuffled.places)
    write(place, *out.add_places());
  for (const ShuffledPatches::Share& share : shuffled.shares) {
    pb::ShuffledPatches::Share& to = *out.add_shares();
    write(share.color, *to.mutable_color());
    to.set_count(share.count);
  }
}

/// Reads one mission; the first thing that is wrong is kept, and reading goes on.
class Reader {
 public:
  std::string where;
  std::string complaint;

  void complain(const std::string& field, const std::string& text) {
    if (!complaint.empty()) return;
    where = field;
    complaint = text;
  }

  double number(double value, const std::string& field) {
    if (!std::isfinite(value)) complain(field, "a number that is not finite");
    return value;
  }

  Rgb color(const pb::Color& message, const std::string& field) {
    for (const std::uint32_t channel : {message.r(), message.g(), message.b()}) {
      if (channel > 255) complain(field, "a colour channel of " + std::to_string(channel));
    }
    return {static_cast<std::uint8_t>(message.r()), static_cast<std::uint8_t>(message.g()),
            static_cast<std::uint8_t>(message.b())};
  }

  Point point(const pb::Point& message, const std::string& field) {
    return {number(message.x_m(), field), number(message.y_m(), field)};
  }

  Rectangle rectangle(const pb::Rectangle& message, const std::string& field) {
    return {point(message.centre(), field + ".centre"), number(message.width_m(), field + ".width"),
            number(message.height_m(), field + ".height")};
  }

  Patch patch(const pb::Patch& message, const std::string& field) {
    Patch patch;
    patch.color = color(message.color(), field + ".color");
    switch (message.shape_case()) {
      case pb::Patch::kDisc:
        patch.shape = Disc{point(message.disc().centre(), field + ".centre"),
                           number(message.disc().radius_m(), field + ".radius")};
        break;
      case pb::Patch::kRectangle:
        patch.shape = rectangle(message.rectangle(), field);
        break;
      case pb::Patch::SHAPE_NOT_SET:
        complain(field, "a patch without a shape");
        break;
    }
    return patch;
  }

  Arena arena(const pb::Arena& message) {
    Arena arena;
    for (const pb::Wall& wall : message.walls()) {
      arena.walls.push_back(
          {point(wall.from(), "arena.walls.from"), point(wall.to(), "arena.walls.to")});
    }
    arena.floor = color(message.floor(), "arena.floor");
    for (const pb::Patch& one : message.patches()) {
      arena.patches.push_back(patch(one, "arena.patches"));
    }
    return arena;
  }

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
  message.set_placement_radius_m(std::get<PlaceInDisc>(mission.placement).radius_m);
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
  mission.placement = PlaceInDisc{
      .centre = {}, .radius_m = reader.number(message.placement_radius_m(), "placement_radius")};
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
