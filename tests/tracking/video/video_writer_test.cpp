#include "tracking/video/video_writer.h"

#include <array>
#include <filesystem>
#include <limits>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"

namespace swarmsmith {
namespace {

std::string refusal(const std::string& path, ImageSize size, const VideoOptions& options) {
  const auto writer = VideoWriter::open(path, size, options);
  return writer ? "" : to_string(writer.error());
}

TEST(VideoWriter, GivesTheSameBytesEachTime) {
  const TemporaryFolder folder;
  for (const std::string codec : {"h264", "mjpeg", "ffv1"}) {
    for (const std::string name : {"a.mkv", "b.mkv"})
      make_video(folder / name, uneven_times(20), {.codec = codec, .b_frames = 2});
    EXPECT_EQ(whole_file(folder / "a.mkv"), whole_file(folder / "b.mkv")) << codec;
  }
}

TEST(VideoWriter, StandsUnderItsNameOnlyWhenItIsWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.mp4";
  {
    auto writer = value_of(VideoWriter::open(path, kMadeSize, {}));
    const auto pixels = numbered_picture(1);
    ASSERT_TRUE(writer.write(gray_image(pixels), 0));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "what is not finished is removed";
}

TEST(VideoWriter, RefusesWhatCannotBeWithASentence) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder / "a.wmv", kMadeSize, {}), HasSubstr(".mkv, .mp4 or .avi"));
  EXPECT_THAT(refusal(folder / "a.mkv", kMadeSize, {.codec = "theora"}), HasSubstr("theora"));
  EXPECT_THAT(refusal(folder / "a.mkv", {161, 96}, {}), HasSubstr("even"));
  EXPECT_THAT(refusal(folder / "a.mkv", {0, 96}, {}), HasSubstr("0 x 96"));
  EXPECT_THAT(refusal(folder / "a.mkv", {20000, 96}, {}), HasSubstr("20000 x 96"));
  EXPECT_THAT(refusal(folder / "a.mkv", kMadeSize, {.frame_rate = -1}), HasSubstr("rate"));
  EXPECT_THAT(refusal(folder / "a.mp4", kMadeSize, {.live = true}), HasSubstr(".mkv"));
  EXPECT_THAT(refusal(folder / "none" / "a.mkv", kMadeSize, {}), HasSubstr("No such file"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VideoWriter, RefusesTimesThatTheFileCannotCarry) {
  const TemporaryFolder folder;
  const auto pixels = numbered_picture(3);
  auto even_only = VideoWriter::open(folder / "a.avi", kMadeSize, {.codec = "mjpeg"});
  ASSERT_TRUE(even_only->write(gray_image(pixels), 0));
  EXPECT_THAT(complaint_of(even_only->write(gray_image(pixels), 0.08)),
              HasSubstr("frame 1: an .avi has no times"));

  auto writer = VideoWriter::open(folder / "a.mkv", kMadeSize, {});
  ASSERT_TRUE(writer->write(gray_image(pixels), 1));
  for (const double time :
       {1.0, 0.5, 1.0004, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e300})
    EXPECT_FALSE(writer->write(gray_image(pixels), time)) << time;
  EXPECT_FALSE(writer->write(gray_image(pixels, {80, 96}), 2)) << "another size";
  EXPECT_TRUE(writer->write(gray_image(pixels), 1.001));
}

TEST(VideoWriter, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "run.mkv");
  auto writer = VideoWriter::open(folder / "run.mkv", kMadeSize, {.live = true});
  const auto pixels = numbered_picture(3);
  Expected<void> done;
  for (int i = 0; writer && done && i < 200; ++i)
    done = writer->write(gray_image(pixels), i / 10.0);
  const std::string words =
      writer ? (done ? "" : to_string(done.error())) : to_string(writer.error());
  EXPECT_THAT(words, HasSubstr("No space left on device"));
}

TEST(VideoWriter, KeepsColoursAndTheirBrightness) {
  const TemporaryFolder folder;
  ColorImage image{kMadeSize.width, kMadeSize.height, {}};
  for (int i = 0; i < kMadeSize.width * kMadeSize.height; ++i) {
    const bool left = i % kMadeSize.width < kMadeSize.width / 2;
    for (const int value : left ? std::array{30, 60, 200} : std::array{20, 180, 40})
      image.bgr.push_back(static_cast<std::uint8_t>(value));
  }
  for (const std::string name : {"a.mkv", "a.mp4"}) {
    auto writer = VideoWriter::open(folder / name, kMadeSize, {.quality = 100});
    ASSERT_TRUE(writer->write(image, 0));
    ASSERT_TRUE(writer->finish());
    auto source = FrameSource::open(folder / name);
    ASSERT_TRUE(source && *(*source)->next());
    const ColorImage seen = (*source)->color();
    ASSERT_EQ(seen.bgr.size(), image.bgr.size());
    for (const std::size_t x : {40U, 120U}) {
      const std::size_t at = 3 * (48 * 160 + x);
      for (const std::size_t c : {0U, 1U, 2U})
        EXPECT_NEAR(seen.bgr[at + c], image.bgr[at + c], 3) << name << x << c;
      const double gray =
          0.114 * image.bgr[at] + 0.587 * image.bgr[at + 1] + 0.299 * image.bgr[at + 2];
      EXPECT_NEAR((*source)->frame().gray.pixels[48 * (*source)->frame().gray.stride +
                                                 static_cast<std::ptrdiff_t>(x)],
                  gray, 2);
    }
  }
}

}  // namespace
}  // namespace swarmsmith
