#include "tracking/calibration/solve_place.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/median.h"
#include "tracking/rig/lens_reach.h"

namespace swarmsmith {
namespace {

/// Tags count as being on one line if their spread across the line is less than this share of their
/// spread along it.
constexpr double kThin = 0.1;

std::string list_of_ids(const std::vector<int>& ids) {
  return ids.empty() ? std::string("none") : fmt::format("{}", fmt::join(ids, ", "));
}

/// Text with the seen and missing tags: "; seen: 100, 101; missing: 102".
std::string seen_and_missing(const PlaceQuestion& question) {
  std::vector<int> seen;
  for (const SeenTag& tag : question.seen)
    seen.push_back(tag.tag.tag);
  std::vector<int> missing;
  for (const ReferenceTag& tag : question.survey) {
    if (std::ranges::find(seen, tag.tag) == seen.end()) missing.push_back(tag.tag);
  }
  return "; seen: " + list_of_ids(seen) + "; missing: " + list_of_ids(missing);
}

bool are_in_line(const std::vector<SeenTag>& seen) {
  // Sums are used instead of one large matrix, because Eigen's product of dynamic size takes ten
  // seconds to compile.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const SeenTag& tag : seen)
    middle += Eigen::Vector2d(tag.tag.pose.x, tag.tag.pose.y);
  middle /= static_cast<double>(seen.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const SeenTag& tag : seen) {
    const Eigen::Vector2d off = Eigen::Vector2d(tag.tag.pose.x, tag.tag.pose.y) - middle;
    spread += off * off.transpose();
  }
  // Squared spreads along the two principal axes.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  return !(axes.eigenvalues()(0) > kThin * kThin * axes.eigenvalues()(1));
}

/// The share of the arena within the seen floor tags.
double coverage_of(const PlaceQuestion& question, const View& view) {
  std::vector<ReferenceTag> tags;
  for (const SeenTag& seen : question.seen)
    tags.push_back(seen.tag);
  return share_within_tags(tags, view, question.arena);
}

/// Root mean square error of a tag's corners on the floor, for a view.
double floor_error(const SeenTag& seen, const View& view) {
  const std::vector<Point> found = on_plane(view, seen.corners, 0);
  const std::array<Point, 4> wanted = corners_of(seen.tag);
  double squares = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    squares += std::pow(found[i].x - wanted[i].x, 2) + std::pow(found[i].y - wanted[i].y, 2);
  return std::sqrt(squares / 4);
}

/// Solves the place again without each of the tags.
void leave_out(const PlaceQuestion& question, PlaceCalibration& calibration) {
  std::size_t farthest = 0;
  std::size_t suspect = 0;
  double least_rms = 0;
  for (std::size_t i = 0; i < question.seen.size(); ++i) {
    std::vector<SeenTag> others = question.seen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const auto fit = fit_place(others, question.camera);
    // If the other tags fit no place at all, leaving this tag out is no improvement.
    const double rms = fit ? fit->rms_px : 1e9;
    PlaceCalibration::Seen& seen = calibration.tags[i];
    seen.left_out_m = fit ? floor_error(question.seen[i], {question.camera, fit->place}) : 1e9;
    if (i == 0 || rms < least_rms) {
      suspect = i;
      least_rms = rms;
    }
    if (seen.left_out_m > calibration.tags[farthest].left_out_m) farthest = i;
  }
  calibration.worst_left_out_m = calibration.tags[farthest].left_out_m;
  // A wrong tag distorts the fits without the other tags, so the error of another tag may be
  // larger.
  const bool is_wrong = calibration.worst_left_out_m > question.limits.left_out_m ||
                        calibration.rms_px > rms_limit_px(calibration, question.limits);
  calibration.worst_tag = question.seen[is_wrong ? suspect : farthest].tag.tag;
}

}  // namespace

std::vector<SeenTag> median_of_looks(const std::vector<std::vector<TagLook>>& looks,
                                     std::span<const ReferenceTag> survey) {
  std::vector<SeenTag> medians;
  for (const ReferenceTag& tag : survey) {
    std::array<std::vector<double>, 8> values;
    for (const auto& look : looks) {
      const auto same = [&](const TagLook& seen) { return seen.tag == tag.tag; };
      // A tag that appears twice in one look is not used.
      if (std::ranges::count_if(look, same) != 1) continue;
      const TagCorners& corners = std::ranges::find_if(look, same)->corners;
      for (std::size_t k = 0; k < 4; ++k) {
        values[2 * k].push_back(corners[k].u);
        values[2 * k + 1].push_back(corners[k].v);
      }
    }
    if (values[0].empty() || 4 * values[0].size() < looks.size()) continue;
    SeenTag seen{tag, {}};
    for (std::size_t k = 0; k < 4; ++k)
      seen.corners[k] = {median_of(values[2 * k]), median_of(values[2 * k + 1])};
    medians.push_back(seen);
  }
  std::ranges::sort(medians, {}, [](const SeenTag& seen) { return seen.tag.tag; });
  return medians;
}

Expected<PlaceCalibration> solve_place(const PlaceQuestion& question) {
  const auto refuse = [&](IssueCode code, const std::string& text) {
    return Unexpected(error_of(code, text + seen_and_missing(question), ""));
  };
  const auto count = static_cast<int>(question.seen.size());
  if (count < question.limits.least_tags) {
    return refuse(IssueCode::ReferenceTags,
                  fmt::format("the camera sees {} of the surveyed floor tags, but at least {} are "
                              "needed; check their ids and the family in the arena file, the "
                              "light, and that nothing covers them",
                              count, question.limits.least_tags));
  }
  // Tags in one line hardly determine the camera's tilt about this line.
  if (are_in_line(question.seen)) {
    return refuse(IssueCode::ReferenceTags,
                  "the visible floor tags lie in one line; put some beside it, near the walls");
  }
  const auto fit = fit_place(question.seen, question.camera);
  if (!fit) {
    return refuse(IssueCode::Extrinsics,
                  "no camera place above the floor fits the floor tags; check x, y, angle and edge "
                  "of each in the arena file");
  }
  const View view{question.camera, fit->place};
  PlaceCalibration calibration;
  calibration.place = fit->place;
  calibration.rms_px = fit->rms_px;
  for (const SeenTag& seen : question.seen)
    calibration.tags.push_back(
        {seen.tag, seen.corners, std::sqrt(squares_off(view, seen.tag, seen.corners) / 4), 0});
  calibration.coverage = coverage_of(question, view);
  leave_out(question, calibration);
  // A bad fit is reported first, because the coverage of a wrong place means nothing.
  std::vector<Error> faults = faults_of(calibration, question.limits);
  const auto is_fit = [](const Error& e) { return e.message.starts_with("E_EXTRINSICS"); };
  std::stable_partition(faults.begin(), faults.end(), is_fit);
  if (!faults.empty()) {
    faults.front().message += seen_and_missing(question);
    return Unexpected(faults.front());
  }
  return calibration;
}

PlaceQuestion question_again(const PlaceCalibration& old, PlaceQuestion now) {
  now.seen.clear();
  for (const PlaceCalibration::Seen& seen : old.tags) {
    const auto surveyed = std::ranges::find(now.survey, seen.tag.tag, &ReferenceTag::tag);
    if (surveyed != now.survey.end()) now.seen.push_back({*surveyed, seen.corners});
  }
  return now;
}

}  // namespace swarmsmith
