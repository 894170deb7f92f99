#include "tracking/video/internal/bag_file.h"

#include <array>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "base/output_file.h"
#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/support/long_runs.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"
#include "tests/tracking/video/written_bag.h"
#include "tracking/video/frame_clock.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr BagTime kBegin = 1'732'391'823'000'000'000;
constexpr BagTime kApart = 40'000'000;
/// From the camera's shutter to the recorder.
constexpr BagTime kDelay = 7'654'321;
constexpr const char* kTopic = "/camera/image_raw";
constexpr int kFrames = 12;

BagImage numbered_image(int number, ImageSize size = kMadeSize) {
  const BagTime stamp = kBegin + number * kApart;
  return {.recorded = stamp + kDelay,
          .stamp = stamp,
          .width = static_cast<std::uint32_t>(size.width),
          .height = static_cast<std::uint32_t>(size.height),
          .step = static_cast<std::uint32_t>(size.width),
          .data = numbered_picture(number, size)};
}

void write_bag(const fs::path& path, const std::string& packing = "none",
               std::uint32_t chunk_bytes = 768 * 1024) {
  fs::remove(path);
  WrittenBag bag(path, packing, chunk_bytes);
  for (int i = 0; i < kFrames; ++i) {
    bag.add(kTopic, numbered_image(i));
    bag.add_temperature("/room", kBegin + i * kApart + 1);
  }
}

BagPacked packed_image(int number, const std::string& ending) {
  const auto pixels = numbered_picture(number);
  const cv::Mat image(kMadeSize.height, kMadeSize.width, CV_8U,
                      const_cast<std::uint8_t*>(pixels.data()));
  BagPacked packed{.recorded = kBegin + number * kApart + kDelay,
                   .stamp = kBegin + number * kApart,
                   .format = "mono8; " + ending.substr(1) + " compressed "};
  cv::imencode(ending, image, packed.data);
  return packed;
}

