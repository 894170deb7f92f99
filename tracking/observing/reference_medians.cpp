#include "tracking/observing/reference_medians.h"

#include <cmath>
#include <utility>

#include "base/median.h"

namespace swarmsmith {
namespace {

TagCorners medians_of(const std::vector<TagCorners>& looks) {
  TagCorners result;
  std::vector<double> u(looks.size());
  std::vector<double> v(looks.size());
  for (std::size_t corner = 0; corner < result.size(); ++corner) {
    for (std::size_t i = 0; i < looks.size(); ++i) {
      u[i] = looks[i][corner].u;
      v[i] = looks[i][corner].v;
    }
    result[corner] = {median_of(u), median_of(v)};
  }
  return result;
}

}  // namespace

void ReferenceMedians::add(double time_s, int tag, const TagCorners& corners) {
  if (!first_s_.has_value()) first_s_ = time_s;
  const auto span = static_cast<std::int64_t>(std::floor((time_s - *first_s_) / span_s_));
  if (span != span_) close_span(*first_s_ + static_cast<double>(span_ + 1) * span_s_);
  span_ = span;
  last_s_ = time_s;
  seen_[tag].push_back(corners);
}

void ReferenceMedians::close_span(double until_s) {
  const double from_s = *first_s_ + static_cast<double>(span_) * span_s_;
  const double middle_s = (from_s + until_s) / 2;
  for (const auto& [tag, looks] : seen_)
    looks_.push_back({middle_s, tag, medians_of(looks), static_cast<int>(looks.size())});
  seen_.clear();
}

std::vector<ReferenceLook> ReferenceMedians::take() {
  // The last span of a video is shorter.
  if (first_s_.has_value()) close_span(last_s_);
  return std::exchange(looks_, {});
}

}  // namespace swarmsmith
