#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sim/engine/profile_fields.h"
#include "sim/files/color_text.h"
#include "sim/files/internal/read_profile.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

/// The visitor that writes the fields of a profile as lines.
class FieldWriter {
 public:
  FieldWriter(std::vector<Section>& sections, std::string header)
      : sections_(&sections), header_(std::move(header)) {
    sections_->push_back({"[" + header_ + "]", header_ + ".", {}});
  }

  void device(std::string_view name) {
    const std::string path = header_ + "." + std::string(name);
    drop_empty();
    sections_->push_back({"[" + path + "]", path + ".", {}});
  }
  /// A device without values has no header; to be called after the visit, too.
  void drop_empty() {
    if (sections_->back().lines.empty()) sections_->pop_back();
  }
  void number(std::string_view key, double value, FieldLimits) { add(key, number_text(value)); }
  void flag(std::string_view key, bool value) { add(key, flag_text(value)); }
  template <class Value>
  void choice(std::string_view key, Value value, const FieldChoices<Value>& choices) {
    add(key, quoted_text(word_of(value, choices)));
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
  void beat(std::string_view key, int sub_steps) { add(key, time_text(sub_steps)); }
  template <class Visit>
  void later(bool is_ideal, const Visit& visit) {
    if (!is_ideal) visit();
  }
  void period(std::string_view key, double least, double most) {
    add(key, "[" + period_text(least) + ", " + period_text(most) + "]");
  }
  void point(std::string_view key, Point point, FieldLimits) {
    add(key, "[" + number_text(point.x) + ", " + number_text(point.y) + "]");
  }

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
};

}  // namespace

std::vector<Section> profile_sections(const Profile& profile, const std::string& header,
                                      bool in_list) {
  std::vector<Section> sections;
  FieldWriter writer(sections, header);
  writer.add("name", quoted_text(profile.name));
  visit_profile_fields(profile, writer);
  writer.drop_empty();
  if (in_list) sections.front().header = "[[" + header + "]]";
  return sections;
}

}  // namespace swarmsmith
