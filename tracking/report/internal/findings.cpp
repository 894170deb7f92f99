#include "tracking/report/internal/findings.h"

#include <algorithm>
#include <cmath>

namespace swarmsmith {
namespace {

double mean_shift(const TagCorners& before, const TagCorners& now) {
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    sum += std::hypot(now[i].u - before[i].u, now[i].v - before[i].v);
  return sum / static_cast<double>(before.size());
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

template <class Map>
const typename Map::mapped_type* item_of(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace

CycleCounts cycle_counts(const TrackedRobot& robot) {
  CycleCounts counts;
  for (const CycleKind kind : robot.cycles) {
    switch (kind) {
      case CycleKind::Measured:
        ++counts.measured;
        break;
      case CycleKind::Interpolated:
        ++counts.interpolated;
        break;
      case CycleKind::Degraded:
        ++counts.degraded;
        break;
      case CycleKind::Missing:
        ++counts.missing;
        break;
    }
  }
  return counts;
}

std::map<Sample::Use, std::int64_t> sample_counts(const TrackedRobot& robot) {
  std::map<Sample::Use, std::int64_t> counts;
  for (const Sample& sample : robot.samples)
    ++counts[sample.use];
  return counts;
}

CameraFinding camera_finding(const ReportedRun& run, const CameraRecord& record) {
  CameraFinding finding;
  for (const CameraSetup& setup : run.rig.cameras)
    if (setup.name == record.camera) finding.setup = &setup;
  if (finding.setup != nullptr) {
    finding.calibration = item_of(run.rig.models, finding.setup->model_file);
    finding.place = item_of(run.rig.places, finding.setup->place_file);
  }
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
    const double shift = of_tags.empty() ? 0 : median_of(of_tags);
    if (shift <= finding.worst_shift_px) continue;
    finding.worst_shift_px = shift;
    finding.worst_shift_at_s = time;
  }
  for (const auto& [id, tag] : tags)
    finding.references.push_back(tag);
  return finding;
}

const RobotLog* log_of(const ReportedRun& run, std::size_t robot) {
  const auto found =
      std::ranges::find(run.observations.logs, run.tracked.robots[robot].name, &RobotLog::robot);
  return found == run.observations.logs.end() ? nullptr : &*found;
}

Verdict counting_verdict(const ReportedRun& run) {
  return run.overrides.empty() ? run.scored.verdict : run.overrides.back().verdict;
}

}  // namespace swarmsmith
