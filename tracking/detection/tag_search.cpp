#include "tracking/detection/tag_search.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace swarmsmith {
namespace {

/// At half resolution, smaller tags are read only two out of three times (tracking facts, section
/// 6, pixel budget).
constexpr double kLeastEdgeForHalfPx = 36;

/// Shortest time between searches of the whole frame for missing tags.
constexpr double kLeastPatience_s = 0.1;

/// A tag that was too faint for half resolution is read at full resolution for this time.
constexpr double kFineFor_s = 1;

/// Two sightings give a speed only if they are at most this far apart in time.
constexpr double kSpeedKnownFor_s = 0.5;

double length(const ImagePoint& a, const ImagePoint& b) {
  return std::hypot(a.u - b.u, a.v - b.v);
}

double diagonal_of(const TagCorners& c) {
  return std::max(length(c[0], c[2]), length(c[1], c[3]));
}

double edge_of(const TagCorners& c) {
  return std::min({length(c[0], c[1]), length(c[1], c[2]), length(c[2], c[3]), length(c[3], c[0])});
}

PixelBox box_about(const ImagePoint& centre, double half) {
  return {static_cast<int>(std::floor(centre.u - half)),
          static_cast<int>(std::floor(centre.v - half)),
          static_cast<int>(std::ceil(centre.u + half)) + 1,
          static_cast<int>(std::ceil(centre.v + half)) + 1};
}

bool contains(const std::vector<Detection>& seen, int tag) {
  return std::any_of(seen.begin(), seen.end(), [&](const Detection& d) { return d.tag == tag; });
}

/// Adds a detection unless it is already in the list: windows overlap with each other and with the
/// whole frame.
void add_new(const Detection& detection, std::vector<Detection>& seen) {
  const double same_px = diagonal_of(detection.corners) / 2;
  const ImagePoint centre = middle_of(detection.corners);
  const bool is_there = std::any_of(seen.begin(), seen.end(), [&](const Detection& other) {
    return other.tag == detection.tag && length(middle_of(other.corners), centre) < same_px;
  });
  if (!is_there) seen.push_back(detection);
}

/// Searches at full resolution are expensive; for a tag that stays missing they are done only now
/// and then.
bool is_worth_a_second_look(int misses) {
  return misses < 4 || misses % 8 == 0;
}

}  // namespace

TagSearch::TagSearch(TagDetector detector, TagSearchOptions options)
    : detector_(std::move(detector)), options_(std::move(options)) {}

bool TagSearch::accepts(const Detection& detection) const {
  const int most = options_.expected.contains(detection.tag) ? options_.most_hamming : 0;
  return detection.hamming <= most && detection.margin >= options_.least_margin;
}

bool TagSearch::is_small(const Followed& tag) {
  return tag.edge_px < kLeastEdgeForHalfPx;
}

bool TagSearch::full_is_due(double time_s) const {
  if (!last_full_s_.has_value()) return true;
  const double every_s = missing_.empty() ? options_.full_search_every_s
                                          : std::min(patience_s_, options_.full_search_every_s);
  return time_s - *last_full_s_ >= every_s;
}

void TagSearch::search_whole(const GrayImage& image, double time_s, std::vector<Detection>& seen) {
  const bool has_small = std::any_of(followed_.begin(), followed_.end(),
                                     [&](const auto& each) { return is_small(each.second); });
  // The first frame is searched at full resolution, because its tags may be of any size. While tags
  // are missing, so is every fourth whole frame that is searched, beginning with the second one:
  // the missing tags may be small, or the light poor.
  const bool is_first = full_searches_ == 0;
  const int decimate = is_first || has_small || passes_in_vain_ % 4 == 1 ? 1 : 2;
  for (const Detection& each : detector_.find(image, decimate))
    if (accepts(each)) add_new(each, seen);
  last_full_s_ = time_s;
  ++full_searches_;
}

bool TagSearch::take_window(const GrayImage& image, const PixelBox& box, int decimate, int tag,
                            std::vector<Detection>& seen) {
  bool found = false;
  for (const Detection& each : detector_.find(image, box, decimate)) {
    if (!accepts(each)) continue;
    found = found || each.tag == tag;
    add_new(each, seen);
  }
  return found;
}

