#include "robot/zeromq/frames.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace swarmsmith {
namespace {

using testing::ElementsAre;

TEST(Frames, AreTextThatReadsBackToTheSameBits) {
  RangesMessage ranges{{{}, 1'234'567'890'123},
                       {0.1 + 0.2, std::numeric_limits<double>::infinity()}};
  const std::string frame = frame_of(ranges);
  EXPECT_EQ(frame, "ranges 1234567890123 0.30000000000000004 inf");
  const auto came = message_to_robot(frame);
  ASSERT_TRUE(came.has_value());
  EXPECT_EQ(std::get<RangesMessage>(*came).ranges_m, ranges.ranges_m);
  EXPECT_EQ(std::get<RangesMessage>(*came).arrival.stamp_ns, 1'234'567'890'123);
}

TEST(Frames, TakeWhatPythonPrints) {
  const auto came = message_to_robot("ranges 0 0.31 inf -inf nan 1e-05 2 3.0 4");
  ASSERT_TRUE(came.has_value());
  const auto& ranges = std::get<RangesMessage>(*came).ranges_m;
  ASSERT_EQ(ranges.size(), 8U);
  EXPECT_TRUE(std::isnan(ranges[3]));
  EXPECT_EQ(ranges[4], 1e-05);
}

TEST(Frames, OrdersAndStatesAreTheirText) {
  const auto order = message_to_robot(frame_of(OrderMessage{{}, "{\"order\": \"stop\"}"}));
  ASSERT_TRUE(order.has_value());
  EXPECT_EQ(std::get<OrderMessage>(*order).text, "{\"order\": \"stop\"}");
  const auto state = message_from_robot(frame_of(StateMessage{{}, "{}"}));
  ASSERT_TRUE(state.has_value());
  EXPECT_EQ(std::get<StateMessage>(*state).text, "{}");
}

TEST(Frames, WhatIsNoneIsNotRead) {
  for (const char* wrong : {"", " ", "ranges", "ranges x", "ranges 0 0.1 0,2", "ranges 0 0x1",
                            "wheels 0 1 1", "ground_color 0 1 2", "nothing 0 1", "senses 0 1 2 3",
                            "order", "\xff\xfe", "battery 0 1"}) {
    EXPECT_FALSE(message_to_robot(wrong).has_value()) << wrong;
  }
  for (const char* wrong :
       {"wheels 0 1", "wheels 0 1 1 -1", "leds 0 1", "ranges 0 1", "answer 0 1"})
    EXPECT_FALSE(message_from_robot(wrong).has_value()) << wrong;
}

TEST(Frames, AHelloHasWords) {
  EXPECT_THAT(*hello_of(hello_frame({"rvr1", "ranges"})), ElementsAre("rvr1", "ranges"));
  EXPECT_FALSE(hello_of("ranges 0 1").has_value());
}

}  // namespace
}  // namespace swarmsmith