double seconds(BagTime time) {
  return static_cast<double>(time / 1'000'000'000) +
         static_cast<double>(time % 1'000'000'000) / 1e9;
}

std::string message_of(const ReadVideo& video) {
  return video.error ? to_string(*video.error) : "no error";
}

void expect_all_frames(const ReadVideo& video) {
  ASSERT_FALSE(video.error) << message_of(video);
  EXPECT_EQ(video.info.size, kMadeSize);
  EXPECT_EQ(video.info.expected_frames, kFrames);
  EXPECT_TRUE(video.info.has_times);
  EXPECT_FALSE(video.info.is_live || video.info.is_truncated || video.info.has_count);
  EXPECT_EQ(video.damaged, 0);
  ASSERT_EQ(video.frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const ReadFrame& frame = video.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.number, i);
    EXPECT_EQ(frame.code, i);
    EXPECT_EQ(frame.time_s, seconds(kBegin + i * kApart));
  }
}

/// Frames in order, none twice, or a sentence. No crash and no hang is what else these tests ask.
void expect_sane(const ReadVideo& video) {
  EXPECT_TRUE(!video.error || message_of(video).size() > 20) << message_of(video);
  std::int64_t last = -1;
  for (const ReadFrame& frame : video.frames) {
    EXPECT_GT(frame.number, last);
    last = frame.number;
  }
  if (video.error) return;
  EXPECT_EQ(static_cast<std::int64_t>(video.frames.size()) + video.damaged,
            video.info.expected_frames);
}

TEST(BagFile, HasTheImagesOfItsTopicWithTheirStamps) {
  const TemporaryFolder folder;
  for (const char* packing : {"none", "bz2", "lz4"}) {
    // Everything in one chunk, and a chunk each.
    for (const std::uint32_t chunk_bytes : {768U * 1024, 1U}) {
      write_bag(folder / "run.bag", packing, chunk_bytes);
      SCOPED_TRACE(packing);
      expect_all_frames(read_video(folder / "run.bag"));
    }
  }
}

TEST(BagFile, IsKnownByItsFirstBytes) {
  const TemporaryFolder folder;
  write_bag(folder / "run");
  expect_all_frames(read_video(folder / "run"));
  write_bag(folder / "of:a:day.bag");
  expect_all_frames(read_video(folder / "of:a:day.bag"));
  expect_all_frames(read_video((folder / "of:a:day.bag").string() + ":" + kTopic));
}

TEST(BagFile, ImagesMayBePngOrJpeg) {
  const TemporaryFolder folder;
  for (const std::string ending : {".png", ".jpg"}) {
    {
      WrittenBag bag(folder / "run.bag");
      for (int i = 0; i < kFrames; ++i)
        bag.add("/camera/image_raw/compressed", packed_image(i, ending));
    }
    SCOPED_TRACE(ending);
    expect_all_frames(read_video(folder / "run.bag"));
  }
}

TEST(BagFile, TimesAreThoseOfTheRecorderWhereTheCameraHasNone) {
  const TemporaryFolder folder;
  {
    WrittenBag bag(folder / "run.bag");
    for (int i = 0; i < kFrames; ++i) {
      BagImage image = numbered_image(i);
      image.stamp = 0;
      bag.add(kTopic, image);
    }
  }
  const ReadVideo video = read_video(folder / "run.bag");
  ASSERT_EQ(video.frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i)
    EXPECT_EQ(video.frames[static_cast<std::size_t>(i)].time_s,
              seconds(kBegin + i * kApart + kDelay));
}

/// What a clock says of the frames of a bag.
std::string clock_on(const std::string& word) {
  auto source = FrameSource::open(word);
  if (!source) return to_string(source.error());
  auto clock = FrameClock::of((*source)->info(), std::nullopt);
  while ((*source)->next().value_or(false)) {
    if (const auto time = clock->time_of((*source)->frame()); !time) return to_string(time.error());
  }
  return "all is well";
}

TEST(BagFile, OneClockIsThatOfAllItsImages) {
  const TemporaryFolder folder;
  for (const BagTime third : {BagTime{0}, kBegin, kBegin + 2 * kApart}) {
    {
      WrittenBag bag(folder / "run.bag");
      for (int i = 0; i < 4; ++i) {
        BagImage image = numbered_image(i);
        if (i == 2) image.stamp = third;
        bag.add(kTopic, image);
      }
    }
    const std::string said = clock_on(folder / "run.bag");
    if (third == 0) {
      EXPECT_THAT(said, HasSubstr("E_TIMESTAMPS: frame 2 has no time"));
    } else if (third == kBegin) {
      EXPECT_THAT(said, HasSubstr("E_TIMESTAMPS: frame 2 at 1732391823 s is not later than"));
    } else {
      EXPECT_EQ(said, "all is well");
    }
  }
}

/// A picture of an even colour, blue, green, red, in an encoding.
BagImage even_image(const std::string& encoding, const std::array<int, 3>& bgr) {
  BagImage image{
      .recorded = kBegin, .stamp = kBegin, .encoding = encoding, .width = 32, .height = 24};
  const bool is_16 = encoding.ends_with("16");
  const auto put = [&](int value) {
    if (is_16) image.data.push_back(0);
    image.data.push_back(static_cast<std::uint8_t>(value));
  };
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      if (encoding.starts_with("bayer")) {
        // bayer_rggb8: the colours of a square of four, row by row.
        const char color = encoding[static_cast<std::size_t>(6 + 2 * (y % 2) + x % 2)];
        put(bgr.at(color == 'b' ? 0 : color == 'g' ? 1 : 2));
      } else if (encoding.starts_with("mono") || encoding == "8UC1") {
        put(bgr[1]);
      } else {
        const bool is_rgb = encoding.starts_with("rgb");
        put(bgr.at(is_rgb ? 2 : 0));
        put(bgr[1]);
        put(bgr.at(is_rgb ? 0 : 2));
        if (encoding.ends_with("a8")) put(17);
      }
    }
    image.data.insert(image.data.end(), is_16 || encoding.ends_with("a8") ? 6 : 7,
                      99);  // rows may be longer than their pixels
  }
  image.step = static_cast<std::uint32_t>(image.data.size() / image.height);
  return image;
}

