#include "sim/mission/instance_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/math.h"
#include "base/plain_text.h"
#include "base/text/csv.h"
#include "sim/mission/colors.h"

namespace swarmsmith {
namespace {

/// Centres in files are rounded; a centre matches a place when they differ by less than this.
constexpr double kSamePlace_m = 1e-3;
/// As in mission files: beyond many turns the last digits of a number no longer give the angle.
constexpr double kMostHeading_rad = 1000;

/// The cells of a row, its header and its line number: enough to read a cell or report an error in
/// it.
struct Row {
  std::span<const std::string_view> columns;
  std::vector<std::string> cells;
  std::size_t line = 0;

  Unexpected wrong(std::size_t column, std::string_view wanted) const {
    return bad_input("column " + std::string(columns[column]) + " must be " + std::string(wanted) +
                         ", not `" + cells[column] + "`",
                     std::to_string(line));
  }

  template <class Number>
  Expected<Number> number(std::size_t column, std::string_view wanted) const {
    Number value{};
    const std::string_view cell = cells[column];
    const char* end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || stop != end) return wrong(column, wanted);
    return value;
  }

  Expected<std::int64_t> integer(std::size_t column) const {
    return number<std::int64_t>(column, "an integer");
  }

  /// As on command lines.
  Expected<std::int64_t> seed(std::size_t column) const {
    constexpr std::int64_t kLargestSeed = 2'147'483'647;
    const Expected<std::int64_t> value = integer(column);
    if (value && (*value < 1 || *value > kLargestSeed))
      return wrong(column, "a seed from 1 to 2147483647");
    return value;
  }

  Expected<double> real(std::size_t column) const {
    const Expected<double> value = number<double>(column, "a number");
    if (value && !std::isfinite(*value)) return wrong(column, "a finite number");
    return value;
  }
};

/// The position of each wanted column in the header.
Expected<std::vector<std::size_t>> places_of(std::span<const std::string_view> columns,
                                             std::span<const std::string> header) {
  std::vector<std::size_t> places;
  for (const std::string_view column : columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) {
      std::string wanted;
      for (const std::string_view one : columns)
        wanted.append(wanted.empty() ? "" : ", ").append(one);
      return bad_input("there is no column `" + std::string(column) + "`; needed are: " + wanted,
                       "1");
    }
    if (std::find(found + 1, header.end(), column) != header.end())
      return bad_input("the column `" + std::string(column) + "` appears twice", "1");
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  return places;
}

/// The rows below the header, each with the cells of `columns` in that order, whatever the order in
/// the text. Other columns and blank lines are ignored.
Expected<std::vector<Row>> rows_of(std::string_view text,
                                   std::span<const std::string_view> columns) {
  CsvReader reader(text);
  const std::vector<std::string> header = reader.next().value_or(std::vector<std::string>());
  const auto places = places_of(columns, header);
  if (!places) return Unexpected(places.error());
  std::vector<Row> rows;
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    std::vector<std::string> cells = reader.next().value_or(std::vector<std::string>());
    if (cells == std::vector<std::string>{""}) continue;
    if (cells.size() != header.size()) {
      return bad_input("expected " + counted(header.size(), "cell") + " as in the header, found " +
                           std::to_string(cells.size()),
                       std::to_string(line));
    }
    rows.push_back({columns, {}, line});
    for (const std::size_t place : *places)
      rows.back().cells.push_back(cells[place]);
  }
  return rows;
}

Unexpected no_row(std::string_view what, std::int64_t seed) {
  return unexpected(ErrorKind::NotFound,
                    "the " + std::string(what) + " have no row for seed " + std::to_string(seed));
}

Expected<std::vector<Pose>> explicit_starts(const Mission& mission, std::int64_t seed,
                                            const StartsBySeed& given) {
  const auto found = given.find(seed);
  if (found == given.end()) return no_row("starts", seed);
  const std::vector<Pose>& starts = found->second;
  const std::string where = "starts, seed " + std::to_string(seed);
  if (starts.size() != static_cast<std::size_t>(mission.robots)) {
    return bad_input("the mission has " + counted(mission.robots, "robot") + ", the file " +
                         std::to_string(starts.size()),
                     where);
  }
  // Only centres are checked: starts of other simulators may overlap (`has_overlaps` finds those).
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!is_inside(mission.arena, starts[i].position())) {
      return bad_input("robot " + std::to_string(i) + " is outside the arena", where);
    }
  }
  return starts;
}

/// "the mission has 4 red patches, and the file 3; ...": each colour of another number; empty if
/// there is none.
std::string other_numbers(const ShuffledPatches& shuffled, const std::vector<Patch>& patches) {
  std::vector<ShuffledPatches::Share> wanted;  // each colour once
  const auto share_of = [&wanted](Rgb color) -> int& {
    const auto same = [color](const auto& share) { return share.color == color; };
    const auto found = std::find_if(wanted.begin(), wanted.end(), same);
    if (found != wanted.end()) return found->count;
    wanted.push_back({color, 0});
    return wanted.back().count;
  };
  for (const ShuffledPatches::Share& share : shuffled.shares)
    share_of(share.color) += share.count;
  for (const Patch& patch : patches)
    share_of(patch.color);  // those that the mission does not have, too
  std::string text;
  for (const ShuffledPatches::Share& share : wanted) {
    const auto of_color = [&share](const Patch& patch) { return patch.color == share.color; };
    const auto there = std::count_if(patches.begin(), patches.end(), of_color);
    if (there == share.count) continue;
    const std::string noun = color_text(share.color) + " patch";
    text += text.empty() ? "the mission has " : "; ";
    text += counted(share.count, noun, noun + "es");
    text += ", the file " + std::to_string(there);
  }
  return text;
}

