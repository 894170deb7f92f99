#include "tracking/observing/observe.h"

#include <algorithm>

#include "tests/support/checks.h"
#include "tests/tracking/detection/painted_tags.h"

namespace swarmsmith {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

/// A video that is in memory.
class MemorySource : public FrameSource {
 public:
  struct Shot {
    PaintedPicture picture;
    std::optional<double> time_s;
  };

  explicit MemorySource(std::vector<Shot> shots) : shots_(std::move(shots)) {
    info_.name = "run.mp4";
    info_.size = {kWidth, kHeight};
    info_.frame_rate = 10;
    info_.expected_frames = static_cast<std::int64_t>(shots_.size());
    info_.has_times = true;
  }

  const SourceInfo& info() const override { return info_; }
  Expected<bool> next() override {
    if (at_ + 1 == breaks_at_) return unexpected(ErrorKind::Corrupt, "invalid data", "run.mp4");
    if (static_cast<std::size_t>(++at_) >= shots_.size()) return false;
    const Shot& shot = shots_[static_cast<std::size_t>(at_)];
    frame_ = {at_, shot.time_s, shot.picture.gray()};
    return true;
  }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override { return {}; }
  std::int64_t damaged_frames() const override { return damaged_; }

  SourceInfo info_;
  std::int64_t breaks_at_ = -1;
  std::int64_t damaged_ = 0;