TEST(BagFile, ReadsTheEncodingsOfCameras) {
  const TemporaryFolder folder;
  for (const std::string encoding :
       {"mono8", "8UC1", "mono16", "bgr8", "8UC3", "rgb8", "bgra8", "rgba8", "bayer_rggb8",
        "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8", "bayer_rggb16"}) {
    const bool is_gray = encoding.starts_with("mono") || encoding == "8UC1";
    const std::array<int, 3> bgr = is_gray ? std::array{90, 90, 90} : std::array{200, 90, 40};
    {
      WrittenBag bag(folder / "run.bag");
      bag.add(kTopic, even_image(encoding, bgr));
    }
    auto source = FrameSource::open(folder / "run.bag");
    ASSERT_TRUE(source) << encoding << to_string(source.error());
    ASSERT_TRUE((*source)->next().value_or(false)) << encoding;
    const GrayImage gray = (*source)->frame().gray;
    const ColorImage color = (*source)->color();
    ASSERT_EQ(color.bgr.size(), 3U * 32 * 24);
    const double wanted = 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2];
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) {
        ASSERT_NEAR(gray.pixels[y * gray.stride + x], wanted, 2) << encoding << x << ' ' << y;
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(color.bgr[static_cast<std::size_t>(3 * (32 * y + x) + c)],
                      bgr.at(static_cast<std::size_t>(c)), 1)
              << encoding << x << ' ' << y;
        }
      }
    }
  }
}

TEST(BagFile, BytesOfPixelsMayBeSwapped) {
  const TemporaryFolder folder;
  {
    WrittenBag bag(folder / "run.bag");
    BagImage image{.recorded = kBegin,
                   .encoding = "mono16",
                   .width = 32,
                   .height = 24,
                   .step = 64,
                   .is_big_endian = true};
    for (int i = 0; i < 32 * 24; ++i)
      image.data.insert(image.data.end(), {120, 3});
    bag.add(kTopic, image);
  }
  auto source = FrameSource::open(folder / "run.bag");
  ASSERT_TRUE(source && (*source)->next().value_or(false));
  EXPECT_NEAR((*source)->frame().gray.pixels[40], 120, 1);
}

TEST(BagFile, NamesAnEncodingThatIsNotRead) {
  const TemporaryFolder folder;
  {
    WrittenBag bag(folder / "run.bag");
    BagImage image = numbered_image(0);
    image.encoding = "32FC1";
    bag.add(kTopic, image);
  }
  EXPECT_THAT(message_of(read_video(folder / "run.bag")),
              AllOf(HasSubstr("run.bag: E_VIDEO_UNREADABLE"), HasSubstr("`32FC1`"),
                    HasSubstr("mono8, mono16, bgr8")));
}

TEST(BagFile, AnImageThatIsNoneIsDamagedAndOneOfAnotherSizeIsAnError) {
  const TemporaryFolder folder;
  {
    WrittenBag bag(folder / "run.bag");
    std::vector<BagImage> images;
    for (int i = 0; i < 6; ++i)
      images.push_back(numbered_image(i));
    images[0].data.resize(500);
    images[2].step = 20;
    images[4].encoding = "mono16";
    images[4].width = 78;
    images[4].step = 159;
    images[5] = numbered_image(5, {200, 96});
    for (const BagImage& image : images)
      bag.add(kTopic, image);
  }
  const ReadVideo video = read_video(folder / "run.bag");
  EXPECT_THAT(message_of(video), HasSubstr("image 5 is 200 x 96 pixels"));
  ASSERT_EQ(video.frames.size(), 2U);
  EXPECT_EQ(video.damaged, 3);
  EXPECT_EQ(video.frames[0].number, 1);
  EXPECT_EQ(video.frames[1].number, 3);
  EXPECT_EQ(video.frames[1].code, 3);
}

