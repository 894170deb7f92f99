#include <filesystem>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"
#include "tests/tracking/video/written_rosbag2.h"

namespace swarmsmith {
namespace {

constexpr BagTime kBegin = 1'732'391'823'000'000'000;
constexpr BagTime kApart = 40'000'000;
constexpr const char* kTopic = "/ceiling/image_raw";
constexpr const char* kImage = "sensor_msgs/msg/Image";

BagImage image_of(int number) {
  BagImage image;
  image.stamp = kBegin + number * kApart;
  image.recorded = image.stamp + 3'000'000;
  image.width = static_cast<std::uint32_t>(kMadeSize.width);
  image.height = static_cast<std::uint32_t>(kMadeSize.height);
  image.step = image.width;
  image.data = numbered_picture(number);
  return image;
}

std::string mcap_of(int images, const std::string& packing, const std::string& encoding = "cdr") {
  WrittenMcap bag(packing, 4, encoding);
  for (int i = 0; i < images; ++i) {
    const BagImage image = image_of(i);
    bag.add("/temperature", "sensor_msgs/msg/Temperature", image.recorded, "xx");
    bag.add(kTopic, encoding == "ros1" ? "sensor_msgs/Image" : kImage, image.recorded,
            encoding == "ros1" ? ros1_of(image) : cdr_of(image, i % 2 == 1));
  }
  return bag.finished();
}

void expect_all(const ReadVideo& video, int images) {
  ASSERT_FALSE(video.error) << to_string(*video.error);
  EXPECT_TRUE(video.info.has_times);
  EXPECT_EQ(video.info.expected_frames, images);
  ASSERT_EQ(video.frames.size(), static_cast<std::size_t>(images));
  for (int i = 0; i < images; ++i) {
    const ReadFrame& frame = video.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.number, i);
    EXPECT_EQ(frame.code, i);
    EXPECT_NEAR(frame.time_s.value(), 1732391823 + 0.04 * i, 1e-6);
  }
}

TEST(McapTest, GivesItsImagesAndTheirStamps) {
  const TemporaryFolder folder;
  for (const char* packing : {"none", "zstd", "lz4", "bare"}) {
    for (const char* encoding : {"cdr", "ros1"}) {
      write_bytes(folder / "run.mcap", mcap_of(30, packing, encoding));
      expect_all(read_video(folder / "run.mcap"), 30);
      expect_all(read_video((folder / "run.mcap").string() + ":" + kTopic), 30);
    }
  }
  // By its first bytes, whatever its name is.
  std::filesystem::rename(folder / "run.mcap", folder / "run.data");
  expect_all(read_video(folder / "run.data"), 30);
}

TEST(McapTest, ARecorderThatWasKilledLeavesItsWholeChunks) {
  const TemporaryFolder folder;
  const std::string whole = mcap_of(30, "zstd");
  write_bytes(folder / "cut.mcap", whole.substr(0, whole.size() * 6 / 10));
  const ReadVideo video = read_video(folder / "cut.mcap");
  ASSERT_FALSE(video.error) << to_string(*video.error);
  EXPECT_GT(video.frames.size(), 10U);
  EXPECT_LT(video.frames.size(), 22U);
}

TEST(McapTest, AChunkThatIsDamagedIsToldWithItsPlace) {
  const TemporaryFolder folder;
  for (const char* packing : {"none", "zstd", "lz4"}) {
    std::string bytes = mcap_of(30, packing);
    bytes[bytes.size() / 2] ^= 0x10;
    write_bytes(folder / "run.mcap", bytes);
    const ReadVideo video = read_video(folder / "run.mcap");
    ASSERT_TRUE(video.error) << packing;
    EXPECT_THAT(video.error->message, HasSubstr("E_VIDEO_UNREADABLE: is damaged at byte "));
  }
}

TEST(Db3Test, GivesItsImagesAndTheirStamps) {
  const TemporaryFolder folder;
  {
    WrittenDb3 bag(folder / "run_0.db3");
    for (int i = 0; i < 20; ++i) {
      bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
      bag.add("/temperature", "sensor_msgs/msg/Temperature", image_of(i).recorded, "xx");
    }
  }
  expect_all(read_video(folder / "run_0.db3"), 20);
  expect_all(read_video((folder / "run_0.db3").string() + ":" + kTopic), 20);
  const ReadVideo other = read_video((folder / "run_0.db3").string() + ":/temperature");
  ASSERT_TRUE(other.error);
  EXPECT_THAT(other.error->message, HasSubstr("has no images, but sensor_msgs/msg/Temperature"));
}

TEST(RecordedImagesTest, FilesOfOthersAreUnderstood) {
  const std::string golden = SWARMSMITH_ROSBAG2_BAGS;
  const auto refusal = [&](const char* file) {
    const ReadVideo video = read_video(golden + file);
    return video.error ? video.error->message : "";
  };
  for (const char* file : {"cdr_test_0.mcap", "cdr_test_0.db3"}) {
    EXPECT_THAT(refusal(file), HasSubstr("there are no images in this bag; it has"));
    EXPECT_THAT(refusal(file), HasSubstr("/test_topic (test_msgs/msg/BasicTypes)"));
  }
  // Packed with zstd, by another writer.
  EXPECT_THAT(refusal("wbag_0.mcap"), HasSubstr("std_msgs/msg/"));
}

TEST(ChaptersTest, OfOneCameraAreOneFilm) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "run");
  // Each begins anew, as of cameras that write chapters; number 10 is after number 9.
  for (const int chapter : {9, 10, 11}) {
    make_video(folder / "run" / ("GX" + std::to_string(chapter) + ".mp4"), even_times(10, 20), {});
  }
  const ReadVideo video = read_video(folder / "run");
  ASSERT_FALSE(video.error) << to_string(*video.error);
  ASSERT_EQ(video.frames.size(), 30U);
  for (int i = 0; i < 30; ++i) {
    const ReadFrame& frame = video.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.number, i);
    EXPECT_EQ(frame.code, i % 10);
    EXPECT_NEAR(frame.time_s.value(), i / 20.0, 1e-6);
  }
}

TEST(ChaptersTest, PartsOfABagKeepTheirTimes) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "run");
  for (int part = 0; part < 3; ++part) {
    WrittenMcap bag("zstd");
    for (int i = 10 * part; i < 10 * part + 10; ++i)
      bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
    write_bytes(folder / "run" / ("run_" + std::to_string(part) + ".mcap"), bag.finished());
  }
  write_bytes(folder / "run" / "metadata.yaml", "rosbag2_bagfile_information:\n");
  for (const std::string& word :
       {(folder / "run").string(), (folder / "run").string() + ":" + kTopic}) {
    ReadVideo video = read_video(word);
    EXPECT_EQ(video.info.expected_frames, 0);
    video.info.expected_frames = 30;
    expect_all(video, 30);
  }
}

TEST(ChaptersTest, OfAnotherSizeAreNone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "run");
  make_video(folder / "run" / "a1.mp4", even_times(10, 20), {});
  WrittenMcap bag;
  BagImage small = image_of(0);
  small.height -= 16;
  bag.add(kTopic, kImage, small.recorded, cdr_of(small));
  write_bytes(folder / "run" / "a2.mcap", bag.finished());
  const ReadVideo video = read_video(folder / "run");
  ASSERT_TRUE(video.error);
  EXPECT_THAT(video.error->message, HasSubstr("the film of one camera"));
}

}  // namespace
}  // namespace swarmsmith
