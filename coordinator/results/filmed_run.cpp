#include "coordinator/results/filmed_run.h"

#include <utility>

#include <fmt/format.h>

#include "sim/files/color_text.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {
namespace {

Unexpected broken(const RealRunRows& rows, const std::string& what) {
  return unexpected(
      ErrorKind::Corrupt,
      fmt::format("the real run {} cannot be scored from its rows: {}", rows.name, what));
}

Expected<std::vector<Patch>> patches_of(const RealRunRows& rows) {
  std::vector<Patch> patches;
  for (const RealPatchRow& row : rows.patches) {
    const auto color = parse_color(row.color);
    if (!color) return broken(rows, no_such_color(row.color));
    Patch& patch = patches.emplace_back();
    patch.color = *color;
    if (row.radius_m > 0)
      patch.shape = Disc{{row.x, row.y}, row.radius_m};
    else
      patch.shape = Rectangle{{row.x, row.y}, row.width_m, row.height_m};
  }
  return patches;
}

}  // namespace

Expected<FilmedRun> filmed_run(const RealRunRows& rows) {
  auto entry = parse_mission(rows.mission_file, "the run's mission");
  if (!entry) return broken(rows, to_string(entry.error().front()));
  if (!entry->mission.arena.objects.empty())
    return broken(rows, "its mission has movable objects, which tracking cannot follow");
  auto patches = patches_of(rows);
  if (!patches) return Unexpected(patches.error());
  FilmedRun run{.mission = std::move(entry->mission),
                .instance = {.starts = {}, .patches = std::move(*patches)},
                .trajectory = {.robots = static_cast<int>(rows.robots.size())}};
  const auto robots = static_cast<std::int64_t>(rows.robots.size());
  std::int64_t number = 0;
  for (const RealCycleRow& row : rows.cycles) {
    if (robots == 0 || row.cycle != number / robots || row.robot != number % robots) break;
    ++number;
    auto& poses = row.cycle == 0 ? run.instance.starts : run.trajectory.poses;
    poses.push_back({row.x, row.y, row.theta});
  }
  if (number == 0 || number != static_cast<std::int64_t>(rows.cycles.size()) ||
      number % robots != 0)
    return broken(rows, "cycles are missing");
  return run;
}

double score_again(const FilmedRun& run) {
  return score_of(run.mission, run.instance, run.trajectory) + 0.0;
}

}  // namespace swarmsmith
