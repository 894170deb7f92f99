#include "tracking/scoring/run_findings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/median.h"

namespace swarmsmith {
namespace {

double mean_shift(const TagCorners& before, const TagCorners& now) {
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    sum += std::hypot(now[i].u - before[i].u, now[i].v - before[i].v);
  return sum / static_cast<double>(before.size());
}

template <class Map>
const typename Map::mapped_type* item_of(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

template <class Item, class Part>
const Item* item_of(const std::vector<Item>& items, const std::string& name, Part part) {
  const auto found = std::ranges::find(items, name, part);
  return found == items.end() ? nullptr : &*found;
}

/// The item of a robot; a list that was not computed is empty.
template <class Item>
const Item* item_of(const std::vector<std::optional<Item>>& items, std::size_t robot) {
  return robot < items.size() && items[robot] ? &*items[robot] : nullptr;
}

std::string sha256_of(const Rig& rig, const std::string& file) {
  const CalibrationFile* const found = item_of(rig.files, file);
  return found == nullptr ? "" : found->sha256;
}

RobotFinding robot_finding(const RunFindings& run, std::size_t number) {
  const TrackedRobot& tracked = run.tracked.robots[number];
  RobotFinding finding{.tracked = &tracked};
  finding.setup = item_of(run.rig.robots, tracked.name, &RobotSetup::name);
  if (finding.setup != nullptr) {
    finding.offset = item_of(run.rig.offsets, finding.setup->offset_file);
    finding.offset_sha256 = sha256_of(run.rig, finding.setup->offset_file);
  }
  finding.border = item_of(run.scored.borders, number);
  finding.log = item_of(run.observations.logs, tracked.name, &RobotLog::robot);
  if (finding.log != nullptr) finding.logged = log_counts(finding.log->record);
  finding.latency = item_of(run.scored.latencies, number);
  finding.reality = item_of(run.scored.reality, number);
  return finding;
}

void find_calibrations(const Rig& rig, CameraFinding& finding) {
  finding.setup = rig.setup_of(finding.record->camera);
  if (finding.setup == nullptr) return;
  finding.calibration = item_of(rig.models, finding.setup->model_file);
  finding.calibration_sha256 = sha256_of(rig, finding.setup->model_file);
  finding.place = item_of(rig.places, finding.setup->place_file);
  finding.place_sha256 = sha256_of(rig, finding.setup->place_file);
}

CameraFinding camera_finding(const Rig& rig, const CameraRecord& record) {
  CameraFinding finding{.record = &record};
  find_calibrations(rig, finding);
  std::map<int, ReferenceFinding> tags;
  std::map<int, TagCorners> calibrated;
  if (finding.place != nullptr) {
    finding.height_m = finding.place->place.centre().z;
    for (const PlaceCalibration::Seen& seen : finding.place->tags) {
      tags[seen.tag.tag] = {
          .tag = seen.tag.tag, .rms_px = seen.rms_px, .left_out_m = seen.left_out_m};
      calibrated[seen.tag.tag] = seen.corners;
    }
  }
  std::map<double, std::vector<double>> shifts;
  for (const ReferenceLook& look : record.references) {
    ReferenceFinding& tag = tags[look.tag];
    tag.tag = look.tag;
    ++tag.looks;
    const auto before = calibrated.find(look.tag);
    std::vector<double>& at_that_time = shifts[look.time_s];
    if (before == calibrated.end()) continue;
    const double shift = mean_shift(before->second, look.corners);
    tag.worst_shift_px = std::max(tag.worst_shift_px, shift);
    at_that_time.push_back(shift);
  }
  finding.looks = static_cast<std::int64_t>(shifts.size());
  for (const auto& [time, of_tags] : shifts) {
    // The median: a camera that moves shifts all floor tags, and a tag that was kicked only itself.
    const double shift = of_tags.empty() ? 0 : median_of(of_tags);
    if (shift <= finding.worst_shift_px) continue;
    finding.worst_shift_px = shift;
    finding.worst_shift_at_s = time;
  }
  for (const auto& [id, tag] : tags)
    finding.references.push_back(tag);
  return finding;
}

}  // namespace

RunFindings findings_of(const Rig& rig, const RunLog& log, const Observations& observations,
                        const TrackedRun& tracked, const ScoredRun& scored) {
  RunFindings run{rig, log, observations, tracked, scored};
  for (std::size_t i = 0; i < tracked.robots.size(); ++i)
    run.robots.push_back(robot_finding(run, i));
  for (const CameraRecord& record : observations.cameras)
    run.cameras.push_back(camera_finding(rig, record));
  return run;
}

}  // namespace swarmsmith
