#include "tracking/detection/tag_search.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/tracking/detection/painted_tags.h"

namespace swarmsmith {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 400;
constexpr double kFrame_s = 1.0 / 30;

TagSearch search_for(std::set<int> expected, std::set<int> still = {}) {
  TagSearchOptions options;
  options.expected = std::move(expected);
  options.still = std::move(still);
  return {TagDetector::of_family("tag36h11").value(), options};
}

PaintedPicture picture_of(const std::vector<PaintedTag>& tags, const Shortcomings& look = {},
                          std::uint64_t seed = 1) {
  return painted(kWidth, kHeight, "tag36h11", tags, look, seed);
}

std::vector<int> tags_of(const std::vector<Detection>& seen) {
  std::vector<int> tags;
  for (const Detection& each : seen)
    tags.push_back(each.tag);
  return tags;
}

TEST(TagSearchTest, FollowsTagsThatMoveWithOneWholeFrameASecond) {
  TagSearch search = search_for({1, 2});
  for (int frame = 0; frame < 60; ++frame) {
    // 180 pixels a second, and a turn of half a circle a second.
    const PaintedTag first{1, square_corners(80 + 6.0 * frame, 100, 42, 0.1 * frame)};
    const PaintedTag second{2, square_corners(500 - 3.0 * frame, 300, 42, 1)};
    const PaintedPicture picture = picture_of({first, second});
    const auto seen = search.find(picture.gray(), 12.5 + frame * kFrame_s);
    ASSERT_EQ(tags_of(seen), (std::vector<int>{1, 2})) << "frame " << frame;
    EXPECT_NEAR(middle_of(seen[0].corners).u, 80 + 6.0 * frame, 0.2);
    EXPECT_NEAR(middle_of(seen[1].corners).u, 500 - 3.0 * frame, 0.2);
  }
  EXPECT_EQ(search.full_searches(), 2);
}

/// Further in one frame than any window reaches.
TEST(TagSearchTest, FindsATagThatJumpedInTheSameFrame) {
  TagSearch search = search_for({1});
  const PaintedPicture here = picture_of({{1, square_corners(80, 80, 42, 0)}});
  const PaintedPicture there = picture_of({{1, square_corners(520, 300, 42, 0)}});
  for (int frame = 0; frame < 10; ++frame)
    search.find(here.gray(), frame * kFrame_s);
  EXPECT_EQ(search.full_searches(), 1);
  EXPECT_EQ(tags_of(search.find(there.gray(), 10 * kFrame_s)), std::vector<int>{1});
  EXPECT_EQ(search.full_searches(), 2);
}

TEST(TagSearchTest, AHiddenTagCostsFewWholeFrames) {
  TagSearch search = search_for({1, 2});
  const PaintedTag shown{1, square_corners(80, 80, 42, 0)};
  const PaintedTag hidden{2, square_corners(500, 300, 42, 0)};
  search.find(picture_of({shown, hidden}).gray(), 0);
  const PaintedPicture one = picture_of({shown});
  for (int frame = 1; frame <= 150; ++frame)
    EXPECT_EQ(tags_of(search.find(one.gray(), frame * kFrame_s)), std::vector<int>{1});
  // In 5 s: 5 of one a second, and a few more at the beginning; not 150.
  EXPECT_GE(search.full_searches(), 5);
  EXPECT_LE(search.full_searches(), 11);
  // It comes back where it was: its window is still watched.
  const auto full = search.full_searches();
  EXPECT_EQ(tags_of(search.find(picture_of({shown, hidden}).gray(), 150.5 * kFrame_s)),
            (std::vector<int>{1, 2}));
  EXPECT_LE(search.full_searches(), full + 1);
}

TEST(TagSearchTest, ATagThatNeverComesCostsFewWholeFrames) {
  TagSearch search = search_for({1, 77});
  const PaintedPicture one = picture_of({{1, square_corners(80, 80, 42, 0)}});
  for (int frame = 0; frame <= 150; ++frame)
    search.find(one.gray(), frame * kFrame_s);
  EXPECT_LE(search.full_searches(), 11);
}

TEST(TagSearchTest, AFloorTagThatIsCoveredAsksForNoWholeFrame) {
  TagSearch search = search_for({1, 100}, {100});
  const PaintedTag robot{1, square_corners(80, 80, 42, 0)};
  const PaintedTag floor{100, square_corners(500, 300, 42, 0)};
  const PaintedPicture both = picture_of({robot, floor});
  const PaintedPicture covered = picture_of({robot});
  int looks = 0;
  for (int frame = 0; frame < 28; ++frame) {
    const bool is_covered = frame >= 7 && frame < 20;
    const auto seen = search.find((is_covered ? covered : both).gray(), frame * kFrame_s);
    const auto tags = tags_of(seen);
    looks += static_cast<int>(std::count(tags.begin(), tags.end(), 100));
    EXPECT_FALSE(is_covered && looks > 2);
  }
  EXPECT_EQ(search.full_searches(), 1);
  // Five times a second, while it can be seen.
  EXPECT_GE(looks, 3);
  EXPECT_LE(looks, 4);
}

TEST(TagSearchTest, TagsThatAreThereTwiceAreKept) {
  TagSearch search = search_for({1});
  const PaintedPicture twice =
      picture_of({{1, square_corners(80, 80, 42, 0)}, {1, square_corners(500, 300, 42, 0)}});
  EXPECT_EQ(tags_of(search.find(twice.gray(), 0)), (std::vector<int>{1, 1}));
  // Between whole frames the one is followed that was.
  EXPECT_EQ(tags_of(search.find(twice.gray(), 0.5)), std::vector<int>{1});
  EXPECT_EQ(tags_of(search.find(twice.gray(), 1.0)), (std::vector<int>{1, 1}));
}

TEST(TagSearchTest, FindsStrays) {
  TagSearch search = search_for({1});
  const PaintedPicture picture =
      picture_of({{1, square_corners(80, 80, 42, 0)}, {30, square_corners(500, 300, 42, 0)}});
  EXPECT_EQ(tags_of(search.find(picture.gray(), 0)), (std::vector<int>{1, 30}));
}

/// 26 pixels an edge: at half the resolution a cell is under two pixels.
TEST(TagSearchTest, SmallTagsAreSearchedAtFullResolution) {
  TagSearch search = search_for({1, 2, 3});
  int found = 0;
  for (int frame = 0; frame < 40; ++frame) {
    std::vector<PaintedTag> tags;
    for (int i = 1; i <= 3; ++i)
      tags.push_back({i, square_corners(100.0 * i + 2.3 * frame, 100 + 1.7 * i * frame, 26,
                                        0.31 * i + 0.07 * frame)});
    found += static_cast<int>(
        search
            .find(picture_of(tags, {}, static_cast<std::uint64_t>(frame + 1)).gray(),
                  frame * kFrame_s)
            .size());
  }
  // The first frames may go by before the whole frame is searched at full resolution.
  EXPECT_GE(found, 40 * 3 - 9);
}

TEST(TagSearchTest, FaintReadingsDoNotCount) {
  const Shortcomings faint{0.7, 1, 116, 131, 125};
  const PaintedPicture picture = picture_of({{1, square_corners(80, 80, 60, 0)}}, faint);
  EXPECT_TRUE(search_for({1}).find(picture.gray(), 0).empty());
  auto detector = TagDetector::of_family("tag36h11").value();
  EXPECT_EQ(detector.find(picture.gray(), 1).size(), 1U) << "else the test shows nothing";
}

}  // namespace
}  // namespace swarmsmith
