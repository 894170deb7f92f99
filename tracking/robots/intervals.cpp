#include "tracking/robots/intervals.h"

#include <map>
#include <utility>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr double kLongestGap_s = 0.25;

}  // namespace

std::vector<SeenInterval> intervals_of(std::span<const Sample> seen, double until_s) {
  std::vector<SeenInterval> intervals;
  std::map<int, const Sample*> last;
  for (const Sample& sample : seen) {
    if (sample.use != Sample::Use::Used || sample.time_s > until_s) continue;
    const Sample* before = std::exchange(last[sample.camera], &sample);
    if (before == nullptr) continue;
    const double gap_s = sample.time_s - before->time_s;
    if (gap_s <= 0 || gap_s > kLongestGap_s) continue;
    const double turn = wrap_angle(sample.pose.theta - before->pose.theta);
    const SinCos heading = sin_cos(before->pose.theta + turn / 2);
    const double x = sample.pose.x - before->pose.x;
    const double y = sample.pose.y - before->pose.y;
    intervals.push_back({before->time_s, sample.time_s, x * heading.cos + y * heading.sin,
                         y * heading.cos - x * heading.sin, turn});
  }
  return intervals;
}

}  // namespace swarmsmith