Expected<std::vector<Patch>> explicit_patches(const Mission& mission, std::int64_t seed,
                                              const PatchesBySeed& given) {
  const auto found = given.find(seed);
  if (found == given.end()) return no_row("patches", seed);
  const std::string where = "patches, seed " + std::to_string(seed);
  std::vector<Rectangle> free = mission.shuffled.places;
  std::vector<Patch> patches;
  for (const PatchPlacement& patch : found->second) {
    const auto place = std::find_if(free.begin(), free.end(), [&patch](const Rectangle& box) {
      return std::fabs(box.centre.x - patch.centre.x) < kSamePlace_m &&
             std::fabs(box.centre.y - patch.centre.y) < kSamePlace_m;
    });
    if (place == free.end()) {
      return bad_input("there is no free place for a patch at (" + std::to_string(patch.centre.x) +
                           ", " + std::to_string(patch.centre.y) + ")",
                       where);
    }
    Patch& laid = patches.emplace_back();
    laid.shape = *place;
    laid.color = patch.color;
    free.erase(place);  // a second patch at this place is an error
  }
  if (const std::string other = other_numbers(mission.shuffled, patches); !other.empty())
    return bad_input(other, where);
  return patches;
}

}  // namespace

Expected<StartsBySeed> parse_starts_csv(std::string_view text) {
  static constexpr std::string_view kColumns[] = {"seed", "robot", "x", "y", "theta"};
  const Expected<std::vector<Row>> rows = rows_of(text, kColumns);
  if (!rows) return Unexpected(rows.error());
  StartsBySeed starts;
  for (const Row& row : *rows) {
    const Expected<std::int64_t> seed = row.seed(0);
    if (!seed) return Unexpected(seed.error());
    const Expected<std::int64_t> robot = row.integer(1);
    if (!robot) return Unexpected(robot.error());
    std::vector<Pose>& poses = starts[*seed];
    if (*robot != static_cast<std::int64_t>(poses.size())) {
      return row.wrong(1, "robot " + std::to_string(poses.size()) + " of this seed");
    }
    Pose pose;
    double* const targets[] = {&pose.x, &pose.y, &pose.theta};
    for (std::size_t i = 0; i < 3; ++i) {
      const Expected<double> value = row.real(2 + i);
      if (!value) return Unexpected(value.error());
      *targets[i] = *value;
    }
    if (std::fabs(pose.theta) > kMostHeading_rad)
      return row.wrong(4, "an angle in radians, from -1000 to 1000");
    pose.theta = wrap_angle(pose.theta);
    poses.push_back(pose);
  }
  return starts;
}

Expected<PatchesBySeed> parse_patches_csv(std::string_view text) {
  static constexpr std::string_view kColumns[] = {"seed", "x", "y", "color"};
  const Expected<std::vector<Row>> rows = rows_of(text, kColumns);
  if (!rows) return Unexpected(rows.error());
  PatchesBySeed patches;
  for (const Row& row : *rows) {
    const Expected<std::int64_t> seed = row.seed(0);
    if (!seed) return Unexpected(seed.error());
    const Expected<double> x = row.real(1);
    if (!x) return Unexpected(x.error());
    const Expected<double> y = row.real(2);
    if (!y) return Unexpected(y.error());
    const std::optional<Rgb> color = parse_color(row.cells[3]);
    if (!color) return row.wrong(3, "the name of a colour, or #rrggbb");
    patches[*seed].push_back({{*x, *y}, *color});
  }
  return patches;
}

std::string starts_csv(const std::map<std::int64_t, Instance>& instances) {
  std::string text = "seed,robot,x,y,theta\n";
  for (const auto& [seed, instance] : instances) {
    for (std::size_t robot = 0; robot < instance.starts.size(); ++robot) {
      const Pose& pose = instance.starts[robot];
      text += fmt::format("{},{},{},{},{}\n", seed, robot, pose.x, pose.y, pose.theta);
    }
  }
  return text;
}

std::string patches_csv(const std::map<std::int64_t, Instance>& instances) {
  std::string text = "seed,x,y,color\n";
  for (const auto& [seed, instance] : instances) {
    for (const Patch& patch : instance.patches) {
      const Point centre = std::get<Rectangle>(patch.shape).centre;
      text += fmt::format("{},{},{},{}\n", seed, centre.x, centre.y, color_text(patch.color));
    }
  }
  return text;
}

Expected<Instance> instance_of(const Mission& mission, std::int64_t seed,
                               const ExplicitInstances& given) {
  // Parts that are given are not drawn, so that an arena too small for random placement is
  // accepted.
  Mission drawn = mission;
  if (given.starts) {
    drawn.robots = 0;
    drawn.placement = PlaceAnywhere{};  // fixed places would be compared with the number of robots
  }
  Expected<Instance> instance = instance_of(drawn, seed);
  if (!instance) return instance;
  if (given.starts) {
    Expected<std::vector<Pose>> starts = explicit_starts(mission, seed, *given.starts);
    if (!starts) return Unexpected(std::move(starts.error()));
    instance->starts = std::move(*starts);
  }
  if (given.patches && !mission.shuffled.places.empty()) {
    Expected<std::vector<Patch>> patches = explicit_patches(mission, seed, *given.patches);
    if (!patches) return Unexpected(std::move(patches.error()));
    instance->patches = std::move(*patches);
  }
  return instance;
}

}  // namespace swarmsmith
