#include "tracking/motion/internal/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {
namespace {

/// A chain of this length is a track and not a stray detection.
constexpr std::size_t kEstablished = 5;
/// Samples farther apart in time are not used to detect jumps.
constexpr double kWindow_s = 0.5;

/// Indices of samples, in order of time.
using Chain = std::vector<std::size_t>;

/// Whether a chain has all samples since another chain ended. As time passes, every place comes
/// within reach of the other chain's end, even the place of a tag that was moved to another robot.
bool has_taken_over(const Chain& chain, const Chain& from) {
  constexpr std::size_t kNoStray = 3;
  return chain.size() >= kNoStray && chain.front() > from.back();
}

/// Whether a chain is the better one for the next sample: established chains first, then the chain
/// that was seen last.
bool is_better(const Chain& a, const Chain& b) {
  SWARMSMITH_ASSERT(!a.empty() && !b.empty(), "a chain begins with a sample");
  if (has_taken_over(a, b)) return true;
  if (has_taken_over(b, a)) return false;
  const bool a_sure = a.size() >= kEstablished;
  const bool b_sure = b.size() >= kEstablished;
  return a_sure != b_sure ? a_sure : a.back() > b.back();
}

std::vector<Chain> chains_of(const std::vector<TimedPose>& track, const TrackLimits& limits) {
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < track.size(); ++i) {
    Chain* best = nullptr;
    for (Chain& chain : chains) {
      if (!is_reachable(track[chain.back()], track[i], limits)) continue;
      if (best == nullptr || is_better(chain, *best)) best = &chain;
    }
    if (best == nullptr) best = &chains.emplace_back();
    best->push_back(i);
  }
  return chains;
}

/// Whether a chain is compatible with one that is kept. Two chains that overlap in time cannot both
/// be the robot. If one cannot be reached from the other, it stays only if it is an established
/// track (the robot was carried, or is another one); then the break between them is a gap.
bool agrees(const Chain& chain, const Chain& kept, const std::vector<TimedPose>& track,
            const TrackLimits& limits) {
  SWARMSMITH_ASSERT(chain.size() <= kept.size(), "the longest come first");
  const bool is_first = chain.back() < kept.front();
  if (!is_first && chain.front() < kept.back()) return false;
  if (chain.size() >= kEstablished) return true;
  return is_first ? is_reachable(track[chain.back()], track[kept.front()], limits)
                  : is_reachable(track[kept.back()], track[chain.front()], limits);
}

/// The samples of the compatible chains, chosen in order of length.
Chain longest_chains(const std::vector<TimedPose>& track, const TrackLimits& limits) {
  std::vector<Chain> chains = chains_of(track, limits);
  std::ranges::stable_sort(chains, std::ranges::greater{}, &Chain::size);
  std::vector<Chain> kept;
  for (const Chain& chain : chains) {
    const bool stands = std::ranges::all_of(
        kept, [&](const Chain& other) { return agrees(chain, other, track, limits); });
    if (stands) kept.push_back(chain);
  }
  Chain samples;
  for (const Chain& chain : kept)
    samples.insert(samples.end(), chain.begin(), chain.end());
  std::ranges::sort(samples);
  SWARMSMITH_ASSERT(std::ranges::adjacent_find(samples) == samples.end(),
                    "a sample is in one chain");
  return samples;
}

double median(std::array<double, 5>& values, std::size_t count) {
  SWARMSMITH_ASSERT(count % 2 == 1 && count <= values.size(), "as many on each side");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// Number of samples on each side of the `at`th that are near enough in time: at most two, and
/// equal on both sides, because a one-sided median lags behind a moving robot.
std::size_t half_window(const std::vector<TimedPose>& track, const Chain& samples, std::size_t at) {
  const auto time = [&](std::size_t i) { return track[samples[i]].time_s; };
  std::size_t half = 0;
  while (half < 2 && at > half && at + half + 1 < samples.size() &&
         time(at) - time(at - half - 1) <= kWindow_s &&
         time(at + half + 1) - time(at) <= kWindow_s) {
    ++half;
  }
  return half;
}

bool jumps(const std::vector<TimedPose>& track, const Chain& samples, std::size_t at,
           const TrackLimits& limits) {
  const std::size_t half = half_window(track, samples, at);
  std::array<double, 5> xs{};
  std::array<double, 5> ys{};
  SWARMSMITH_ASSERT(half <= at && at + half < samples.size(), "the window lies in the track");
  const std::size_t count = 2 * half + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Pose& pose = track[samples[at - half + i]].pose;
    xs.at(i) = pose.x;
    ys.at(i) = pose.y;
  }
  const Pose& here = track[samples[at]].pose;
  return hypot(here.x - median(xs, count), here.y - median(ys, count)) > limits.jump_m;
}

}  // namespace

std::vector<bool> believable(const std::vector<TimedPose>& track, const TrackLimits& limits) {
  std::vector<bool> believed(track.size(), false);
  const Chain samples = longest_chains(track, limits);
  for (std::size_t i = 0; i < samples.size(); ++i)
    believed[samples[i]] = !jumps(track, samples, i, limits);
  return believed;
}

}  // namespace swarmsmith