bool TagSearch::search_window(const GrayImage& image, double time_s, int tag, Followed& followed,
                              std::vector<Detection>& seen) {
  const double since_s = time_s - followed.seen_s;
  // The window of a hidden tag must not grow to the whole frame.
  const double most_px = 2 * followed.diagonal_px;
  const ImagePoint moved{std::clamp(followed.speed.u * since_s, -most_px, most_px),
                         std::clamp(followed.speed.v * since_s, -most_px, most_px)};
  const double motion_px = std::hypot(moved.u, moved.v);
  const ImagePoint predicted{followed.centre.u + moved.u, followed.centre.v + moved.v};
  const double half_px = 0.75 * followed.diagonal_px + 10 + motion_px;
  const bool fine = is_small(followed) || time_s < followed.fine_until_s;
  if (take_window(image, box_about(predicted, half_px), fine ? 1 : 2, tag, seen)) return true;
  if (!is_worth_a_second_look(followed.misses)) return false;
  const double larger_px = 1.5 * followed.diagonal_px + 20 + 2 * motion_px;
  if (!take_window(image, box_about(predicted, larger_px), 1, tag, seen)) return false;
  followed.fine_until_s = time_s + kFineFor_s;
  return true;
}

void TagSearch::search_windows(const GrayImage& image, double time_s,
                               std::vector<Detection>& seen) {
  for (auto& [tag, followed] : followed_) {
    if (contains(seen, tag)) continue;
    if (options_.still.contains(tag) &&
        time_s - followed.searched_s < options_.still_search_every_s)
      continue;
    followed.searched_s = time_s;
    followed.misses = search_window(image, time_s, tag, followed, seen) ? 0 : followed.misses + 1;
  }
}

void TagSearch::follow(double time_s, const std::vector<Detection>& seen) {
  for (const int tag : options_.expected) {
    auto known = followed_.find(tag);
    const Detection* best = nullptr;
    double best_px = 0;
    for (const Detection& each : seen) {
      if (each.tag != tag) continue;
      // If a tag is seen twice, follow the one nearer to the expected place.
      const double off_px = known == followed_.end()
                                ? -each.margin
                                : length(middle_of(each.corners), known->second.centre);
      if (best == nullptr || off_px < best_px) {
        best = &each;
        best_px = off_px;
      }
    }
    if (best == nullptr) continue;
    Followed next;
    next.centre = middle_of(best->corners);
    next.diagonal_px = diagonal_of(best->corners);
    next.edge_px = edge_of(best->corners);
    next.seen_s = time_s;
    next.searched_s = time_s;
    if (known != followed_.end()) {
      const Followed& last = known->second;
      const double since_s = time_s - last.seen_s;
      if (since_s > 0 && since_s <= kSpeedKnownFor_s)
        next.speed = {(next.centre.u - last.centre.u) / since_s,
                      (next.centre.v - last.centre.v) / since_s};
      next.fine_until_s = last.fine_until_s;
    }
    followed_[tag] = next;
  }
}

std::set<int> TagSearch::missing_from(const std::vector<Detection>& seen) const {
  std::set<int> missing;
  for (const int tag : options_.expected) {
    const bool lies_there = options_.still.contains(tag) && followed_.contains(tag);
    if (!lies_there && !contains(seen, tag)) missing.insert(tag);
  }
  return missing;
}

std::vector<Detection> TagSearch::find(const GrayImage& image, double time_s) {
  std::vector<Detection> seen;
  bool is_whole = full_is_due(time_s);
  if (is_whole) search_whole(image, time_s, seen);
  search_windows(image, time_s, seen);
  std::set<int> missing = missing_from(seen);
  const bool is_news =
      !std::includes(missing_.begin(), missing_.end(), missing.begin(), missing.end());
  if (is_news) {
    passes_in_vain_ = 0;
    patience_s_ = kLeastPatience_s;
    if (!is_whole && time_s - *last_full_s_ >= kLeastPatience_s) {
      is_whole = true;
      search_whole(image, time_s, seen);
      missing = missing_from(seen);
    }
  }
  if (missing.empty()) {
    passes_in_vain_ = 0;
  } else if (is_whole) {
    ++passes_in_vain_;
    if (!is_news) patience_s_ *= 2;
  }
  missing_ = std::move(missing);
  follow(time_s, seen);
  std::sort(seen.begin(), seen.end(), [](const Detection& a, const Detection& b) {
    return std::tuple(a.tag, -a.margin, a.corners[0].u, a.corners[0].v) <
           std::tuple(b.tag, -b.margin, b.corners[0].u, b.corners[0].v);
  });
  return seen;
}

}  // namespace swarmsmith
