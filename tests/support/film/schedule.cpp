#include "tests/support/film/schedule.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "base/text/csv.h"

namespace swarmsmith::film {

std::vector<ShotFrame> frames_of(const Schedule& schedule, Rng rng) {
  Rng drops = rng.split("drops");
  Rng twice = rng.split("twice");
  Rng jitter = rng.split("jitter");
  const auto count = static_cast<std::int64_t>(std::ceil(
                         (schedule.until_s - schedule.from_s) * schedule.rate_hz - 1e-9)) +
                     1;
  std::vector<ShotFrame> frames;
  for (std::int64_t turn = 0; turn < count; ++turn) {
    const double nominal_s = schedule.from_s + static_cast<double>(turn) / schedule.rate_hz;
    // A frame is late or early by less than half its turn.
    const double most_s = 0.4 / schedule.rate_hz;
    const double late_s = std::clamp(jitter.normal(0, schedule.jitter_s), -most_s, most_s);
    // The camera's clock begins with the first frame.
    const double true_s = nominal_s + (turn == 0 ? std::fabs(late_s) : late_s);
    const bool dropped =
        drops.bernoulli(schedule.drop_share) ||
        std::any_of(schedule.drops.begin(), schedule.drops.end(),
                    [&](const Stretch& s) { return s.from_s <= true_s && true_s < s.until_s; });
    const bool repeated = twice.bernoulli(schedule.twice_share);
    if (dropped && turn != 0 && turn != count - 1) continue;
    ShotFrame frame{true_s, true_s + schedule.clock_ahead_s, turn};
    if (schedule.counts_frames)
      frame.stamp_s = static_cast<double>(frames.size()) / schedule.rate_hz;
    if (repeated && !frames.empty()) {
      frame.true_s = frames.back().true_s;
      frame.picture = frames.back().picture;
    }
    frames.push_back(frame);
  }
  return frames;
}

std::vector<ShotFrame> frames_of_clock(const std::string& sidecar, double start_clock_s) {
  const auto table = parse_csv(sidecar, "frame times");
  if (!table) throw std::runtime_error(to_string(table.error().front()));
  std::vector<ShotFrame> frames;
  for (const CsvRow& row : table->rows) {
    const auto clock_s = number_in(cell_of(*table, row, "clock_s"));
    const auto stamp_s = number_in(cell_of(*table, row, "time_s"));
    if (!clock_s || !stamp_s) throw std::runtime_error(table->place(row) + ": no time");
    frames.push_back(
        {*clock_s - start_clock_s, *stamp_s, static_cast<std::int64_t>(frames.size())});
  }
  return frames;
}

std::string frame_times_csv(const std::vector<ShotFrame>& frames) {
  std::string text = "frame,time_s\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "%zu,%.6f\n", i, frames[i].stamp_s);
    text += line;
  }
  return text;
}

}  // namespace swarmsmith::film
