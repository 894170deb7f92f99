#include "tracking/live/newest_frame.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A camera that gives its frames as fast as they are let through.
class GatedSource : public FrameSource {
 public:
  explicit GatedSource(std::int64_t frames) : frames_(frames), pixels_(64 * 48) {
    info_.size = {64, 48};
    info_.is_live = true;
  }
  const SourceInfo& info() const override { return info_; }
  Expected<bool> next() override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return allowed_ > at_ + 1 || at_ + 1 >= frames_ || closed_; });
    if (at_ + 1 >= frames_ || closed_) return false;
    if (at_ + 1 == breaks_at_) return unexpected(ErrorKind::Unavailable, "the camera went away");
    ++at_;
    std::fill(pixels_.begin(), pixels_.end(), static_cast<std::uint8_t>(at_));
    frame_ = {at_, 0.1 * static_cast<double>(at_), {pixels_.data(), 64, 48, 64}};
    return true;
  }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override {
    return {64, 48, std::vector<std::uint8_t>(64 * 48 * 3, static_cast<std::uint8_t>(at_))};
  }
  std::int64_t damaged_frames() const override { return 0; }

  void allow(std::int64_t frames) {
    {
      const std::scoped_lock lock(mutex_);
      allowed_ = frames;
    }
    changed_.notify_all();
  }
  void close() {
    {
      const std::scoped_lock lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

  SourceInfo info_;
  std::int64_t breaks_at_ = -1;

 private:
  std::int64_t frames_;
  std::vector<std::uint8_t> pixels_;
  std::int64_t at_ = -1;
  std::int64_t allowed_ = 0;
  bool closed_ = false;
  Frame frame_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

TEST(NewestFrameTest, WhoIsSlowGetsTheNewestAndTheCountOfTheOthers) {
  GatedSource source(10);
  std::atomic<std::int64_t> done = -1;
  NewestFrame newest(source, [&](FrameSource& of, double) -> Expected<void> {
    done = of.frame().number;
    return {};
  });
  EXPECT_FALSE(newest.take(milliseconds(1)).has_value());
  source.allow(1);
  const auto first = value_of(newest.take(seconds(10)));
  EXPECT_EQ(first.number, 0);
  EXPECT_EQ(newest.dropped(), 0);
  source.allow(5);
  ASSERT_TRUE(eventually([&] { return done >= 4; }));
  const auto late = value_of(newest.take(seconds(10)));
  EXPECT_EQ(late.number, 4);
  EXPECT_EQ(late.gray.at(100), 4);
  EXPECT_EQ(newest.dropped(), 3);
  EXPECT_FALSE(late.color.has_value());
  EXPECT_FALSE(newest.has_ended());
  source.close();
  EXPECT_FALSE(newest.take(seconds(10)).has_value());
  EXPECT_TRUE(newest.has_ended());
  EXPECT_FALSE(newest.error().has_value());
}

TEST(NewestFrameTest, HasColoursWhileTheyAreWanted) {
  GatedSource source(2);
  NewestFrame newest(source, {});
  newest.wants_color(true);
  source.allow(1);
  const auto frame = value_of(newest.take(seconds(10)));
  ASSERT_TRUE(frame.color.has_value());
  EXPECT_EQ(frame.color->width, 64);
  source.close();
}

TEST(NewestFrameTest, ACameraThatGoesAwayEndsItWithItsError) {
  GatedSource source(5);
  source.breaks_at_ = 2;
  NewestFrame newest(source, {});
  source.allow(5);
  while (newest.take(seconds(10)).has_value()) {
  }
  EXPECT_TRUE(newest.has_ended());
  ASSERT_TRUE(newest.error().has_value());
  EXPECT_EQ(newest.error()->message, "the camera went away");
}

TEST(NewestFrameTest, ARecordingThatFailsEndsIt) {
  GatedSource source(5);
  NewestFrame newest(source, [](FrameSource&, double) -> Expected<void> {
    return unexpected(ErrorKind::Unavailable, "the disk is full");
  });
  source.allow(5);
  while (newest.take(seconds(10)).has_value()) {
  }
  ASSERT_TRUE(newest.error().has_value());
  EXPECT_EQ(newest.error()->message, "the disk is full");
}

/// Half a second of a file takes half a second.
TEST(NewestFrameTest, FilesComeAtTheirPace) {
  GatedSource source(6);
  source.info_.is_live = false;
  source.allow(6);
  const auto begin = std::chrono::steady_clock::now();
  NewestFrame newest(source, {});
  std::int64_t last = -1;
  while (const auto frame = newest.take(seconds(10)))
    last = frame->number;
  EXPECT_EQ(last, 5);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(499));
}

}  // namespace
}  // namespace swarmsmith
