#include "tracking/rig/check.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Outcome = Check::Outcome;

constexpr Question kGap{"longest gap", "s", "a robot that was hidden"};
constexpr Question kRate{"frame rate", "frames/s", "gaps between frames"};
constexpr Question kMotion{"motion as commanded", "", "swapped logs"};

TEST(CheckTest, TellsItsNumberAndOnWhichSideOfTheLimitIsGood) {
  const Check gap = answered(kGap, "rvr1", Outcome::Passed, 0.0667, 1);
  EXPECT_EQ(value_text(gap), "0.067 s");
  EXPECT_EQ(limit_text(gap), "at most 1 s");
  EXPECT_EQ(limit_text(answered(kGap, "rvr1", Outcome::Failed, 1.4, 1)), "at most 1 s");
  EXPECT_EQ(limit_text(answered(kRate, "ceiling", Outcome::Passed, 29.97, 10)),
            "at least 10 frames/s");
  EXPECT_EQ(limit_text(answered(kRate, "ceiling", Outcome::Failed, 8, 10)), "at least 10 frames/s");
  EXPECT_EQ(limit_text(answered(kGap, "rvr1", Outcome::Passed, 0, 0)), "limit 0 s");
  EXPECT_EQ(limit_text(answered(kGap, "rvr1", Outcome::Failed, std::nullopt, 1)), "limit 1 s");
  EXPECT_EQ(value_text(answered(kMotion, "rvr1", Outcome::Passed, 1234.5)), "1234.5");
  EXPECT_EQ(value_text(answered(kMotion, "rvr1", Outcome::Passed)), "");
  EXPECT_EQ(value_text(answered(kGap, "rvr1", Outcome::Passed, -0.00001)), "0 s");
}

TEST(CheckTest, OutcomesFollowFromTheWorstIssue) {
  const std::vector<Issue> issues{{IssueCode::Outliers, "two", "rvr1", {}, {}},
                                  {IssueCode::Gap, "lost", "rvr1", {}, {}},
                                  {IssueCode::Interpolated, "bridged", "rvr1", {}, {}}};
  EXPECT_EQ(outcome_of(issues), Outcome::Failed);
  EXPECT_EQ(outcome_of(issues, 2), Outcome::Warned);
  EXPECT_EQ(outcome_of(issues, 3), Outcome::Passed);
  EXPECT_EQ(outcome_of(issues, 0, IssueCode::Outliers), Outcome::Warned);
  EXPECT_EQ(outcome_of(issues, 0, IssueCode::TagSize), Outcome::Passed);
}

TEST(CheckTest, WhatCouldNotBeAskedIsNamedOnceAndOfWhomIfNotOfAll) {
  const std::vector<Check> checks{
      not_asked(kGap, "", "no film"),        answered(kMotion, "rvr1", Outcome::Passed, 0.9),
      not_asked(kMotion, "rvr2", "no log"),  not_asked(kMotion, "rvr3", "no log"),
      not_asked(kRate, "left", "one frame"), not_asked(kRate, "right", "one frame")};
  EXPECT_THAT(unasked(checks),
              ElementsAre("longest gap", "motion as commanded (rvr2, rvr3)", "frame rate"));
  EXPECT_THAT(unasked({}), IsEmpty());
}

TEST(LimitTest, ACheckMayFailForAnotherReasonThanItsValue) {
  Check check{.name = "motion as commanded",
              .outcome = Check::Outcome::Warned,
              .value = 0.999,
              .limit = 0.5};
  EXPECT_EQ(limit_text(check), "at most 0.5");
  check.limit_is_least = true;
  EXPECT_EQ(limit_text(check), "at least 0.5");
}

}  // namespace
}  // namespace swarmsmith