 private:
  std::vector<Shot> shots_;
  std::int64_t at_ = -1;
  Frame frame_;
};

PaintedTag robot_at(double u, double v) {
  return {1, square_corners(u, v, 44, 0.4)};
}

MemorySource::Shot shot(const std::vector<PaintedTag>& tags, double time_s,
                        std::uint64_t noise = 1) {
  return {painted(kWidth, kHeight, "tag36h11", tags, {}, noise), time_s};
}

/// A robot that moves 8 pixels a frame over a floor tag, a frame each 0.1 s from 12 s on.
std::vector<MemorySource::Shot> moving(int frames) {
  std::vector<MemorySource::Shot> shots;
  for (int i = 0; i < frames; ++i)
    shots.push_back(shot({robot_at(60 + 8.0 * i, 60), {100, square_corners(250, 180, 48, 0)}},
                         12 + 0.1 * i, static_cast<std::uint64_t>(i + 1)));
  return shots;
}

ObserveOptions options() {
  ObserveOptions result;
  result.search.expected = {1};
  result.references = {100};
  return result;
}

Expected<CameraObservations> observed(MemorySource& source, const CameraSetup& camera = {},
                                      std::optional<std::vector<double>> sidecar = {}) {
  auto clock = FrameClock::of(source.info(), std::move(sidecar));
  if (!clock.has_value()) return Unexpected(clock.error());
  return observe({camera, source, *clock, "ab12"}, options());
}

TEST(ObserveTest, GivesSightingsOfRobotsAndMediansOfFloorTags) {
  MemorySource source(moving(12));
  CameraSetup camera;
  camera.name = "ceiling";
  const auto seen = value_of(observed(source, camera));
  EXPECT_EQ(seen.record.camera, "ceiling");
  EXPECT_EQ(seen.record.file, "run.mp4");
  EXPECT_EQ(seen.record.sha256, "ab12");
  EXPECT_EQ(seen.record.size, (ImageSize{kWidth, kHeight}));
  EXPECT_EQ(seen.record.frames, 12);
  EXPECT_EQ(seen.record.frame_times.size(), 12U);
  EXPECT_EQ(seen.record.time_source, TimeSource::Container);
  EXPECT_TRUE(seen.issues.empty());
  ASSERT_EQ(seen.sightings.size(), 12U);
  for (int i = 0; i < 12; ++i) {
    const Sighting& each = seen.sightings[static_cast<std::size_t>(i)];
    EXPECT_EQ(each.frame, i);
    EXPECT_EQ(each.tag, 1);
    EXPECT_NEAR(each.time_s, 12 + 0.1 * i, 1e-12);
    EXPECT_NEAR(middle_of(each.corners).u, 60 + 8.0 * i, 0.2);
  }
  ASSERT_EQ(seen.record.references.size(), 2U) << "one a second";
  EXPECT_EQ(seen.record.references[0].tag, 100);
  EXPECT_GE(seen.record.references[0].frames, 4);
  EXPECT_NEAR(middle_of(seen.record.references[0].corners).u, 250, 0.05);
}

TEST(ObserveTest, SaysThatPicturesAreMirrored) {
  std::vector<MemorySource::Shot> shots = moving(3);
  for (MemorySource::Shot& shot : shots) {
    for (int row = 0; row < kHeight; ++row) {
      const auto first = shot.picture.pixels.begin() + static_cast<std::ptrdiff_t>(row) * kWidth;
      std::reverse(first, first + kWidth);
    }
  }
  MemorySource source(shots);
  const auto seen = observed(source);
  ASSERT_FALSE(seen.has_value());
  EXPECT_THAT(seen.error().message, HasSubstr("E_VIDEO_UNREADABLE: the pictures are mirrored"));
}

TEST(ObserveTest, NamesTheFamilyThatWasPrinted) {
  MemorySource source(std::vector<MemorySource::Shot>{
      {painted(kWidth, kHeight, "tag25h9", {robot_at(100, 100)}), 12.0}});
  const auto seen = observed(source);
  ASSERT_FALSE(seen);
  EXPECT_THAT(
      seen.error().message,
      HasSubstr("E_CONFIG: tags of the family tag25h9 are seen (1), and the arena file says"));
}

TEST(ObserveTest, NamesATagThatWasPrintedMirrored) {
  std::vector<MemorySource::Shot> shots;
  for (int i = 0; i < 3; ++i) {
    PaintedPicture picture = painted(kWidth, kHeight, "tag36h11", {robot_at(100, 100)});
    for (int row = 0; row < kHeight; ++row)
      std::reverse(picture.pixels.begin() + row * kWidth,
                   picture.pixels.begin() + (row + 1) * kWidth);
    const PaintedPicture floor =
        painted(kWidth, kHeight, "tag36h11", {{100, square_corners(80, 180, 48, 0)}});
    std::copy(floor.pixels.begin() + 150 * kWidth, floor.pixels.end(),
              picture.pixels.begin() + 150 * kWidth);
    shots.push_back({picture, 12 + 0.1 * i});
  }
  MemorySource source(std::move(shots));
  const auto seen = value_of(observed(source));
  ASSERT_EQ(seen.issues.size(), 1U);
  EXPECT_EQ(seen.issues[0].code, IssueCode::FilmOdd);
  EXPECT_THAT(seen.issues[0].text, HasSubstr("tag 1 is its mirror image"));
}

TEST(ObserveTest, TimesAreTheMiddleOfTheExposureOfTheTagsRows) {
  CameraSetup camera;
  camera.exposure_s = 0.008;
  EXPECT_DOUBLE_EQ(exposed_at(camera, 5, 100, 200), 5);
  camera.stamped_at = StampedAt::Start;
  EXPECT_DOUBLE_EQ(exposed_at(camera, 5, 100, 200), 5.004);
  camera.stamped_at = StampedAt::End;
  EXPECT_DOUBLE_EQ(exposed_at(camera, 5, 100, 200), 4.996);
  camera.readout_s = 0.016;
  EXPECT_DOUBLE_EQ(exposed_at(camera, 5, 100, 200), 5.004);
  EXPECT_DOUBLE_EQ(exposed_at(camera, 5, 50, 200), 5.0);

  MemorySource source(moving(3));
  const auto seen = value_of(observed(source, camera));
  EXPECT_NEAR(seen.sightings[0].time_s, 12 - 0.004 + 0.016 * 60 / kHeight, 1e-5);
  EXPECT_DOUBLE_EQ(seen.record.frame_times[0], 12);
}

TEST(ObserveTest, ARepeatedPictureHasTheSameCornersAgain) {
  std::vector<MemorySource::Shot> shots = moving(4);
  shots[2].picture = shots[1].picture;
  MemorySource source(std::move(shots));
  const auto seen = value_of(observed(source));
  ASSERT_EQ(seen.sightings.size(), 4U);
  EXPECT_EQ(seen.sightings[2].corners, seen.sightings[1].corners);
  EXPECT_NE(seen.sightings[2].time_s, seen.sightings[1].time_s);
  EXPECT_NE(seen.sightings[3].corners, seen.sightings[2].corners);
}

TEST(ObserveTest, AFloorTagThatIsThereTwiceIsInNoMedian) {
  std::vector<MemorySource::Shot> shots;
  shots.push_back(shot({robot_at(60, 60), {100, square_corners(250, 180, 48, 0)}}, 1));
  shots.push_back(shot({robot_at(60, 60),
                        {100, square_corners(250, 180, 48, 0)},
                        {100, square_corners(180, 180, 48, 0)}},
                       2.5));
  MemorySource source(std::move(shots));
  const auto seen = value_of(observed(source));
  ASSERT_EQ(seen.record.references.size(), 1U);
  EXPECT_EQ(seen.record.references[0].frames, 1);
}

TEST(ObserveTest, AVideoThatBreaksOffIsARecordWithAnIssue) {
  MemorySource source(moving(6));
  source.breaks_at_ = 4;
  const auto seen = value_of(observed(source));
  EXPECT_EQ(seen.record.frames, 4);
  ASSERT_EQ(seen.issues.size(), 1U);
  EXPECT_EQ(seen.issues[0].code, IssueCode::VideoTruncated);
  EXPECT_EQ(
      seen.issues[0].text,
      "run.mp4: it broke off after 4 frames, at 12.300 s of its clock: run.mp4: invalid data");
}

TEST(ObserveTest, AVideoThatHasFewerFramesThanItAnnouncesIsTruncated) {
  MemorySource source(moving(6));
  source.info_.expected_frames = 60;
  const auto seen = value_of(observed(source));
  ASSERT_EQ(seen.issues.size(), 1U);
  EXPECT_EQ(seen.issues[0].code, IssueCode::VideoTruncated);
  EXPECT_THAT(seen.issues[0].text, HasSubstr("after 6 frames, at 12.500 s"));
}

TEST(ObserveTest, AVideoThatEndsBeforeItsHeaderSaysIsTruncated) {
  MemorySource source(moving(3));
  source.info_.is_truncated = true;
  const auto seen = value_of(observed(source));
  ASSERT_EQ(seen.issues.size(), 1U);
  EXPECT_EQ(seen.issues[0].code, IssueCode::VideoTruncated);
}

TEST(ObserveTest, AVideoWithoutFramesIsNone) {
  MemorySource empty({});
  const auto seen = observed(empty);
  ASSERT_FALSE(seen.has_value());
  EXPECT_THAT(to_string(seen.error()), HasSubstr("E_VIDEO_UNREADABLE"));
  MemorySource broken(moving(2));
  broken.breaks_at_ = 0;
  const auto none = observed(broken);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().message, "invalid data");
}

