#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/control/flavour.h"
#include "sim/control/flavour_text.h"
#include "tests/sim/control/page.h"
#include "tests/support/not_empty.h"

// docs/flavours.md shows the flavours side by side: its tables must be the data's.

namespace swarmsmith {
namespace {

using Text = std::function<std::string(const Flavour&)>;

std::string yes_no(bool flag) {
  return flag ? "yes" : "no";
}

/// The name of a constant in the page, and what the page says of it.
std::vector<std::pair<std::string, Text>> constants() {
  using F = const Flavour&;
  const auto of_255 = [](int thousandths) { return short_text(thousandths / 1000.0); };
  const auto range = [of_255](const GrayRange& r) {
    return of_255(r.low) + " to " + of_255(r.high);
  };
  const auto distance = [](F f, double metres) {
    const bool is_one = f.obstacles.reading != ObstacleModel::Reading::AsSensed;
    return is_one ? short_text(metres) : std::string("-");
  };
  const auto near = [](F f, double metres) {
    return f.obstacles.neighbours_as_obstacles ? short_text(metres) : std::string("-");
  };
  return {
      {"states", [](F f) { return std::to_string(f.most_states); }},
      {"transitions", [](F f) { return std::to_string(f.most_transitions); }},
      {"speed_mps", [](F f) { return short_text(f.speed_mps); }},
      {"obstacles.reading",
       [](F f) {
         if (f.obstacles.reading == ObstacleModel::Reading::AsSensed)
           return std::string("as sensed");
         const bool linear = f.obstacles.reading == ObstacleModel::Reading::Linear;
         return std::string(linear ? "linear" : "1/d");
       }},
      {"obstacles.near_m", [distance](F f) { return distance(f, f.obstacles.near_m); }},
      {"obstacles.far_m", [distance](F f) { return distance(f, f.obstacles.far_m); }},
      {"obstacles.longest_sum", [](F f) { return short_text(f.obstacles.longest_sum); }},
      {"obstacles.neighbours_as_obstacles",
       [](F f) { return yes_no(f.obstacles.neighbours_as_obstacles); }},
      {"obstacles.neighbour_near_m", [near](F f) { return near(f, f.obstacles.neighbour_near_m); }},
      {"obstacles.neighbour_far_m", [near](F f) { return near(f, f.obstacles.neighbour_far_m); }},
      {"exploration.trigger",
       [](F f) {
         if (f.exploration.trigger == ExplorationModel::Trigger::FrontThenSum)
           return std::string("front readings, side of the sum");
         const bool front = f.exploration.trigger == ExplorationModel::Trigger::FrontReadings;
         return std::string(front ? "front readings" : "vector sum");
       }},
      {"exploration.front_slope",
       [](F f) {
         const bool is_used = f.exploration.trigger != ExplorationModel::Trigger::VectorSum;
         return is_used ? short_text(f.exploration.front_slope) : std::string("-");
       }},
      {"exploration.threshold", [](F f) { return short_text(f.exploration.threshold); }},
      {"exploration.turn_length",
       [](F f) {
         const bool zero = f.exploration.turn_length == ExplorationModel::TurnLength::ZeroToTau;
         return std::string(zero ? "0 to tau" : "0 to tau - 1, at least 1");
       }},
      {"exploration.turn_clock",
       [](F f) { return std::string(name_of(f.exploration.turn_clock)); }},
      {"exploration.track_m", [](F f) { return short_text(f.exploration.track_m); }},
      {"neighbours.per_metre", [](F f) { return short_text(f.neighbours.per_metre); }},
      {"neighbours.shortest_m", [](F f) { return short_text(f.neighbours.shortest_m); }},
      {"neighbours.offset", [](F f) { return short_text(f.neighbours.offset); }},
      {"neighbours.alpha_truncated", [](F f) { return yes_no(f.neighbours.alpha_truncated); }},
      {"neighbours.repulsion_power", [](F f) { return short_text(f.neighbours.repulsion_power); }},
      {"neighbours.attraction_gain", [](F f) { return short_text(f.neighbours.attraction_gain); }},
      {"neighbours.repulsion_gain", [](F f) { return short_text(f.neighbours.repulsion_gain); }},
      {"neighbours.unsigned_count", [](F f) { return yes_no(f.neighbours.unsigned_count); }},
      {"light.full_lux",
       [](F f) { return f.find(Module::Phototaxis) ? short_text(f.light.full_lux) : "-"; }},
      {"light.least_vector",
       [](F f) { return f.find(Module::Phototaxis) ? short_text(f.light.least_vector) : "-"; }},
      {"light.least_reading",
       [](F f) { return f.find(Module::Phototaxis) ? short_text(f.light.least_reading) : "-"; }},
      {"light.unit_vector",
       [](F f) { return f.find(Module::Phototaxis) ? yes_no(f.light.unit_vector) : "-"; }},
      {"steering.obstacle_gain", [](F f) { return short_text(f.steering.obstacle_gain); }},
      {"steering.attraction_obstacle_gain",
       [](F f) { return short_text(f.steering.attraction_obstacle_gain); }},
      {"steering.forward_by_default", [](F f) { return yes_no(f.steering.forward_by_default); }},
      {"steering.shortest_result", [](F f) { return short_text(f.steering.shortest_result); }},
      {"steering.least_inner", [](F f) { return short_text(f.steering.least_inner); }},
      {"floor.black", [range](F f) { return range(f.floor.black); }},
      {"floor.gray", [range](F f) { return range(f.floor.gray); }},
      {"floor.white", [range](F f) { return range(f.floor.white); }},
      {"floor.labels",
       [](F f) { return f.floor.labels.empty() ? "-" : std::to_string(f.floor.labels.size()); }},
      {"floor.hue_tolerance_deg",
       [](F f) { return f.floor.labels.empty() ? "-" : short_text(f.floor.hue_tolerance_deg); }},
      {"floor.hue_wraps",
       [](F f) { return f.floor.labels.empty() ? "-" : yes_no(f.floor.hue_wraps); }},
      {"floor.saturation_tolerance",
       [](F f) { return f.floor.labels.empty() ? "-" : short_text(f.floor.saturation_tolerance); }},
      {"floor.any_channel", [](F f) { return yes_no(f.floor.any_channel); }},
      {"xi, least",
       [](F f) { return short_text(f.find(Module::NeighbourCount)->parameters[0].low); }},
  };
}

/// Those of the robots apart: their tables on the page are two.
std::vector<std::vector<const Flavour*>> tables() {
  std::vector<const Flavour*> of_the_e_puck;
  for (const Flavour* flavour : all_flavours())
    if (flavour->reference != kRvrModel) of_the_e_puck.push_back(flavour);
  return {flavours_for(kRvrModel), of_the_e_puck};
}

TEST(FlavoursPage, HasTheConstantsOfTheData) {
  const std::string page = page_text("flavours.md");
  for (const auto& flavours : tables()) {
    for (const auto& [name, text] : not_empty(constants())) {
      std::string line = "\n| `" + name + "` |";
      for (const Flavour* flavour : flavours)
        line += " " + text(*flavour) + " |";
      EXPECT_NE(page.find(line), std::string::npos) << "docs/flavours.md lacks the line" << line;
    }
  }
}

TEST(FlavoursPage, NamesEachKeyOfAFile) {
  const std::string page = page_text("flavours.md");
  for (const Section& section : not_empty(flavour_sections(chocolate(), ""))) {
    // The modules have a table of their own.
    if (section.prefix == "behaviours." || section.prefix == "conditions.") continue;
    for (const SectionLine& line : section.lines)
      EXPECT_NE(page.find("`" + section.prefix + line.key + "`"), std::string::npos)
          << "docs/flavours.md lacks " << section.prefix << line.key;
  }
}

TEST(FlavoursPage, HasTheModulesWithTheirNumbers) {
  const std::string page = page_text("flavours.md");
  for (const Module module : not_empty(all_modules())) {
    std::string line = "\n| `" + std::string(id_of(module)) + "` |";
    for (const Flavour* flavour : flavours_for(kRvrModel)) {
      const ModuleSpec* spec = flavour->find(module);
      line += " " + (spec == nullptr ? "-" : std::to_string(spec->number)) + " |";
    }
    EXPECT_NE(page.find(line), std::string::npos) << "docs/flavours.md lacks the line" << line;
  }
}

}  // namespace
}  // namespace swarmsmith
