#include "sim/messages/score_messages.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/support/score_rules.h"

namespace swarmsmith {
namespace {

pb::ScoreRule message_of(const ScoreRule& rule) {
  pb::ScoreRule message;
  to_message(rule, message);
  return message;
}

TEST(ScoreMessages, GiveBackEveryKind) {
  for (const ScoreRule& rule : rules_of_every_kind())
    EXPECT_EQ(from_message(message_of(rule)), rule) << kind_of(rule);
  const ScoreRule exact = Coverage{.tiles = 7, .side_m = 1.0 / 3};
  EXPECT_EQ(from_message(message_of(exact)), exact);
}

TEST(ScoreMessages, SayWhatIsWrongAndWhere) {
  const auto complaint = [](const ScoreRule& rule,
                            const std::function<void(pb::ScoreRule&)>& spoil) {
    pb::ScoreRule message = message_of(rule);
    spoil(message);
    const auto read = from_message(message);
    return read ? "nothing" : read.error().where;
  };
  const ScoreRule robots_on = RobotsOn{{1, 2, 3}};
  const ScoreRule coverage = Coverage{};
  const ScoreRule rewards = ColorReward{{{{1, 2, 3}, 1}, {{3, 2, 1}, 2}}};
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.Clear(); }), "rule");
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.set_kind("robots_of"); }), "rule.kind");
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.set_kind("coverage"); }), "rule.tiles");
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.mutable_fields()->RemoveLast(); }), "rule.at");
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.mutable_fields(1)->set_choice("never"); }),
            "rule.at");
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.mutable_fields(0)->set_rgb(0x1000000); }),
            "rule.color");
  EXPECT_EQ(complaint(robots_on, [](auto& m) { m.add_fields()->set_key("more"); }), "rule.more");
  EXPECT_EQ(complaint(coverage, [](auto& m) { m.mutable_fields(0)->set_number(10); }),
            "rule.tiles");
  EXPECT_EQ(complaint(coverage, [](auto& m) { m.mutable_fields(0)->set_integer(1'000'000); }),
            "rule.tiles");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(coverage, [&](auto& m) { m.mutable_fields(1)->set_number(nan); }),
            "rule.side");
  const auto spoil_reward = [](auto change) {
    return [change](pb::ScoreRule& m) {
      change(*m.mutable_fields(0)->mutable_rewards()->mutable_rewards(0));
    };
  };
  EXPECT_EQ(complaint(rewards, spoil_reward([&](auto& reward) { reward.set_reward(nan); })),
            "rule.rewards");
  EXPECT_EQ(complaint(rewards, spoil_reward([](auto& reward) { reward.set_rgb(0x030201); })),
            "rule.rewards");
}

}  // namespace
}  // namespace swarmsmith
