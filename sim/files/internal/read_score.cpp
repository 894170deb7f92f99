#include "sim/files/internal/read_mission.h"

#include <cstdint>
#include <string>
#include <vector>

#include "base/suggestion.h"
#include "sim/files/internal/read_color.h"

namespace swarmsmith {
namespace {

/// Reads the parameters of any kind of score, by the keys that its fields name.
class ScoreReader {
 public:
  ScoreReader(TableReader& table, std::string kind) : table_(table), kind_(std::move(kind)) {}

  void operator()(const ScoreField& field, double& value) {
    need(field, "1");
    value = table_.number(field.key, {field.least, field.most}).value_or(value);
  }

  void operator()(const ScoreField& field, int& value) {
    need(field, "1");
    const Limits<std::int64_t> limits{static_cast<std::int64_t>(field.least),
                                      static_cast<std::int64_t>(field.most)};
    value = static_cast<int>(table_.integer(field.key, limits).value_or(value));
  }

  void operator()(const ScoreField& field, bool& value) {
    need(field, "true");
    value = table_.boolean(field.key).value_or(value);
  }

  void operator()(const ScoreField& field, Rgb& value) {
    need(field, "\"black\"");
    if (table_.has(field.key)) {
      value = read_color(table_, field.key).value_or(value);
    } else {
      table_.take(field.key);
    }
  }

  void operator()(const ScoreField& field, When& value) {
    need(field, "\"end\"");
    static const std::vector<std::string> kNames(kWhenNames.begin(), kWhenNames.end());
    const auto name = table_.choice(field.key, kNames);
    if (name) value = when_from_name(*name).value_or(value);
  }

  void operator()(const ScoreField& field, std::string& value) {
    need(field, "\"x\"");
    if (field.choices.empty()) {
      value = table_.text(field.key).value_or(value);
    } else {
      const std::vector<std::string> choices(field.choices.begin(), field.choices.end());
      value = table_.choice(field.key, choices).value_or(value);
    }
  }

  void operator()(const ScoreField& field, std::vector<Reward>& value) {
    need(field, "{ red = 1, yellow = 2 }");
    auto rewards = table_.table(field.key);
    if (!rewards) return;
    value.clear();
    for (const auto& [name, color] : read_color_keys(*rewards)) {
      const auto reward = rewards->number(name, {field.least, field.most});
      value.push_back({color, reward.value_or(0)});
    }
    if (value.empty()) {
      table_.complain(field.key, "`" + std::string(field.key) + "` must name a colour");
    }
  }

 private:
  /// Complains when a required key is missing.
  void need(const ScoreField& field, const std::string& example) {
    if (!field.required || table_.has(field.key)) return;
    const std::string key(field.key);
    table_.complain(
        key, "the score " + kind_ + " needs `" + key + "`, such as " + key + " = " + example);
  }

  TableReader& table_;
  std::string kind_;
};

}  // namespace

std::optional<ScoreRule> read_score(TableReader& score) {
  static const std::vector<std::string> kKinds = score_kinds();
  static const std::vector<std::string> kNotYet = {"external"};
  const auto kind = score.choice("kind", kKinds, kNotYet);
  if (!kind) {
    if (!score.has("kind")) {
      score.complain("kind", score.name() + " needs a `kind`: " + joined(kKinds));
    }
    return std::nullopt;
  }
  std::optional<ScoreRule> rule = score_of_kind(*kind);
  const std::size_t complaints = score.complaints();
  ScoreReader reader(score, *kind);
  visit_fields(*rule, reader);
  if (score.complaints() == complaints) {
    if (const auto fault = fault_of(*rule)) score.complain(fault->where, fault->message);
  }
  // For users who know examples from the literature; only true is allowed.
  if (score.boolean("maximize") == false) {
    score.complain("maximize",
                   "scores are always maximised; give what is unwanted a negative weight, as "
                   "color_reward can, instead of `maximize = false`");
  }
  score.finish();
  return rule;
}

}  // namespace swarmsmith
