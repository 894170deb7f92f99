#include "sim/engine/profile.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/engine/profile_fields.h"

namespace swarmsmith {
namespace {

/// The visitor that puts drawn numbers into a profile.
class RangeDrawer {
 public:
  RangeDrawer(const std::vector<FieldRange>& ranges, const Rng& run, int robot)
      : ranges_(&ranges), run_(&run), robot_(static_cast<std::uint64_t>(robot)) {}

  void device(std::string_view name) { device_ = std::string(name) + "."; }
  void number(std::string_view key, double& value, FieldLimits) {
    const auto range = std::ranges::find(*ranges_, device_ + std::string(key), &FieldRange::field);
    if (range == ranges_->end()) return;
    // Each range has its own stream: one more range does not change the numbers of the others. That
    // of a run does not depend on the robot, so all robots draw the same number.
    Rng stream = range->of_run ? run_->split("run " + range->field)
                               : run_->split("robot " + range->field, robot_);
    value = stream.uniform(range->least, range->most);
  }
  template <class Visit>
  void later(bool /*is_ideal*/, const Visit& visit) {
    visit();
  }
  template <class Visit>
  void only(const FieldUse& /*use*/, const Visit& visit) {
    visit();
  }
  // Only numbers have ranges.
  void flag(std::string_view, bool) {}
  template <class Value, class Choices>
  void choice(std::string_view, Value, const Choices&) {}
  template <class Value>
  void colors(std::string_view, const Value&) {}
  template <class Value>
  void delays(std::string_view, const Value&) {}
  void beat(std::string_view, int) {}
  void period(std::string_view, double, double) {}
  void point(std::string_view, const Point&, FieldLimits) {}

 private:
  const std::vector<FieldRange>* ranges_;
  const Rng* run_;
  std::uint64_t robot_;
  std::string device_;
};

}  // namespace

std::vector<Rgb> GroundColorSensing::default_labels() {
  std::vector<Rgb> labels;
  labels.reserve(std::size(kNamedColors));
  for (const NamedColor& named : kNamedColors)
    labels.push_back(named.color);
  return labels;
}

Profile drawn_profile(const Profile& profile, const Rng& run, int robot) {
  Profile drawn = profile;
  drawn.ranges.clear();
  RangeDrawer drawer(profile.ranges, run, robot);
  visit_profile_fields(drawn, drawer);
  return drawn;
}

}  // namespace swarmsmith
