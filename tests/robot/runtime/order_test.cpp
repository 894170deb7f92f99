#include "robot/runtime/order.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "robot/runtime/node_state.h"
#include "sim/files/robot_file.h"
#include "tests/robot/runtime/rover.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

Order start_order() {
  Order order;
  order.kind = Order::Kind::Start;
  order.id = "a1-7";
  order.run = "run07";
  order.robots = {"rvr1", "rvr2"};
  order.sent_unix_s = 1795000000.123456;
  order.at_unix_s = 1795000002.123456;
  order.seconds = 120;
  order.seed = 77;
  order.clock_offsets_s = {{"rvr1", -0.0031}, {"rvr2", 0.25}};
  return order;
}

TEST(Orders, ReadBackFromTheirText) {
  const Order start = start_order();
  EXPECT_EQ(order_text(start),
            R"({"order":"start","id":"a1-7","run":"run07","robots":["rvr1","rvr2"],)"
            R"("sent_unix_s":1795000000.123456,"valid_s":1,"at_unix_s":1795000002.123456,)"
            R"("seconds":120,"seed":77,"clock_offsets_s":{"rvr1":-0.0031,"rvr2":0.25}})");
  EXPECT_EQ(order_text({}), R"({"order":"echo","id":"","run":"","sent_unix_s":0,"valid_s":1})");
  EXPECT_EQ(parse_order(order_text(start)).value(), start);
  for (const Order::Kind kind :
       {Order::Kind::Stop, Order::Kind::Kill, Order::Kind::Alive, Order::Kind::Echo}) {
    Order order;
    order.kind = kind;
    order.id = "x";
    order.sent_unix_s = 5;
    EXPECT_EQ(parse_order(order_text(order)).value(), order);
  }
}

TEST(Orders, CarryARobotThatIsNotTheRvr) {
  Order start = start_order();
  start.own_robot = own_robot_text(rvr_with(CircleOutline{0.1}));
  EXPECT_EQ(order_text(start), order_text(start_order())) << "the same bytes for RVRs";
  start.own_robot = own_robot_text(rover());
  EXPECT_THAT(order_text(start), HasSubstr(R"(,"own_robot":"\n[robot]\nname = \"rover\"\n)"));
  const Order read = value_of(parse_order(order_text(start)));
  EXPECT_EQ(read, start);
  EXPECT_EQ(value_of(parse_own_robot(read.own_robot)), rover());
}

TEST(Orders, ThatCannotBeReadAreRefusedWithAReason) {
  const std::string no_object = "an order is a JSON object";
  const std::string seconds = "a start needs `seconds`, more than 0 and at most a day";
  const std::string robots = "`robots` is a list of names";
  const std::vector<std::pair<std::string, std::string>> refused{
      {"", no_object},
      {"{", no_object},
      {"[]", no_object},
      {"7", no_object},
      {"\xff\xfe", no_object},
      {"{}", "the key `order` is missing"},
      {R"({"order":"start"})", "an order needs an `id`"},
      {R"({"order":"stop","id":""})", "an order needs an `id`"},
      {R"({"order":"stop","id":7})", "an order needs an `id`"},
      {R"({"order":"jump","id":"a"})", "there is no order `jump`"},
      {R"({"order":"start","id":"a","run":"../x","seconds":3})",
       "a start needs a run's name of letters, digits, - and _"},
      {R"({"order":"start","id":"a","run":"x"})", seconds},
      {R"({"order":"start","id":"a","run":"x","seconds":-3})", seconds},
      {R"({"order":"start","id":"a","run":"x","seconds":1e300})", seconds},
      {R"({"order":"start","id":"a","run":"x","seconds":3,"seed":"1"})", "`seed` is an integer"},
      {R"({"order":"start","id":"a","run":"x","seconds":3,"seed":1.5})", "`seed` is an integer"},
      {R"({"order":"start","id":"a","run":"x","seconds":3,"own_robot":7})",
       "`own_robot` is a text, a robot as TOML"},
      {R"({"order":"start","id":"a","run":"x","seconds":3,"sed":7,"own":1})",
       "a start has the unknown key `own`, `sed`; the run does not begin, because it could be "
       "another one than was meant"},
      {R"({"order":"stop","id":"a","robots":"rvr1"})", robots},
      {R"({"order":"stop","id":"a","robots":[1]})", robots},
      {R"({"order":"stop","id":"a","robots":["rvr1",1]})", robots},
      {R"({"order":"stop","id":"a","robots":null})", robots}};
  for (const auto& [text, why] : refused)
    EXPECT_EQ(why_not(parse_order(text)).message, why) << text;
}

TEST(Orders, OfAStartHaveLimitsThatAreMeant) {
  const auto is_taken = [](const std::string& run, const std::string& seconds) {
    return parse_order(R"({"order":"start","id":"a","run":")" + run + R"(","seconds":)" + seconds +
                       "}")
        .has_value();
  };
  EXPECT_TRUE(is_taken(std::string(100, 'r'), "3"));
  EXPECT_FALSE(is_taken(std::string(101, 'r'), "3"));
  EXPECT_TRUE(is_taken("azAZ09-_", "86400"));
  for (const char* name : {"", "a b", "a/b", "a.b", "{", "[", "`", "@", ":", "/"})
    EXPECT_FALSE(is_taken(name, "3")) << name;
  for (const char* seconds : {"0", "-1", "86401"})
    EXPECT_FALSE(is_taken("r", seconds)) << seconds;
  const auto valid_s = [](const std::string& number) {
    return value_of(parse_order(R"({"order":"alive","id":"a","valid_s":)" + number + "}")).valid_s;
  };
  EXPECT_EQ(valid_s("99"), 10);
  EXPECT_EQ(valid_s("9.5"), 9.5);
  EXPECT_EQ(valid_s("0.5"), 0.5);
  EXPECT_EQ(valid_s("-1"), 0);
}

