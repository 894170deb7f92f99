#include "robot/zeromq/frames.h"

#include <cmath>
#include <limits>
#include <utility>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Reads the frame, and writes it again.
std::string again(const std::string& frame) {
  if (const auto message = message_to_robot(frame)) return frame_of(*message);
  const auto message = message_from_robot(frame);
  return message ? frame_of(*message) : "is not read";
}

/// As version 0.1.0 wrote them: drivers outside read and write these.
TEST(Frames, HaveTheirBytesAndReadBackToThem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> ranges = {0.1 + 0.2, kInfinity, -kInfinity, kNan, 1e-5, 2, -0.0, 1e22};
  const SensesMessage senses{{},
                             2'147'483'647,
                             1200,
                             0.1 + 0.2,
                             {0.1, kInfinity, -kInfinity, 0.39, 0.05, 1e-300, 0.2, 0.3},
                             {0, 127, 255},
                             {1, 2, 3, 4, 5, 6, 7, 16000},
                             {{0.5, 1, 0}}};
  LedsMessage leds;
  leds.colors[0] = 255;
  leds.colors[14] = 7;
  const std::pair<std::string, std::string> frames[] = {
      {frame_of(RangesMessage{{{}, 1'234'567'890'123}, ranges}),
       "ranges 1234567890123 0.30000000000000004 inf -inf nan 1e-05 2 -0 1e+22"},
      {frame_of(GroundColorMessage{{}, 0, 127.5, 255}), "ground_color 0 0 127.5 255"},
      {frame_of(ScanMessage{{{}, -5}, -3.14, 3.14, 0.0087, 0.1, 12, {0, 1.5, kInfinity}}),
       "scan -5 -3.14 3.14 0.0087 0.1 12 0 1.5 inf"},
      {frame_of(NeighboursMessage{{}, {{0.5, 1, 0}, {0.7, -0.6, 0.8}}}),
       "neighbours 0 0.5 1 0 0.7 -0.6 0.8"},
      {frame_of(NeighboursMessage{}), "neighbours 0"},
      {frame_of(LightMessage{{}, {1, 2, 16000}}), "light 0 1 2 16000"},
      {frame_of(BatteryMessage{{{}, 7}, 7.4, kNan}), "battery 7 7.4 nan"},
      {frame_of(DrivenMessage{{}, 0.3, -0.1, "its sender"}), "driven 0 0.3 -0.1"},
      {frame_of(OrderMessage{{}, "{\"order\": \"stop\"}"}), "order {\"order\": \"stop\"}"},
      {frame_of(senses),
       "senses 0 2147483647 1200 0.30000000000000004 0.1 inf -inf 0.39 0.05 1e-300 0.2 0.3 0 127 "
       "255 1 2 3 4 5 6 7 16000 0.5 1 0"},
      {frame_of(WheelsMessage{{}, 0.3, -0.1, {}, "its sender"}), "wheels 0 0.3 -0.1"},
      {frame_of(WheelsMessage{{}, 0.3, -0.1, 2, {}}), "wheels 0 0.3 -0.1 2"},
      {frame_of(leds), "leds 0 255 0 0 0 0 0 0 0 0 0 0 0 0 0 7"},
      {frame_of(StateMessage{{}, "{}"}), "state {}"},
      {frame_of(AnswerMessage{{}, 7, 12, 0.3, -0.1, 3}), "answer 0 7 12 0.3 -0.1 3"}};
  for (const auto& [frame, bytes] : frames) {
    EXPECT_EQ(frame, bytes);
    EXPECT_EQ(again(frame), bytes);
  }
}

TEST(Frames, OfImuAndOdometryAreKnownAndNotUsed) {
  EXPECT_TRUE(is_unused_frame("odom 0 1 2 3 4 5 6"));
  EXPECT_TRUE(is_unused_frame("imu"));
  for (const char* other : {"", "odometry 0 1", "ranges 0 1"})
    EXPECT_FALSE(is_unused_frame(other)) << other;
}

TEST(Frames, TakeWhatPythonPrints) {
  const auto came = value_of(message_to_robot("ranges 0 0.31 inf -inf nan 1e-05 2 3.0 4"));
  const auto& ranges = std::get<RangesMessage>(came).ranges_m;
  ASSERT_EQ(ranges.size(), 8U);
  EXPECT_TRUE(std::isnan(ranges[3]));
  EXPECT_EQ(ranges[4], 1e-05);
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