TEST(BagFile, OneOfSeveralTopicsIsChosen) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.bag";
  {
    WrittenBag bag(file);
    for (int i = 0; i < kFrames; ++i) {
      BagImage other = numbered_image(100 + i);
      other.recorded = kBegin + i * kApart;
      bag.add("/door/image_raw", other);
      bag.add(kTopic, numbered_image(i));
      bag.add_temperature("/room", kBegin + i * kApart);
    }
  }
  EXPECT_THAT(message_of(read_video(file)),
              AllOf(HasSubstr("run.bag: E_CONFIG: the bag has several topics of images"),
                    HasSubstr("run.bag:/camera/image_raw; those with images: /camera/image_raw, "
                              "/door/image_raw")));
  const ReadVideo video = read_video(file + ":" + kTopic);
  expect_all_frames(video);
  EXPECT_EQ(video.info.name, file + ":" + kTopic);
  EXPECT_EQ(read_video(file + ":/door/image_raw").frames.at(3).code, 103);
  EXPECT_THAT(message_of(read_video(file + ":/camera/image_rav")),
              AllOf(HasSubstr("E_CONFIG: the bag has no topic /camera/image_rav (did you mean"),
                    HasSubstr("those with images")));
  EXPECT_THAT(message_of(read_video(file + ":/room")),
              HasSubstr("topic /room has no images, but sensor_msgs/Temperature"));
  EXPECT_EQ(file_of_source(file + ":" + kTopic), file);
  EXPECT_EQ(file_of_source("camera:0"), "camera:0");
  EXPECT_EQ(file_of_source("a:b.mkv"), "a:b.mkv");
}

TEST(BagFile, SaysWhatABagWithoutImagesHas) {
  const TemporaryFolder folder;
  {
    WrittenBag bag(folder / "run.bag");
    bag.add_temperature("/room", kBegin);
    bag.add_temperature("/oven", kBegin);
  }
  EXPECT_THAT(
      message_of(read_video(folder / "run.bag")),
      HasSubstr("run.bag: E_VIDEO_UNREADABLE: there are no images in this bag; it has /oven "
                "(sensor_msgs/Temperature), /room (sensor_msgs/Temperature)"));
  { const WrittenBag bag(folder / "empty.bag"); }
  EXPECT_THAT(message_of(read_video(folder / "empty.bag")), HasSubstr("it has no messages"));
}

TEST(BagFile, RefusesAnotherDefinitionOfTheMessage) {
  const TemporaryFolder folder;
  write_bag(folder / "run.bag");
  std::string bytes = whole_file(folder / "run.bag");
  for (std::size_t at = 0; (at = bytes.find("060021388200f6f0", at)) != std::string::npos; ++at)
    bytes[at] = '7';
  write_bytes(folder / "other.bag", bytes);
  EXPECT_THAT(message_of(read_video(folder / "other.bag")),
              HasSubstr("another definition of sensor_msgs/Image"));
}

TEST(BagFile, SaysHowARecordingThatWasKilledIsMended) {
  const TemporaryFolder folder;
  WrittenBag bag(folder / "run.bag");
  for (int i = 0; i < kFrames; ++i)
    bag.add(kTopic, numbered_image(i));
  fs::copy_file(folder / "run.bag", folder / "run.bag.active");
  EXPECT_THAT(message_of(read_video(folder / "run.bag.active")),
              AllOf(HasSubstr("run.bag.active: E_VIDEO_UNREADABLE: has no index"),
                    HasSubstr("`rosbag reindex`")));
}