TEST(Orders, WithUnknownKeysStopButDoNotStart) {
  EXPECT_FALSE(parse_order(R"({"order":"start","id":"a","run":"r","seconds":3,"sed":7})"));
  const auto stop = value_of(parse_order(R"({"order":"stop","id":"a","runs":"r","why":1})"));
  EXPECT_EQ(stop.unknown_keys, "`runs`, `why`");
}

TEST(OrderDoor, RefusesOldRepeatedAndFutureStarts) {
  OrderDoor door("rvr1");
  Order order = start_order();
  order.sent_unix_s = 1000;
  EXPECT_EQ(door.refusal(order, 1001.5), "the order is 1.5 s old and was valid for 1.0 s");
  EXPECT_EQ(door.refusal(order, 998), "the order's time is 2.0 s in the future: the clocks differ");
  EXPECT_EQ(door.refusal(order, 1000.5), std::nullopt);
  EXPECT_EQ(door.refusal(order, 1000.6), "this order came before");
  order.id = "a1-8";
  EXPECT_EQ(door.refusal(order, 1000.5), std::nullopt);
  order.kind = Order::Kind::Echo;
  for (const double right : {999.0, 1000.0, 1001.0})
    EXPECT_EQ(door.refusal(order, right), std::nullopt) << "also one with an id that came before";
  for (const double wrong : {998.99, 1001.01})
    EXPECT_NE(door.refusal(order, wrong), std::nullopt) << wrong;
  order.valid_s = 3;
  EXPECT_EQ(door.refusal(order, 1003), std::nullopt);
  order.sent_unix_s = std::numeric_limits<double>::quiet_NaN();
  order.id = "a1-9";
  EXPECT_TRUE(door.refusal(order, 5));
}

TEST(OrderDoor, LetsWhatStopsARobotPassHoweverOldItIs) {
  OrderDoor door("rvr1");
  for (const Order::Kind kind : {Order::Kind::Stop, Order::Kind::Kill}) {
    Order order;
    order.kind = kind;
    order.id = "x";
    EXPECT_EQ(door.refusal(order, 1e9), std::nullopt);
    EXPECT_EQ(door.refusal(order, 1e9), std::nullopt);
  }
}

TEST(OrderDoor, KnowsWhomAnOrderIsFor) {
  OrderDoor door("rvr1");
  Order order = start_order();
  EXPECT_TRUE(door.is_for_this_robot(order));
  order.robots = {"rvr2"};
  EXPECT_FALSE(door.is_for_this_robot(order));
  order.robots.clear();
  EXPECT_TRUE(door.is_for_this_robot(order));
}

TEST(NodeStates, ReadBackFromTheirText) {
  NodeState state{.robot = "rvr2",
                  .phase = Phase::Running,
                  .run = "run07",
                  .cycle = 55,
                  .machine_digest = "ab",
                  .flavour = "watermelon",
                  .turn_clock = "seconds",
                  .seed = 3,
                  .robot_index = 1,
                  .version = "v",
                  .scheduling = "SCHED_FIFO 20",
                  .age_ms = {12.5, -1, std::nullopt, 3},
                  .held = 2,
                  .skipped = 1,
                  .battery = 0.9,
                  .verdict = RunVerdict::Degraded,
                  .reasons = {"a \"quoted\" reason"},
                  .not_ready = {"x", "y"},
                  .log_trouble = "full",
                  .log_open = true,
                  .order = "o",
                  .refused = "r",
                  .start_unix_s = 1795000000.5,
                  .clock_s = 123.456,
                  .unix_s = 1795000000.123456};
  EXPECT_EQ(
      state_text(state),
      R"({"robot":"rvr2","state":"running","run":"run07","cycle":55,"machine":"ab",)"
      R"("flavour":"watermelon","turn_clock":"seconds","seed":3,"robot_index":1,"version":"v",)"
      R"("scheduling":"SCHED_FIFO 20","age_ms":{"proximity":12.5,"ground":-1,"light":3},"held":2,)"
      R"("skipped":1,"battery":0.9,"verdict":"DEGRADED","reasons":["a \"quoted\" reason"],)"
      R"("not_ready":["x","y"],"log_trouble":"full","log_open":true,"order":"o","refused":"r",)"
      R"("start_unix_s":1795000000.5,"clock_s":123.456,"unix_s":1795000000.123456})");
  EXPECT_EQ(parse_state(state_text(state)).value(), state);
  state.own_robot = "[robot]\n";
  EXPECT_THAT(state_text(state), HasSubstr(R"("flavour":"watermelon","own_robot":"[robot]\n",)"));
  EXPECT_EQ(parse_state(state_text(state)).value(), state);
  EXPECT_EQ(parse_state(state_text({})).value(), NodeState{});
  EXPECT_EQ(why_not(parse_state("{}")).message, "the key `state` is missing");
  EXPECT_EQ(why_not(parse_state("[]")).message, "a node's state is a JSON object");
  EXPECT_EQ(why_not(parse_state(R"({"state":"dancing"})")).message, "there is no state `dancing`");
  // Of another version: a field of another type, or one too many, is as if it were not there.
  const auto other =
      value_of(parse_state(R"({"state":"idle","verdict":"GOOD","age_ms":3,"reasons":["a",3],)"
                           R"("cycle":1.5,"new":1})"));
  EXPECT_EQ(other, (NodeState{.verdict = RunVerdict::Invalid, .reasons = {"a"}}));
}

}  // namespace
}  // namespace swarmsmith
