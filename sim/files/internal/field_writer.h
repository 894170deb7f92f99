#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/toml_text.h"
#include "sim/engine/profile_fields.h"
#include "sim/files/color_text.h"
#include "sim/files/internal/arena_text.h"
#include "sim/files/internal/read_profile.h"
#include "sim/robot/robot_fields.h"

namespace swarmsmith {

/// The visitor that writes the fields of a profile or a robot as lines.
class FieldWriter {
 public:
  /// `ranges` holds the numbers that are written as ranges.
  FieldWriter(std::vector<Section>& sections, std::string header,
              std::vector<FieldRange> ranges = {})
      : sections_(&sections), header_(std::move(header)), ranges_(std::move(ranges)) {
    sections_->push_back({"[" + header_ + "]", header_ + ".", {}});
  }

  void device(std::string_view name) {
    const std::string path = header_ + "." + std::string(name);
    device_name_ = std::string(name) + ".";
    drop_empty();
    sections_->push_back({"[" + path + "]", path + ".", {}});
  }
  /// A device without values gets no header. Must also be called after the visit.
  void drop_empty() {
    if (sections_->back().lines.empty()) sections_->pop_back();
  }
  void number(std::string_view key, double value, FieldLimits) {
    const std::string field = device_name_ + std::string(key);
    const auto range = std::ranges::find(ranges_, field, &FieldRange::field);
    if (range == ranges_.end()) {
      if (!ranges_alone_) add(key, number_text(value));
      return;
    }
    const std::string ends =
        "[" + number_text(range->least) + ", " + number_text(range->most) + "]";
    add(key, range->of_run ? "{ run = " + ends + " }" : ends);
  }
  void flag(std::string_view key, bool value) { add(key, flag_text(value)); }
  template <class Value>
  void choice(std::string_view key, Value value, const FieldChoices<Value>& choices) {
    if (!ranges_alone_) add(key, quoted_text(word_of(value, choices)));
  }
  void colors(std::string_view key, const std::vector<Rgb>& colors) {
    add(key, "[" + list_of(colors, [](Rgb c) { return quoted_text(color_text(c)); }) + "]");
  }
  void delays(std::string_view key, const std::vector<ControlTiming::Delay>& delays) {
    add(key, "[" + list_of(delays, [](const ControlTiming::Delay& delay) {
               return "{ time = " + time_text(delay.sub_steps) +
                      ", probability = " + number_text(delay.probability) + " }";
             }) + "]");
  }
  void beat(std::string_view key, int sub_steps) {
    if (!ranges_alone_) add(key, time_text(sub_steps));
  }
  template <class Visit>
  void later(bool is_ideal, const Visit& visit) {
    ranges_alone_ = is_ideal;
    visit();
    ranges_alone_ = false;
  }
  template <class Visit>
  void only(const FieldUse& /*use*/, const Visit& visit) {
    visit();
  }
  void period(std::string_view key, double least, double most) {
    add(key, "[" + period_text(least) + ", " + period_text(most) + "]");
  }
  void point(std::string_view key, Point point, FieldLimits) {
    add(key, "[" + number_text(point.x) + ", " + number_text(point.y) + "]");
  }

  void outline(const Outline& outline) {
    for (const SectionLine& line : outline_lines(outline))
      sections_->back().lines.push_back(line);
  }
  void angles(std::string_view key, const std::vector<double>& angles) {
    add(key, "[" + list_of(angles, number_text) + "]");
  }
  void numbers(std::string_view key, const std::array<double, 3>& numbers, FieldLimits) {
    add(key, "[" + list_of(numbers, number_text) + "]");
  }
  void points(std::string_view key, const std::vector<Point>& points) {
    add(key, point_list(points));
  }
  void count(std::string_view key, int value, int, int) { add(key, std::to_string(value)); }

  /// For a later field that is ideal, only a range is written.
  void add(std::string_view key, std::string value) {
    sections_->back().lines.push_back({std::string(key), std::move(value)});
  }

 private:
  static std::string time_text(int sub_steps) {
    return "\"" + std::to_string(10 * sub_steps) + " ms\"";
  }
  static std::string period_text(double factor) {
    return "\"" + number_text(std::round(factor * kMicroseconds_per_period) / 1000) + " ms\"";
  }

  std::vector<Section>* sections_;
  std::string header_;
  std::vector<FieldRange> ranges_;
  std::string device_name_;
  bool ranges_alone_ = false;
};

}  // namespace swarmsmith
