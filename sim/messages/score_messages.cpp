#include "sim/messages/score_messages.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/overloaded.h"

namespace swarmsmith {
namespace {

std::uint32_t rgb_of(Rgb color) {
  return std::uint32_t{color.r} << 16U | std::uint32_t{color.g} << 8U | std::uint32_t{color.b};
}

Rgb color_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
          static_cast<std::uint8_t>(rgb)};
}

pb::ScoreRule::Field& add(std::string key, pb::ScoreRule& message) {
  pb::ScoreRule::Field& field = *message.add_fields();
  field.set_key(std::move(key));
  return field;
}

const pb::ScoreRule::Field& find(const std::string& key, const pb::ScoreRule& message) {
  for (const pb::ScoreRule::Field& field : message.fields()) {
    if (field.key() == key) return field;
  }
  return pb::ScoreRule::Field::default_instance();
}

}  // namespace

void to_message(const ScoreRule& rule, pb::ScoreRule& message) {
  message.Clear();
  std::visit(Overloaded{[&](const RobotsOn& robots_on) {
                          message.set_kind("robots_on");
                          add("color", message).set_rgb(rgb_of(robots_on.color));
                        },
                        [&](const Coverage& coverage) {
                          message.set_kind("coverage");
                          add("tiles", message).set_integer(coverage.tiles);
                          add("side", message).set_number(coverage.side_m);
                        },
                        [&](const ColorReward& colors) {
                          message.set_kind("color_reward");
                          auto& rewards = *add("rewards", message).mutable_rewards();
                          for (const ColorReward::Reward& reward : colors.rewards) {
                            pb::ScoreRule::Reward& to = *rewards.add_rewards();
                            to.set_rgb(rgb_of(reward.color));
                            to.set_reward(reward.reward);
                          }
                        }},
             rule);
}

Expected<ScoreRule> from_message(const pb::ScoreRule& message) {
  if (message.kind() == "robots_on") return RobotsOn{color_of(find("color", message).rgb())};
  if (message.kind() == "coverage") {
    const double side_m = find("side", message).number();
    if (!std::isfinite(side_m)) return bad_input("a number that is not finite", "rule.side");
    return Coverage{find("tiles", message).integer(), side_m};
  }
  if (message.kind() == "color_reward") {
    ColorReward rule;
    for (const pb::ScoreRule::Reward& reward : find("rewards", message).rewards().rewards()) {
      if (!std::isfinite(reward.reward())) {
        return bad_input("a number that is not finite", "rule.rewards");
      }
      rule.rewards.push_back({color_of(reward.rgb()), reward.reward()});
    }
    return rule;
  }
  return bad_input("a mission without a score rule", "rule");
}

}  // namespace swarmsmith
