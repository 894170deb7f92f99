#include "sim/files/internal/score_text.h"

#include <string>

#include "base/text/table_reader.h"
#include "sim/files/color_text.h"

namespace swarmsmith {
namespace {

/// A parameter as TOML.
struct ValueText {
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(int value) const { return std::to_string(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(Rgb value) const { return quoted_text(color_text(value)); }
  std::string operator()(When value) const { return quoted_text(name_of(value)); }
  std::string operator()(const std::string& value) const { return quoted_text(value); }

  /// An inline table, in the rule's own order.
  std::string operator()(const std::vector<Reward>& value) const {
    std::string text;
    for (const Reward& reward : value) {
      text +=
          (text.empty() ? "" : ", ") + color_key(reward.color) + " = " + number_text(reward.reward);
    }
    return "{ " + text + " }";
  }
};

}  // namespace

std::vector<SectionLine> score_lines(const ScoreRule& rule) {
  std::vector<SectionLine> lines = {{"kind", quoted_text(kind_of(rule))}};
  const auto add = [&](const ScoreField& field, const auto& value) {
    lines.push_back({std::string(field.key), ValueText()(value)});
  };
  visit_fields(rule, add);
  return lines;
}

}  // namespace swarmsmith
