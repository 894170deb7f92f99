#include "robot/zeromq/zmq_ends.h"

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include "proto/socket.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TimePoint in(std::chrono::milliseconds time) {
  return SystemClock().now() + time;
}

constexpr std::chrono::milliseconds kPatience{20'000};

/// Waits until the condition holds.
template <class Condition>
bool becomes(Condition condition) {
  const TimePoint until = in(kPatience);
  while (!condition()) {
    if (SystemClock().now() > until) return false;
    std::this_thread::yield();
  }
  return true;
}

/// The next message of a kind.
template <class Message>
std::optional<Message> next(RobotEnd& end) {
  const TimePoint until = in(kPatience);
  while (const auto message = end.receive(until)) {
    if (const auto* found = std::get_if<Message>(&*message)) return *found;
  }
  return std::nullopt;
}
template <class Message, class End>
std::optional<Message> next_of(End& end) {
  const TimePoint until = in(kPatience);
  while (const auto received = end.receive(until)) {
    if (const auto* found = std::get_if<Message>(&received->message)) return *found;
  }
  return std::nullopt;
}

TEST(ZmqEnds, CarryReadingsCommandsStatesAndOrders) {
  auto node = value_of(zmq_robot_end("rvr1", {}));
  auto world = value_of(zmq_world_end({{"rvr1", node.endpoint}}, {}));
  auto operating = value_of(zmq_operator_end({{"rvr1", node.endpoint}}, {}));
  ASSERT_TRUE(becomes([&] { return world->connected(0) && node.end->connected(); }));
  ASSERT_TRUE(becomes([&] { return operating->connected(0); }));

  world->send(0, RangesMessage{{}, {0.1 + 0.2}});
  const auto ranges = value_of(next<RangesMessage>(*node.end));
  EXPECT_EQ(ranges.ranges_m.front(), 0.1 + 0.2);

  node.end->send(WheelsMessage{{}, 0.3, 0.1, {}, {}});
  const auto wheels = value_of(next_of<WheelsMessage>(*world));
  EXPECT_EQ(wheels.left_mps, 0.3);

  operating->send(OrderMessage{{}, "{\"order\":\"stop\"}"});
  EXPECT_EQ(next<OrderMessage>(*node.end)->text, "{\"order\":\"stop\"}");

  node.end->send(StateMessage{{}, "{}"});
  EXPECT_EQ(next_of<StateMessage>(*operating)->text, "{}");
  EXPECT_EQ(next_of<StateMessage>(*world)->text, "{}");
}

TEST(ZmqEnds, WhoComesLateHearsTheLastState) {
  auto node = value_of(zmq_robot_end("rvr1", {}));
  node.end->send(StateMessage{{}, "{\"n\":1}"});
  node.end->send(StateMessage{{}, "{\"n\":2}"});
  node.end->flush(std::chrono::seconds(10));  // who comes before then hears both
  auto operating = zmq_operator_end({{"rvr1", node.endpoint}}, {});
  EXPECT_EQ(next_of<StateMessage>(**operating)->text, "{\"n\":2}");
}

NodeClientOptions with_key(const KeyPair& own, const KeyPair& server) {
  return {.keys = ClientKeys{.secret_key = own.secret_key, .server_key = server.public_key}};
}

TEST(ZmqEnds, KeysSayWhoMayDoWhat) {
  const KeyPair server = make_key_pair();
  const KeyPair driver = make_key_pair();
  const KeyPair boss = make_key_pair();
  NodeServerOptions options;
  options.keys = ServerKeys{.secret_key = server.secret_key,
                            .clients = {{"driver", Role::Worker, driver.public_key},
                                        {"boss", Role::Operator, boss.public_key}}};
  auto node = value_of(zmq_robot_end("rvr1", options));
  auto world = zmq_world_end({{"rvr1", node.endpoint}}, with_key(driver, server));
  auto operating = zmq_operator_end({{"rvr1", node.endpoint}}, with_key(boss, server));
  auto other = zmq_operator_end({{"rvr1", node.endpoint}}, with_key(driver, server));
  ASSERT_TRUE(becomes([&] {
    return (*world)->connected(0) && (*operating)->connected(0) && (*other)->connected(0);
  }));
  (*other)->send(OrderMessage{{}, "{\"order\":\"kill\"}"});
  const auto refused = value_of(next<TroubleMessage>(*node.end));
  EXPECT_THAT(refused.text, HasSubstr("its key is not an operator's"));
  (*operating)->send(OrderMessage{{}, "{\"order\":\"stop\"}"});
  EXPECT_EQ(next<OrderMessage>(*node.end)->text, "{\"order\":\"stop\"}");

  auto stranger = zmq_operator_end({{"rvr1", node.endpoint}}, with_key(make_key_pair(), server));
  const auto told = value_of(next_of<TroubleMessage>(**stranger));
  EXPECT_THAT(told.text, HasSubstr("does not accept this key"));
  EXPECT_FALSE((*stranger)->connected(0));
  const auto said = value_of(next<TroubleMessage>(*node.end));
  EXPECT_EQ(said.text, "a client at 127.0.0.1 was refused: unlisted key");
}

TEST(ZmqEnds, KeysThatExpireOrAreRemovedLoseTheirRights) {
  const KeyPair server = make_key_pair();
  const KeyPair driver = make_key_pair();
  const KeyPair boss = make_key_pair();
  const ListedClient listed_boss{"boss", Role::Operator, boss.public_key};
  std::atomic<bool> removed{false};
  NodeServerOptions options;
  options.keys = ServerKeys{.secret_key = server.secret_key,
                            .clients = {{"driver", Role::Worker, driver.public_key}, listed_boss}};
  options.new_clients = [&]() -> std::optional<std::vector<ListedClient>> {
    if (!removed) return std::nullopt;
    return std::vector{listed_boss};
  };
  auto node = value_of(zmq_robot_end("rvr1", options));
  auto world = zmq_world_end({{"rvr1", node.endpoint}}, with_key(driver, server));
  auto operating = zmq_operator_end({{"rvr1", node.endpoint}}, with_key(boss, server));
  ASSERT_TRUE(becomes([&] { return (*world)->connected(0) && (*operating)->connected(0); }));
  ASSERT_TRUE(becomes([&] { return node.end->connected(); }));
  removed = true;
  EXPECT_TRUE(becomes([&] { return !(*world)->connected(0) && !node.end->connected(); }));
  EXPECT_TRUE((*operating)->connected(0));
}

TEST(ZmqEnds, KnowWhoDrivesAndWhatItSays) {
  auto node = value_of(zmq_robot_end("rvr1", {}));
  auto world = zmq_world_end({{"rvr1", node.endpoint}}, {});
  auto operating = zmq_operator_end({{"rvr1", node.endpoint}}, {});
  ASSERT_TRUE(becomes([&] { return (*world)->connected(0) && (*operating)->connected(0); }));
  ASSERT_TRUE(becomes([&] { return node.end->connected(); }));
  const std::vector<Listener> listeners = node.end->listeners();
  ASSERT_EQ(listeners.size(), 1U) << "an operator gets no speeds";
  EXPECT_TRUE(listeners[0].drives);
  (*world)->send(0, DrivenMessage{{}, 0.3, 0.1, {}});
  const auto driven = value_of(next<DrivenMessage>(*node.end));
  EXPECT_EQ(driven.left_mps, 0.3);
  EXPECT_EQ(driven.right_mps, 0.1);
  EXPECT_EQ(driven.sender, listeners[0].name);
  EXPECT_GE(node.end->listeners()[0].heard, listeners[0].heard);
  world->reset();
  EXPECT_TRUE(becomes([&] {
    node.end->send(WheelsMessage{});
    return !node.end->connected();
  }));
}

TEST(ZmqEnds, WhatADriverSaysAfterAnotherHelloIsNotBelieved) {
  auto node = value_of(zmq_robot_end("rvr1", {}));
  ClientSocket client(node.endpoint);
  client.connect();
  client.send("hello driver");
  ASSERT_TRUE(becomes([&] { return node.end->connected(); }));
  client.send("hello operator");
  const auto said = value_of(next<TroubleMessage>(*node.end));
  EXPECT_THAT(said.text, HasSubstr("no longer drives: it sent `hello operator`"));
  EXPECT_FALSE(node.end->connected());
  client.send("odom 0 1 2 3 4 5 6");  // of older drivers: no trouble
  client.send("driven 0 0.3 0.3");
  EXPECT_THAT(next<TroubleMessage>(*node.end)->text, HasSubstr("its reports are ignored"));
}

TEST(ZmqEnds, ASecondNodeOfTheRobotFindsTheAddressTaken) {
  auto node = value_of(zmq_robot_end("rvr1", {}));
  const auto second = zmq_robot_end("rvr1", {.endpoint = node.endpoint});
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().kind, ErrorKind::Conflict);
}

