#include "sim/messages/score_messages.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace swarmsmith {
namespace {

using Field = pb::ScoreRule::Field;

std::uint32_t rgb_of(Rgb color) {
  return std::uint32_t{color.r} << 16U | std::uint32_t{color.g} << 8U | std::uint32_t{color.b};
}

/// Adds the parameters of a kind, whatever it is.
class FieldWriter {
 public:
  explicit FieldWriter(pb::ScoreRule& message) : message_(message) {}

  void operator()(const ScoreField& field, double value) { add(field).set_number(value); }
  void operator()(const ScoreField& field, int value) { add(field).set_integer(value); }
  void operator()(const ScoreField& field, bool value) { add(field).set_flag(value); }
  void operator()(const ScoreField& field, Rgb value) { add(field).set_rgb(rgb_of(value)); }
  void operator()(const ScoreField& field, When value) {
    add(field).set_choice(std::string(name_of(value)));
  }
  void operator()(const ScoreField& field, const std::string& value) { add(field).set_text(value); }
  void operator()(const ScoreField& field, const std::vector<Reward>& value) {
    pb::ScoreRule::Rewards& rewards = *add(field).mutable_rewards();
    for (const Reward& reward : value) {
      pb::ScoreRule::Reward& to = *rewards.add_rewards();
      to.set_rgb(rgb_of(reward.color));
      to.set_reward(reward.reward);
    }
  }

 private:
  Field& add(const ScoreField& field) {
    Field& added = *message_.add_fields();
    added.set_key(std::string(field.key));
    return added;
  }

  pb::ScoreRule& message_;
};

/// Reads the parameters of a kind; the first thing that is wrong is kept, and reading goes on.
class FieldReader {
 public:
  std::optional<Error> fault;

  explicit FieldReader(const pb::ScoreRule& message) : message_(message) {}

  void operator()(const ScoreField& field, double& value) {
    if (const Field* found = find(field, Field::kNumber)) value = found->number();
  }
  void operator()(const ScoreField& field, int& value) {
    if (const Field* found = find(field, Field::kInteger)) value = found->integer();
  }
  void operator()(const ScoreField& field, bool& value) {
    if (const Field* found = find(field, Field::kFlag)) value = found->flag();
  }
  void operator()(const ScoreField& field, Rgb& value) {
    if (const Field* found = find(field, Field::kRgb)) value = color(field, found->rgb());
  }
  void operator()(const ScoreField& field, When& value) {
    const Field* found = find(field, Field::kChoice);
    if (found == nullptr) return;
    const auto when = when_from_name(found->choice());
    if (!when) complain(std::string(field.key), "\"" + found->choice() + "\" is no time");
    value = when.value_or(value);
  }
  void operator()(const ScoreField& field, std::string& value) {
    if (const Field* found = find(field, Field::kText)) value = found->text();
  }
  void operator()(const ScoreField& field, std::vector<Reward>& value) {
    const Field* found = find(field, Field::kRewards);
    if (found == nullptr) return;
    for (const pb::ScoreRule::Reward& reward : found->rewards().rewards())
      value.push_back({color(field, reward.rgb()), reward.reward()});
  }

  /// Parameters that nobody asked for come from another version of the kind.
  void finish() {
    for (const Field& field : message_.fields()) {
      if (std::ranges::find(asked_, field.key()) == asked_.end()) {
        complain(field.key(), "the score " + message_.kind() + " has no such parameter");
      }
    }
  }

 private:
  void complain(const std::string& key, const std::string& text) {
    if (!fault) fault = Error{ErrorKind::BadInput, text, "rule." + key};
  }

  const Field* find(const ScoreField& field, Field::ValueCase type) {
    asked_.emplace_back(field.key);
    for (const Field& found : message_.fields()) {
      if (found.key() != field.key) continue;
      if (found.value_case() == type) return &found;
      complain(found.key(), "a parameter of another type");
      return nullptr;
    }
    complain(std::string(field.key), "the parameter is missing");
    return nullptr;
  }

  Rgb color(const ScoreField& field, std::uint32_t rgb) {
    if (rgb > 0xffffff) complain(std::string(field.key), "a colour above 0xffffff");
    return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
            static_cast<std::uint8_t>(rgb)};
  }

  const pb::ScoreRule& message_;
  std::vector<std::string> asked_;
};

}  // namespace

void to_message(const ScoreRule& rule, pb::ScoreRule& message) {
  message.Clear();
  message.set_kind(std::string(kind_of(rule)));
  FieldWriter writer(message);
  visit_fields(rule, writer);
}

Expected<ScoreRule> from_message(const pb::ScoreRule& message) {
  std::optional<ScoreRule> rule = score_of_kind(message.kind());
  if (message.kind().empty()) return bad_input("a mission without a score", "rule");
  if (!rule) return bad_input("an unknown kind of score: " + message.kind(), "rule.kind");
  FieldReader reader(message);
  visit_fields(*rule, reader);
  reader.finish();
  if (reader.fault) return tl::unexpected(*reader.fault);
  if (const auto fault = fault_of(*rule)) return bad_input(fault->message, "rule." + fault->where);
  return *rule;
}

}  // namespace swarmsmith
