#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "base/rng.h"
#include "tests/support/long_runs.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"

namespace swarmsmith {
namespace {

constexpr int kFrames = 24;

/// Frames in order, none twice, or a sentence. No crash and no hang is what else these tests ask.
void expect_sane(const ReadVideo& video) {
  EXPECT_TRUE(!video.error || !to_string(*video.error).empty());
  std::int64_t last = -1;
  std::optional<double> time;
  for (const ReadFrame& frame : video.frames) {
    EXPECT_GT(frame.number, last);
    EXPECT_TRUE(!time || !frame.time_s || *frame.time_s > *time);
    last = frame.number;
    time = frame.time_s;
  }
  const std::int64_t told = static_cast<std::int64_t>(video.frames.size()) + video.damaged;
  const std::int64_t all = std::max(video.info.expected_frames, last + 1);
  EXPECT_LE(told, all);
  if (!video.error) {
    EXPECT_EQ(told, all);
  }
}

struct Kind {
  std::string name;
  VideoOptions options;
  bool ends_matter = false;  ///< without its end nothing can be read
};

std::vector<Kind> kinds() {
  return {{"a.mkv", {.codec = "h264", .frame_rate = 20, .b_frames = 2}, false},
          {"a.mp4", {.codec = "h264", .frame_rate = 20, .b_frames = 2}, true},
          {"j.mp4", {.codec = "mjpeg", .frame_rate = 20}, true},
          {"a.avi", {.codec = "mjpeg", .frame_rate = 20}, false},
          {"b.avi", {.codec = "h264", .frame_rate = 20, .b_frames = 2}, false},
          {"f.mkv", {.codec = "ffv1", .frame_rate = 20}, false}};
}

TEST(DamagedVideo, CutAnywhereGivesTheFramesBeforeOrASentence) {
  const TemporaryFolder folder;
  for (const Kind& kind : not_empty(kinds())) {
    make_video(folder / kind.name, even_times(kFrames, 20), kind.options);
    const std::string bytes = whole_file(folder / kind.name);
    std::size_t most = 0;
    for (std::size_t part = 1; part < 60; ++part) {
      write_bytes(folder / ("cut_" + kind.name), bytes.substr(0, bytes.size() * part / 60));
      const ReadVideo video = read_video(folder / ("cut_" + kind.name));
      expect_sane(video);
      EXPECT_LE(video.frames.size(), static_cast<std::size_t>(kFrames));
      most = std::max(most, video.frames.size());
    }
    EXPECT_EQ(most > kFrames / 2, !kind.ends_matter) << kind.name;
  }
}

TEST(DamagedVideo, FlippedBytesGiveFramesOrASentence) {
  const TemporaryFolder folder;
  Rng rng(20261121);
  for (const Kind& kind : not_empty(kinds())) {
    make_video(folder / kind.name, even_times(kFrames, 20), kind.options);
    const std::string bytes = whole_file(folder / kind.name);
    std::int64_t shown = 0;
    std::int64_t damaged = 0;
    const int tries = times(40, 120);
    for (int i = 0; i < tries; ++i) {
      std::string hurt = bytes;
      for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) {
        // Half of them in the headers, which are small.
        const std::size_t range =
            rng.below(2) == 0 ? std::min<std::size_t>(1000, hurt.size()) : hurt.size();
        const std::size_t at =
            rng.below(2) == 0 ? rng.below(range) : hurt.size() - 1 - rng.below(range);
        hurt[at] = static_cast<char>(rng.below(256));
      }
      write_bytes(folder / ("hurt_" + kind.name), hurt);
      const ReadVideo video = read_video(folder / ("hurt_" + kind.name));
      expect_sane(video);
      shown += static_cast<std::int64_t>(video.frames.size());
      damaged += video.damaged;
    }
    EXPECT_GT(shown, tries * kFrames / 3) << kind.name << ": most of a file survives";
    EXPECT_GT(damaged, 0) << kind.name << ": damage is seen";
  }
}

TEST(DamagedVideo, LeavesOutWhatWasBuiltOnADamagedPicture) {
  const TemporaryFolder folder;
  // Key frames at 0, 20 and 40.
  make_video(folder / "a.mkv", even_times(60, 20), {.frame_rate = 20});
  std::string bytes = whole_file(folder / "a.mkv");
  const ReadVideo whole = read_video(folder / "a.mkv");
  ASSERT_EQ(whole.frames.size(), 60U);
  // Into the middle of the frames, over some of them.
  for (std::size_t i = 0; i < 3000; ++i)
    bytes[bytes.size() / 2 + i] = static_cast<char>(0x55);
  write_bytes(folder / "b.mkv", bytes);
  const ReadVideo video = read_video(folder / "b.mkv");
  expect_sane(video);
  EXPECT_FALSE(video.error);
  EXPECT_LT(video.frames.size(), 60U);
  EXPECT_GT(video.frames.size(), 20U);
  for (const ReadFrame& frame : video.frames) {
    EXPECT_EQ(frame.time_s.value_or(-1), static_cast<double>(*frame.code) / 20)
        << "frames that are shown are whole, and at their own time";
  }
}

TEST(DamagedVideo, FoldersOfDamagedImages) {
  const TemporaryFolder folder;
  Rng rng(5);
  const auto pixels = numbered_picture(7);
  const cv::Mat image(kMadeSize.height, kMadeSize.width, CV_8U,
                      const_cast<std::uint8_t*>(pixels.data()));
  for (const std::string ending : {".jpg", ".png", ".bmp", ".tif", ".pgm"}) {
    const std::filesystem::path images = folder / ending.substr(1);
    std::filesystem::create_directory(images);
    cv::imwrite((images / ("0" + ending)).string(), image);
    const std::string bytes = whole_file(images / ("0" + ending));
    constexpr int kTries = 150;
    for (int i = 1; i < kTries; ++i) {
      std::string hurt = bytes;
      if (i % 2 == 0)
        hurt.resize(rng.below(hurt.size()));
      else
        hurt[rng.below(hurt.size())] = static_cast<char>(rng.below(256));
      write_bytes(images / (std::to_string(i) + ending), hurt);
    }
    const ReadVideo video = read_video(images);
    expect_sane(video);
    ASSERT_FALSE(video.frames.empty());
    EXPECT_EQ(video.frames.front().code, 7);
    EXPECT_TRUE(video.error || video.damaged > kTries / 4) << ending << ": cut images are left out";
  }
}

}  // namespace
}  // namespace swarmsmith
