#include "tracking/report/timeline.h"

#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"
#include "tests/support/xml_check.h"
#include "tests/tracking/report/reported_run.h"

namespace swarmsmith {
namespace {

constexpr double kWidth = 170;

DrawnPage drawn(const MadeUpRun& run) {
  const std::string svg = timeline(run.tracked, run.scored.issues, kWidth);
  EXPECT_EQ(xml_trouble(svg), "");
  return drawn_page(svg);
}

TEST(TimelineTest, StripsAreAsLongAsTheirCycles) {
  const DrawnPage page = drawn(MadeUpRun());
  double whole = 0;
  for (const DrawnPage::Bar& bar : page.bars_of("#9ecae1"))
    whole = std::max(whole, bar.length);  // a robot that was measured throughout
  const auto degraded = page.bars_of("#d55e00");
  ASSERT_EQ(degraded.size(), 1U);
  EXPECT_NEAR(degraded[0].length, whole * 8 / 600, 0.02);
  // The thickness tells those apart who do not see the colour.
  EXPECT_GT(degraded[0].thickness, page.bars_of("#9ecae1")[0].thickness);
  EXPECT_EQ(page.bars_of("#7b3294").size(), 3U) << "dropped samples";
}

TEST(TimelineTest, IssuesWithATimeAreMarked) {
  const DrawnPage page = drawn(MadeUpRun());
  EXPECT_TRUE(page.has_text("W_TOO_CLOSE_TO_CALL rvr2"));
  EXPECT_TRUE(page.has_text("W_INTERPOLATED rvr2"));
  EXPECT_FALSE(page.has_text("W_UNKNOWN_TAGS"));
  EXPECT_THAT(page.collisions(), IsEmpty());
}

TEST(TimelineTest, ManyIssuesAndLongNamesStayReadable) {
  MadeUpRun run;
  run.tracked.robots[0].name = "a robot with a name that is much too long for any strip of a page";
  for (int i = 0; i < 40; ++i)
    run.scored.issues.push_back({IssueCode::Gap, "gap", "rvr1", 1.5 * i, 1.5 * i + 1});
  EXPECT_THAT(drawn(run).collisions(), IsEmpty());
}

TEST(TimelineTest, ARunWithoutRobotsIsDrawnToo) {
  MadeUpRun run;
  run.tracked = {};
  EXPECT_THAT(drawn(run).collisions(), IsEmpty());
}

}  // namespace
}  // namespace swarmsmith