TEST(ObserveTest, TimesThatGoBackAreAnError) {
  std::vector<MemorySource::Shot> shots = moving(4);
  shots[2].time_s = 12.05;
  MemorySource source(std::move(shots));
  const auto seen = observed(source);
  ASSERT_FALSE(seen.has_value());
  EXPECT_THAT(to_string(seen.error()), HasSubstr("E_TIMESTAMPS"));
}

TEST(ObserveTest, ASidecarMustHaveARowForEachFrame) {
  MemorySource source(moving(3));
  const auto seen = observed(source, {}, std::vector<double>{1, 1.1, 1.2, 1.3});
  ASSERT_FALSE(seen.has_value());
  EXPECT_THAT(to_string(seen.error()), HasSubstr("E_SIDECAR_MISMATCH"));
  MemorySource again(moving(3));
  const auto right = value_of(observed(again, {}, std::vector<double>{1, 1.1, 1.2}));
  EXPECT_EQ(right.record.time_source, TimeSource::Sidecar);
  EXPECT_EQ(right.record.frame_times, (std::vector<double>{1, 1.1, 1.2}));
}

TEST(ObserveTest, TellsHowFarItIs) {
  MemorySource source(moving(3));
  auto clock = FrameClock::of(source.info(), std::nullopt);
  std::vector<std::int64_t> done;
  std::size_t most_seen = 0;
  ASSERT_TRUE(observe({{}, source, *clock, {}}, options(),
                      [&](std::int64_t at, std::int64_t of, const std::vector<Detection>& tags) {
                        done.push_back(at);
                        EXPECT_EQ(of, 3);
                        most_seen = std::max(most_seen, tags.size());
                      })
                  .has_value());
  EXPECT_EQ(done, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(most_seen, 2U);
}

TEST(ObserveTest, AnUnknownFamilyIsNamed) {
  MemorySource source(moving(1));
  auto clock = FrameClock::of(source.info(), std::nullopt);
  ObserveOptions wrong = options();
  wrong.family = "tag37";
  const auto seen = observe({{}, source, *clock, {}}, wrong);
  ASSERT_FALSE(seen.has_value());
  EXPECT_THAT(seen.error().message, HasSubstr("tag37"));
}

}  // namespace
}  // namespace swarmsmith
