#include "sim/files/mission_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "base/suggestion.h"
#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "base/text/whole_file.h"
#include "sim/control/toml_kind.h"
#include "sim/engine/fitting.h"
#include "sim/files/internal/read_mission.h"
#include "sim/files/internal/read_solids.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

constexpr double kLongest_s = 86'400;
/// Enough trials to find a swarm that fits only sometimes.
constexpr int kPlacementTrials = 20;

/// The source of files that a mission names, and whether it may use another mission's file as
/// preset.
struct ReadingPlace {
  ImageSource images;
  bool takes_files = false;
};

/// Reads [mission.instances]: placement and number of tests.
void read_instances(TableReader& instances, MissionEntry& mission) {
  read_placement(instances, mission.mission);
  if (auto test = instances.table("test")) {
    mission.test_count = test->integer("count", {0, 99'999}).value_or(mission.test_count);
    test->finish();
  }
  instances.finish();
}

/// The mission with which a file without a preset begins.
MissionEntry empty_mission(const std::string& name) {
  return {{.name = name, .arena = dodecagon_of_the_thesis(), .shuffled = {}, .rule = RobotsOn{}}};
}

/// Reads a preset from a separate file.
std::optional<MissionEntry> read_preset_file(TableReader& table, const std::string& preset,
                                             const ReadingPlace& place) {
  if (!place.takes_files) {
    table.complain("preset", "a mission in its own file begins with a built-in one: " +
                                 joined(mission_names()));
    return std::nullopt;
  }
  auto mission = read_mission_file(*place.images.folder / preset);
  if (mission) return std::move(*mission);
  for (const Error& error : mission.error())
    table.complain_foreign("preset", error);
  return std::nullopt;
}

/// The mission that the keys of the file change: a built-in one, one from another file, or an empty
/// arena. Nothing after a complaint that makes further ones useless.
std::optional<MissionEntry> read_base(TableReader& table, const std::string& name,
                                      const ReadingPlace& place) {
  const auto given = table.text("preset");
  const bool built_in = std::ranges::find(mission_names(), name) != mission_names().end();
  if (!given && !built_in) {
    if (table.has("preset") || table.has("score")) return empty_mission(name);
    table.complain(
        "name",
        "mission \"" + name + "\" is not built in" + did_you_mean(name, mission_names()) +
            ", so it needs a `preset` or a `score`; built in are: " + joined(mission_names()) +
            (names_a_file(name) ? "; give a file as `preset`" : ""));
    return empty_mission(name);
  }
  const std::string preset = given.value_or(name);
  if (given && names_a_file(preset)) return read_preset_file(table, preset, place);
  if (auto mission = built_in_mission(preset)) return MissionEntry{std::move(*mission)};
  table.complain("preset", "there is no preset \"" + preset + "\"" +
                               did_you_mean(preset, mission_names()) + "; built in are: " +
                               joined(mission_names()) + "; a file of your own ends in .toml");
  return empty_mission(name);
}

/// Reads `robot`: a name, a file, or a table with only the outline or with the fields of a robot.
void read_robot(TableReader& table, const ReadingPlace& place, Mission& mission) {
  const auto& folder = place.images.folder;
  const std::filesystem::path* from = folder ? &*folder : nullptr;
  const Node* node = table.take("robot");
  if (node == nullptr) return;
  if (const auto* word = std::get_if<std::string>(&node->value)) {
    if (names_a_file(*word) && from == nullptr) {
      table.complain("robot",
                     "a file's name is not allowed here; robots are " + joined(robot_names()));
      return;
    }
    auto robot = find_robot(*word, from == nullptr ? "" : *from);
    if (robot) {
      mission.robot = std::move(*robot);
      return;
    }
    for (const Error& error : robot.error()) {
      if (error.where.empty()) {
        table.complain("robot", error.message);
      } else {
        table.complain_foreign("robot", error);
      }
    }
    return;
  }
  if (!std::holds_alternative<Table>(node->value)) {
    table.complain("robot",
                   "`robot` must be a robot's name or file in quotes, such as \"epuck\", "
                   "or a table; this is " +
                       std::string(type_name(*node)));
    return;
  }
  auto robot = table.table("robot");
  if (!robot->has("shape")) {
    mission.robot = read_robot_table(*robot, from, mission.robot);
    return;
  }
  if (auto outline = read_outline(*robot, kBodySize, nullptr)) {
    mission.robot.body.outline = std::move(*outline);
    check_with_outline(*robot, mission.robot);
  }
  robot->finish();
}

/// Files give seconds, the engine counts control cycles.
void read_duration(TableReader& table, Mission& mission) {
  const auto duration = table.seconds("duration", {kControlPeriod_s, kLongest_s});
  if (!duration) return;
  const double cycles = *duration / kControlPeriod_s;
  mission.cycles = static_cast<int>(std::lround(cycles));
  if (std::abs(cycles - std::round(cycles)) > 1e-6) {
    table.complain("duration", "`duration` must be a multiple of the control period, 0.1 s");
  }
}

/// Only our solver for discs, which does not know objects, takes any friction.
void check_friction(TableReader& table, const Mission& mission) {
  const RobotBody& body = mission.robot.body;
  if (std::holds_alternative<CircleOutline>(body.outline) && mission.arena.objects.empty()) return;
  if (const auto flaw = friction_flaw(body)) table.complain("robot", *flaw);
}

/// Tries some placements, to find a swarm that does not fit before the campaign starts.
void check_room(TableReader& table, const Mission& mission) {
  for (int seed = 1; seed <= kPlacementTrials; ++seed) {
    const auto instance = instance_of(mission, seed);
    if (instance) continue;
    table.complain(table.has("instances") ? "instances" : "robots",
                   "mission \"" + mission.name + "\": " + instance.error().message);
    return;
  }
}

/// Reads the keys of a mission; they override the keys of its preset.
void read_keys(TableReader& table, const ReadingPlace& place, MissionEntry& entry) {
  Mission& mission = entry.mission;
  read_duration(table, mission);
  if (const auto robots = table.integer("robots", {1, 1000})) {
    mission.robots = static_cast<int>(*robots);
  }
  if (auto score = table.table("score")) {
    if (auto rule = read_score(*score)) mission.rule = std::move(*rule);
  }
  const std::size_t before = table.complaints();
  read_robot(table, place, mission);
  if (auto arena = table.table("arena")) read_arena(*arena, place.images, mission);
  if (auto instances = table.table("instances")) read_instances(*instances, entry);
  if (table.complaints() == before) check_friction(table, mission);
  if (table.complaints() == before) check_room(table, mission);
  table.finish();
}

/// The name of a preset's file is the default name of a mission.
std::string default_name(TableReader& table) {
  const Node* preset = table.take("preset");
  const auto* text = preset == nullptr ? nullptr : std::get_if<std::string>(&preset->value);
  if (text == nullptr || !names_a_file(*text)) return "";
  return std::filesystem::path(*text).stem().string();
}

/// Whether a mission without `name` can take the name of its file. Complains if it cannot.
bool check_file_name(TableReader& table, const std::string& name) {
  if (table.has("name") || name.empty() || is_name(name)) return true;
  table.complain("name", "the mission gets its file's name, but \"" + name +
                             "\" is not a name: a name consists of letters, digits, `_`, `-` and "
                             "`.`; give it a `name`");
  return false;
}

/// Reads one [[mission]]; `taken` holds the names of the missions before it.
MissionEntry read_mission(TableReader& table, const std::vector<std::string>& taken,
                          const ReadingPlace& place) {
  const std::string name =
      table.has("name") ? table.text("name").value_or("") : default_name(table);
  if (!check_file_name(table, name) || !check_name(table, name, taken)) return {};
  auto entry = read_base(table, name, place);
  if (!entry) return {};
  entry->mission.name = name;
  read_keys(table, place, *entry);
  return std::move(*entry);
}

/// Reads the [[mission]] tables.
std::vector<MissionEntry> read_missions(TableReader& root, const ReadingPlace& place) {
  std::vector<MissionEntry> missions;
  std::vector<std::string> names;
  for (TableReader& table : root.tables("mission")) {
    missions.push_back(read_mission(table, names, place));
    names.push_back(missions.back().mission.name);
  }
  if (!root.has("mission")) {
    root.complain("mission",
                  "the file has no [[mission]]; the shortest is [[mission]] with name = "
                  "\"aggregation\"");
  }
  return missions;
}

}  // namespace

const std::vector<std::string>& mission_names() {
  static const std::vector<std::string> names = {"aggregation", "grid_exploration",
                                                 "color_selection"};
  return names;
}

std::vector<MissionEntry> read_missions(TableReader& root, const std::filesystem::path& folder) {
  return read_missions(root, ReadingPlace{{folder}, true});
}

std::vector<MissionEntry> read_sent_missions(TableReader& root) {
  // Twice the limit, because the images of the previous scenario may still be in use.
  return read_missions(root, {{std::nullopt, 2 * Picture::kMostPixelsInUse}, false});
}

MissionOrErrors parse_mission(std::string_view text, const std::filesystem::path& file) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  read_format(root);
  const std::string name = root.text("name").value_or(file.stem().string());
  MissionEntry entry;
  const ReadingPlace place{{file.parent_path()}, false};
  if (check_file_name(root, name) && check_name(root, name, {})) {
    if (auto base = read_base(root, name, place)) {
      entry = std::move(*base);
      entry.mission.name = name;
      read_keys(root, place, entry);
    }
  }
  if (!complaints.empty()) {
    return tl::unexpected(
        complaints_about(*document, TomlKind::Mission, file.string(), complaints));
  }
  return entry;
}

MissionOrErrors read_mission_file(const std::filesystem::path& file) {
  const auto text = read_file(file, "mission");
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  return parse_mission(*text, file);
}

MissionOrErrors find_mission(const std::string& word, const std::filesystem::path& folder) {
  if (names_a_file(word)) return read_mission_file(folder / word);
  auto mission = built_in_mission(word);
  if (!mission) {
    Error error = std::move(mission.error());
    error.message += did_you_mean(word, mission_names()) + "; a file of your own ends in .toml";
    return tl::unexpected(std::vector<Error>{std::move(error)});
  }
  return MissionEntry{std::move(*mission)};
}

}  // namespace swarmsmith
