#include "robot/transport/in_process.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TimePoint now() {
  return SystemClock().now();
}

TEST(InProcessSwarm, CarriesReadingsCommandsAndOrders) {
  InProcessSwarm swarm({"rvr1", "rvr2"});
  swarm.world().send(1, RangesMessage{{}, {0.1, 0.2}});
  EXPECT_FALSE(swarm.robot(0).receive(now()).has_value());
  const auto ranges = value_of(swarm.robot(1).receive(now()));
  EXPECT_EQ(std::get<RangesMessage>(ranges).ranges_m, (std::vector<double>{0.1, 0.2}));
  EXPECT_GT(std::get<RangesMessage>(ranges).arrival.at.time_since_epoch().count(), 0);

  swarm.robot(1).send(WheelsMessage{{}, 0.3, 0.1, {}, {}});
  const auto wheels = value_of(swarm.world().receive(now()));
  EXPECT_EQ(wheels.robot, 1U);
  EXPECT_EQ(std::get<WheelsMessage>(wheels.message).sender, "rvr2");

  swarm.operator_end().send(OrderMessage{{}, "{}"});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(std::holds_alternative<OrderMessage>(*swarm.robot(i).receive(now())));

  swarm.robot(0).send(StateMessage{{}, "{\"state\":\"idle\"}"});
  const auto state = value_of(swarm.operator_end().receive(now()));
  EXPECT_EQ(std::get<StateMessage>(state.message).text, "{\"state\":\"idle\"}");
}

TEST(InProcessSwarm, KeepsTheNewestReadingAndEveryOrder) {
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  for (const double range : {0.1, 0.2}) {
    swarm.world().send(0, RangesMessage{{}, {range}});
    swarm.world().send(0, LightMessage{{}, {range}});
    swarm.operator_end().send(OrderMessage{{}, "{}"});
  }
  int orders = 0;
  int ranges = 0;
  while (const auto message = swarm.robot(0).receive(now())) {
    orders += std::holds_alternative<OrderMessage>(*message) ? 1 : 0;
    if (const auto* newest = std::get_if<RangesMessage>(&*message)) {
      ++ranges;
      EXPECT_EQ(newest->ranges_m.front(), 0.2);
    }
  }
  EXPECT_EQ(orders, 2);
  EXPECT_EQ(ranges, 1);
}

TEST(InProcessSwarm, KeepsTheNewestCommandOfEachSender) {
  InProcessSwarm swarm({"rvr1"}, Keep::Newest);
  for (const double speed : {0.1, 0.2}) {
    swarm.robot(0).send(WheelsMessage{{}, speed, 0, {}, "one"});
    swarm.robot(0).send(WheelsMessage{{}, speed, 0, {}, "another"});
  }
  for (const char* sender : {"one", "another"}) {
    const auto wheels = std::get<WheelsMessage>(swarm.world().receive(now())->message);
    EXPECT_EQ(wheels.sender, sender);
    EXPECT_EQ(wheels.left_mps, 0.2);
  }
  EXPECT_FALSE(swarm.world().receive(now()).has_value());
}

TEST(InProcessSwarm, KeepsAllInLockStep) {
  InProcessSwarm swarm({"rvr1"}, Keep::All);
  for (int cycle = 1; cycle <= 100; ++cycle)
    swarm.robot(0).send(AnswerMessage{{}, 1, cycle, 0, 0, 0});
  for (int cycle = 1; cycle <= 100; ++cycle)
    EXPECT_EQ(std::get<AnswerMessage>(swarm.world().receive(now())->message).cycle, cycle);
}

}  // namespace
}  // namespace swarmsmith