TEST(ZmqEnds, ANodeThatComesBackIsFoundAgain) {
  auto node = value_of(zmq_robot_end("rvr1", {}));
  const std::string endpoint = node.endpoint;
  auto world = zmq_world_end({{"rvr1", endpoint}}, {});
  ASSERT_TRUE(becomes([&] { return (*world)->connected(0); }));
  node.end.reset();
  const auto told = value_of(next_of<TroubleMessage>(**world));
  EXPECT_THAT(told.text, HasSubstr("rvr1"));
  EXPECT_FALSE((*world)->connected(0));
  auto again = zmq_robot_end("rvr1", {.endpoint = endpoint});
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_TRUE(becomes([&] { return (*world)->connected(0); }));
}

TEST(ZmqEnds, ANodeOfAnotherNameIsNotTaken) {
  auto node = value_of(zmq_robot_end("rvr2", {}));
  auto world = zmq_world_end({{"rvr1", node.endpoint}}, {});
  EXPECT_THAT(next_of<TroubleMessage>(**world)->text, HasSubstr("rvr2's, not rvr1's"));
  EXPECT_FALSE((*world)->connected(0));
}

TEST(ZmqEnds, OtherHostsNeedKeys) {
  const auto node = zmq_robot_end("rvr1", {.endpoint = "tcp://0.0.0.0:*"});
  ASSERT_FALSE(node.has_value());
  EXPECT_THAT(node.error().message, HasSubstr("keygen"));
  const auto world = zmq_world_end({{"rvr1", "tcp://10.0.0.1:5570"}}, {});
  ASSERT_FALSE(world.has_value());
  EXPECT_THAT(world.error().message, HasSubstr("need a key"));
  EXPECT_FALSE(zmq_world_end({{"rvr1", "nowhere"}}, {}).has_value());
}

}  // namespace
}  // namespace swarmsmith