TEST(BagFile, SaysWhatIsNoBag) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of(read_video(folder / "none.bag")),
              HasSubstr("E_VIDEO_UNREADABLE: cannot be opened: No such file"));
  write_bytes(folder / "empty.bag", "");
  EXPECT_THAT(message_of(read_video(folder / "empty.bag")), HasSubstr("not a bag of ROS 1"));
  write_bytes(folder / "old.bag", "#ROSBAG V1.2\n and so on");
  EXPECT_THAT(message_of(read_video(folder / "old.bag")), HasSubstr("format 2.0"));
  write_bytes(folder / "long", "#ROSBAG" + std::string(5000, 'x'));
  EXPECT_THAT(message_of(read_video(folder / "long")), HasSubstr("not a bag of ROS 1"));
  write_bag(folder / "run.bag");
  std::string bytes = whole_file(folder / "run.bag");
  write_bytes(folder / "cut.bag", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(message_of(read_video(folder / "cut.bag")),
              AllOf(HasSubstr("is damaged or cut off at byte "), HasSubstr("`rosbag reindex`")));
}

TEST(BagFile, IsAnInputThatNoOutputDestroys) {
  const TemporaryFolder folder;
  write_bag(folder / "run.bag");
  expect_all_frames(read_video((folder / "run.bag").string() + ":" + kTopic));
  EXPECT_THAT(complaint_of(output_place(folder / "run.bag", FileKind::Video)),
              HasSubstr("would be overwritten"));
}

TEST(BagFile, CutAnywhereGivesASentence) {
  const TemporaryFolder folder;
  for (const char* packing : {"none", "bz2", "lz4"}) {
    write_bag(folder / "run.bag", packing, 40'000);
    const std::string bytes = whole_file(folder / "run.bag");
    constexpr std::size_t kParts = 80;
    for (std::size_t part = 0; part < kParts; ++part) {
      write_bytes(folder / "cut.bag", bytes.substr(0, bytes.size() * part / kParts));
      const ReadVideo video = read_video(folder / "cut.bag");
      EXPECT_TRUE(video.error) << packing << part;
      expect_sane(video);
    }
  }
}

TEST(BagFile, ADamagedChunkCostsItsImages) {
  const TemporaryFolder folder;
  for (const char* packing : {"bz2", "lz4"}) {
    write_bag(folder / "run.bag", packing, 40'000);
    std::string bytes = whole_file(folder / "run.bag");
    const std::size_t middle = bytes.size() / 2;
    for (std::size_t at = middle; at < middle + 60; ++at)
      bytes[at] = static_cast<char>(~bytes[at]);
    write_bytes(folder / "hurt.bag", bytes);
    const ReadVideo video = read_video(folder / "hurt.bag");
    ASSERT_FALSE(video.error) << packing << message_of(video);
    expect_sane(video);
    EXPECT_THAT(video.damaged, AllOf(testing::Ge(1), testing::Le(6))) << packing;
    for (const ReadFrame& frame : video.frames)
      EXPECT_EQ(frame.code, static_cast<int>(frame.number)) << packing;
  }
}

TEST(BagFile, FlippedBytesGiveFramesOrASentence) {
  const TemporaryFolder folder;
  Rng rng(20261124);
  for (const char* packing : {"none", "bz2", "lz4"}) {
    write_bag(folder / "run.bag", packing, 40'000);
    const std::string bytes = whole_file(folder / "run.bag");
    std::size_t shown = 0;
    int refused = 0;
    for (int i = 0; i < times(100, 300); ++i) {
      std::string hurt = bytes;
      for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) {
        // Half of them in what is small: the index at the end, headers.
        const std::size_t range = rng.below(2) == 0 ? 6000 : hurt.size();
        const std::size_t at = hurt.size() - 1 - rng.below(std::min(range, hurt.size()));
        hurt[at] = static_cast<char>(rng.below(256));
      }
      write_bytes(folder / "hurt.bag", hurt);
      const ReadVideo video = read_video(folder / "hurt.bag");
      expect_sane(video);
      shown += video.frames.size();
      refused += video.error ? 1 : 0;
    }
    EXPECT_GT(shown, 0U) << packing;
    EXPECT_GT(refused, 0) << packing;
  }
}

}  // namespace
}  // namespace swarmsmith
