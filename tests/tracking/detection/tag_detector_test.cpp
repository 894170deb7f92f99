#include "tracking/detection/tag_detector.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/tracking/detection/painted_tags.h"
#include "tracking/geometry/tag_family.h"

namespace swarmsmith {
namespace {

TagDetector detector(const std::string& family = "tag36h11") {
  return TagDetector::of_family(family).value();
}

double off_px(const ImagePoint& a, const ImagePoint& b) {
  return std::hypot(a.u - b.u, a.v - b.v);
}

double worst_off_px(const TagCorners& a, const TagCorners& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, off_px(a[i], b[i]));
  return worst;
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const TagFamily& family : known_tag_families())
    names.emplace_back(family.name);
  return names;
}

class EveryFamily : public testing::TestWithParam<std::string> {};

/// All four ways up, each tag's corners where and in which order they were painted.
TEST_P(EveryFamily, GivesCornersInTheOrderOfTheUprightTag) {
  const std::string& family = GetParam();
  std::vector<PaintedTag> tags;
  for (int i = 0; i < 4; ++i)
    tags.push_back({i, square_corners(120.3 + 180 * i, 130.6, 72, i * std::numbers::pi / 2)});
  const PaintedPicture picture = painted(800, 260, family, tags);
  std::vector<Detection> found = detector(family).find(picture.gray(), 1);
  // Families of few bits find tags between tags; such have small margins.
  std::erase_if(found, [](const Detection& each) { return each.margin < 20; });
  ASSERT_EQ(found.size(), tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    EXPECT_EQ(found[i].tag, tags[i].tag);
    EXPECT_EQ(found[i].hamming, 0);
    EXPECT_LT(worst_off_px(found[i].corners, tags[i].corners), 0.5) << family << " " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, testing::ValuesIn(family_names()),
                         [](const auto& each) { return each.param; });

/// Many places and directions: the mean over them is the bias. Half a pixel of the other
/// convention would be 0.5.
TEST(TagDetectorTest, HasNoBiasInItsCorners) {
  TagDetector finder = detector();
  for (const int decimate : {1, 2}) {
    ImagePoint bias;
    double squares = 0;
    int corners = 0;
    for (int seed = 1; seed <= 6; ++seed) {
      std::vector<PaintedTag> tags;
      for (int i = 0; i < 15; ++i)
        tags.push_back({i, square_corners(80 + 128 * (i % 5) + 0.137 * i + 0.11 * seed,
                                          80 + 120 * (i / 5) + 0.071 * i + 0.19 * seed, 41,
                                          0.43 * i + 1.1 * seed)});
      const PaintedPicture picture =
          painted(680, 400, "tag36h11", tags, {}, static_cast<std::uint64_t>(seed));
      const std::vector<Detection> found = finder.find(picture.gray(), decimate);
      ASSERT_EQ(found.size(), tags.size());
      for (std::size_t i = 0; i < tags.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
          const double du = found[i].corners[k].u - tags[i].corners[k].u;
          const double dv = found[i].corners[k].v - tags[i].corners[k].v;
          bias.u += du;
          bias.v += dv;
          squares += du * du + dv * dv;
          ++corners;
        }
    }
    RecordProperty("bias_u_" + std::to_string(decimate), std::to_string(bias.u / corners));
    EXPECT_LE(std::abs(bias.u / corners), 0.03) << "decimate " << decimate;
    EXPECT_LE(std::abs(bias.v / corners), 0.03) << "decimate " << decimate;
    EXPECT_LE(std::sqrt(squares / corners), 0.15) << "decimate " << decimate;
  }
}

/// A window's rows are as far apart as the picture's, and its corners count from the picture's.
TEST(TagDetectorTest, FindsInAWindowWhatItFindsInTheWholeFrame) {
  const std::vector<PaintedTag> tags{{3, square_corners(100.4, 90.2, 42, 0.3)},
                                     {7, square_corners(420.1, 260.7, 44, 2.1)}};
  const PaintedPicture picture = painted(640, 400, "tag36h11", tags);
  TagDetector finder = detector();
  const std::vector<Detection> whole = finder.find(picture.gray(), 1);
  ASSERT_EQ(whole.size(), 2U);
  for (const int decimate : {1, 2}) {
    const std::vector<Detection> part = finder.find(picture.gray(), {373, 217, 474, 310}, decimate);
    ASSERT_EQ(part.size(), 1U);
    EXPECT_EQ(part[0].tag, 7);
    EXPECT_LT(worst_off_px(part[0].corners, whole[1].corners), 0.1);
  }
}

TEST(TagDetectorTest, RowsMayBeFurtherApartThanTheyAreLong) {
  const PaintedPicture picture =
      painted(320, 200, "tag36h11", {{5, square_corners(150.2, 99.1, 50, 0.7)}});
  constexpr int kStride = 350;
  std::vector<std::uint8_t> padded(kStride * 200, 77);
  for (int row = 0; row < 200; ++row)
    std::copy_n(&picture.pixels[static_cast<std::size_t>(row * 320)], 320,
                &padded[static_cast<std::size_t>(row * kStride)]);
  TagDetector finder = detector();
  const auto close = finder.find(picture.gray(), 1);
  const auto apart = finder.find({padded.data(), 320, 200, kStride}, 1);
  ASSERT_EQ(close.size(), 1U);
  ASSERT_EQ(apart.size(), 1U);
  EXPECT_EQ(apart[0].corners, close[0].corners);
}

TEST(TagDetectorTest, WindowsBeyondTheEdgeAreCutOff) {
  const PaintedPicture picture =
      painted(320, 200, "tag36h11", {{5, square_corners(50, 50, 50, 0.7)}});
  TagDetector finder = detector();
  EXPECT_EQ(finder.find(picture.gray(), {-40, -40, 100, 100}, 1).size(), 1U);
  EXPECT_TRUE(finder.find(picture.gray(), {-40, -40, 3, 3}, 1).empty());
  EXPECT_TRUE(finder.find(picture.gray(), {400, 300, 500, 400}, 2).empty());
}

TEST(TagDetectorTest, ATagThatIsThereTwiceIsFoundTwice) {
  const PaintedPicture picture =
      painted(400, 200, "tag36h11",
              {{5, square_corners(90, 90, 50, 0)}, {5, square_corners(290, 90, 50, 1)}});
  const auto found = detector().find(picture.gray(), 1);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].tag, 5);
  EXPECT_EQ(found[1].tag, 5);
  EXPECT_GE(found[0].margin, found[1].margin);
}

TEST(TagDetectorTest, NamesTheFamiliesThatItKnows) {
  const auto none = TagDetector::of_family("tag36h12");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().kind, ErrorKind::BadInput);
  EXPECT_THAT(none.error().message,
              testing::AllOf(testing::HasSubstr("tag36h12"), testing::HasSubstr("tag36h11"),
                             testing::HasSubstr("tagCircle21h7")));
}

}  // namespace
}  // namespace swarmsmith
