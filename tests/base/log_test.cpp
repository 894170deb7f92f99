#include "base/log_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log_limiter.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(LogLine, IsOneObjectWithNumbersAsNumbers) {
  const LogField fields[] = {{"worker", std::int64_t{7}}, {"share", 0.5}, {"host", "a \"b\"\n"}};
  EXPECT_EQ(log_line(true, "T", LogLevel::Warning, "coordinator", "worker lost", fields),
            R"({"time":"T","level":"warning","component":"coordinator","event":"worker lost",)"
            R"("worker":7,"share":0.5,"host":"a \"b\"\n"})");
}

TEST(LogLine, IsKeysAndValuesForPeople) {
  const LogField fields[] = {{"worker", std::int64_t{7}}, {"host", "a"}, {"how", "not heard"}};
  EXPECT_EQ(log_line(false, "T", LogLevel::Info, "worker", "left", fields),
            "T level=info component=worker event=\"left\" worker=7 host=a how=\"not heard\"");
}

TEST(LogLine, KeepsUtf8AndReplacesWhatIsNone) {
  const LogField fields[] = {{"good", "Bo\xc3\xb6t"}, {"bad", "a\xff\xc3"}, {"long", "\xc0\x80"}};
  EXPECT_EQ(log_line(true, "T", LogLevel::Info, "c", "e", fields),
            "{\"time\":\"T\",\"level\":\"info\",\"component\":\"c\",\"event\":\"e\","
            "\"good\":\"Bo\xc3\xb6t\",\"bad\":\"a??\",\"long\":\"??\"}");
}

TEST(LogLine, LetsNoTextSteerATerminal) {
  const LogField fields[] = {{"host", "a\x1b[31m"},
                             {"job", "\xc2\x9b"},
                             {"cpu", "x\x7f"},
                             {"build", "\xe2\x80\xae"},
                             {"note", "\x9b"}};
  EXPECT_EQ(log_line(false, "T", LogLevel::Info, "c\r", "e\x1b", fields),
            "T level=info component=\"c\\u000d\" event=\"e\\u001b\" host=\"a\\u001b[31m\" "
            "job=\"\\u009b\" cpu=\"x\\u007f\" build=\"\\u202e\" note=\"?\"");
  EXPECT_EQ(log_line(true, "T", LogLevel::Info, "c", "e", fields),
            "{\"time\":\"T\",\"level\":\"info\",\"component\":\"c\",\"event\":\"e\","
            "\"host\":\"a\\u001b[31m\",\"job\":\"\\u009b\",\"cpu\":\"x\\u007f\","
            "\"build\":\"\\u202e\",\"note\":\"?\"}");
}

TEST(LogSettings, AreWordsWithCommas) {
  EXPECT_TRUE(parse_log_settings("json").json);
  EXPECT_FALSE(parse_log_settings("json").level.has_value());
  const LogSettings both = parse_log_settings("debug,json");
  EXPECT_TRUE(both.json);
  EXPECT_EQ(both.level, LogLevel::Debug);
  EXPECT_EQ(both.unknown, "");
  EXPECT_EQ(parse_log_settings("json,loud").unknown, "loud");
}

TEST(LogLimiter, LeavesOutWhatIsTooMuchOfOneEventAndSaysHowMuch) {
  LogLimiter limiter;
  const TimePoint begin{seconds(5)};
  int written = 0;
  for (int i = 0; i < 100; ++i)
    written += limiter.admit("storm", begin + milliseconds(i)) ? 1 : 0;
  EXPECT_EQ(written, LogLimiter::kMostASecond);
  EXPECT_TRUE(limiter.admit("other", begin));
  EXPECT_TRUE(limiter.take_left_out(begin + milliseconds(500)).empty());
  const auto left_out = limiter.take_left_out(begin + seconds(2));
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(left_out.front().event, "storm");
  EXPECT_EQ(left_out.front().count, 100 - LogLimiter::kMostASecond);
  EXPECT_TRUE(limiter.take_left_out(begin + seconds(2)).empty());
  EXPECT_TRUE(limiter.admit("storm", begin + seconds(2)));
}

}  // namespace
}  // namespace swarmsmith
