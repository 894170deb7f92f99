#include <array>
#include <string>

#include "sim/mission/mission.h"

// The built-in missions: thesis 6.3 to 6.5, with the geometry of rvr-automode facts, sections 7 and
// 8. All have three robots, 1200 cycles and the arena of the thesis' program.

namespace swarmsmith {
namespace {

constexpr Rgb kBlack{0, 0, 0};
constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kGreen{0, 255, 0};
constexpr Rgb kYellow{255, 255, 0};

/// Score: the number of robots on the black disc of diameter 1 m at the end.
Mission aggregation() {
  Mission mission{.name = "aggregation",
                  .arena = dodecagon_of_the_thesis(),
                  .shuffled = {},
                  .rule = RobotsOn{kBlack}};
  mission.arena.patches.push_back({Disc{.centre = {0, 0}, .radius_m = 0.5}, kBlack});
  return mission;
}

/// Score: the ages of the 10 x 10 tiles of the grey floor.
Mission grid_exploration() {
  return {.name = "grid_exploration",
          .arena = dodecagon_of_the_thesis(),
          .shuffled = {},
          .rule = Coverage{.tiles = 10, .side_m = 2.50001}};
}

/// Score: the colours of the shuffled patches, twelve in all, on which the robots stand at the end.
Mission color_selection() {
  constexpr std::array<Point, 12> kCentres = {{{0.75, -0.25},
                                               {0.75, 0.25},
                                               {0.25, -0.25},
                                               {0.25, 0.25},
                                               {0.25, -0.75},
                                               {0.25, 0.75},
                                               {-0.25, -0.25},
                                               {-0.25, 0.25},
                                               {-0.25, -0.75},
                                               {-0.25, 0.75},
                                               {-0.75, -0.25},
                                               {-0.75, 0.25}}};
  Mission mission{.name = "color_selection",
                  .arena = dodecagon_of_the_thesis(),
                  .shuffled = {.places = {}, .shares = {{kGreen, 4}, {kRed, 4}, {kYellow, 4}}},
                  // Table 6.1 of the thesis.
                  .rule = ColorReward{{{kGreen, 0}, {kRed, 1}, {kYellow, 2}}}};
  for (const Point centre : kCentres) {
    mission.shuffled.places.push_back({.centre = centre, .width_m = 0.30, .height_m = 0.30});
  }
  return mission;
}

}  // namespace

Expected<Mission> built_in_mission(std::string_view name) {
  std::string known;
  for (Mission (*make)() : {aggregation, grid_exploration, color_selection}) {
    Mission mission = make();
    if (mission.name == name) return mission;
    known += (known.empty() ? "" : ", ") + mission.name;
  }
  return unexpected(ErrorKind::NotFound,
                    "there is no mission `" + std::string(name) + "`; built in are: " + known);
}

}  // namespace swarmsmith
