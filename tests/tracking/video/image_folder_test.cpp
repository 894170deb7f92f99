#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"
#include "tracking/video/internal/image_folder.h"
#include "tracking/video/internal/natural_order.h"

namespace swarmsmith {
namespace {

void write_image(const std::filesystem::path& path, int number, ImageSize size = kMadeSize) {
  const auto pixels = numbered_picture(number, size);
  const cv::Mat image(size.height, size.width, CV_8U, const_cast<std::uint8_t*>(pixels.data()));
  ASSERT_TRUE(cv::imwrite(path.string(), image));
}

TEST(NaturalOrder, CountsAsAPersonDoes) {
  EXPECT_TRUE(comes_before("shot9.png", "shot10.png"));
  EXPECT_FALSE(comes_before("shot10.png", "shot9.png"));
  EXPECT_TRUE(comes_before("a1b2", "a1b10"));
  EXPECT_TRUE(comes_before("a", "b"));
  EXPECT_TRUE(comes_before("a", "a1"));
  EXPECT_TRUE(comes_before("07.png", "7.png") != comes_before("7.png", "07.png"));
  EXPECT_FALSE(comes_before("a", "a"));
  EXPECT_TRUE(comes_before("99999999999999999999998", "99999999999999999999999"));
}

TEST(ImageFolder, NamesMayBeTimesSince1970) {
  EXPECT_EQ(time_in_name("a/1732391823.25.png"), 1732391823.25);
  EXPECT_EQ(time_in_name("1732391823.png"), 1732391823.0);
  EXPECT_EQ(time_in_name("left-1732391823250.jpg"), 1732391823.25);
  EXPECT_EQ(time_in_name("1732391823250000_left.png"), 1732391823.25);
  EXPECT_EQ(time_in_name("1732391823250000000.png"), 1732391823.25);
  EXPECT_EQ(time_in_name("cam2/1732391823-250000000.png"), 1732391823.25);
  EXPECT_EQ(time_in_name("1732391823_12.png"), 1732391823.0) << "a number of something else";
  EXPECT_EQ(time_in_name("cam-2026-11-18T11-06-40-250.png"), 1795000000.25);
  EXPECT_EQ(time_in_name("2026-11-18_11-06-40.25_left.png"), 1795000000.25);
  EXPECT_EQ(time_in_name("2026-11-18T11-06-40_0012.png"), 1795000000.0) << "a counter";
  for (const char* none : {"shot12.png", "0000000012.png", "20241123.png", "a.png", "1.5.png"})
    EXPECT_EQ(time_in_name(none), std::nullopt) << none;
}

TEST(ImageFolder, HasTheTimesOfItsNames) {
  const TemporaryFolder folder;
  for (int i = 0; i < 5; ++i)
    write_image(folder / ("f" + std::to_string(1732391823000 + 40 * i) + ".png"), i);
  const ReadVideo video = read_video(folder.path());
  ASSERT_FALSE(video.error) << to_string(*video.error);
  EXPECT_TRUE(video.info.has_times);
  ASSERT_EQ(video.frames.size(), 5U);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(video.frames[static_cast<std::size_t>(i)].time_s.value(), 1732391823 + 0.04 * i,
                1e-6);
}

TEST(ImageFolder, GoesByNumbersAndKnowsNoTimes) {
  const TemporaryFolder folder;
  const std::vector<std::string> endings = {".png", ".jpg", ".bmp", ".tif", ".pgm", ".PNG"};
  for (int i = 0; i < 24; ++i) {
    const std::string ending = endings[static_cast<std::size_t>(i) % endings.size()];
    write_image(folder / "image.png", i);
    if (ending != ".PNG") write_image(folder / ("image" + ending), i);
    std::filesystem::rename(folder / ("image" + (ending == ".PNG" ? ".png" : ending)),
                            folder / ("shot" + std::to_string(i) + ending));
    std::filesystem::remove(folder / "image.png");
  }
  write_bytes(folder / "times.csv", "frame,time_s\n");
  write_bytes(folder / ".hidden.png", "no image");
  const ReadVideo video = read_video(folder.path());
  ASSERT_FALSE(video.error) << to_string(*video.error);
  ASSERT_EQ(video.frames.size(), 24U);
  EXPECT_EQ(video.info.size, kMadeSize);
  EXPECT_EQ(video.info.expected_frames, 24);
  EXPECT_FALSE(video.info.has_times || video.info.has_count || video.info.is_live);
  for (int i = 0; i < 24; ++i) {
    EXPECT_EQ(video.frames[static_cast<std::size_t>(i)].code, i);
    EXPECT_FALSE(video.frames[static_cast<std::size_t>(i)].time_s);
  }
}

TEST(ImageFolder, KeepsEveryBitOfPngAndItsColours) {
  const TemporaryFolder folder;
  cv::Mat image(40, 50, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(5 * x),
                                   static_cast<std::uint8_t>(6 * y),
                                   static_cast<std::uint8_t>(3 * x + 2 * y)};
  }
  cv::imwrite((folder / "a.png").string(), image);
  auto source = FrameSource::open(folder.path());
  ASSERT_TRUE(source && *(*source)->next());
  const ColorImage seen = (*source)->color();
  ASSERT_EQ(seen.bgr.size(), image.total() * 3);
  EXPECT_EQ(seen.bgr, std::vector<std::uint8_t>(image.datastart, image.dataend));
  const GrayImage gray = (*source)->frame().gray;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3b c = image.at<cv::Vec3b>(y, x);
      EXPECT_NEAR(gray.pixels[y * gray.stride + x], 0.114 * c[0] + 0.587 * c[1] + 0.299 * c[2], 2);
    }
  }
}

TEST(ImageFolder, NamesWhatDoesNotFit) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "empty");
  EXPECT_THAT(to_string(*read_video(folder / "empty").error), HasSubstr("the folder has no image"));

  std::filesystem::create_directory(folder / "mixed");
  write_image(folder / "mixed" / "1.png", 1);
  write_image(folder / "mixed" / "2.png", 2, {200, 96});
  const ReadVideo mixed = read_video(folder / "mixed");
  EXPECT_EQ(mixed.frames.size(), 1U);
  ASSERT_TRUE(mixed.error);
  EXPECT_THAT(to_string(*mixed.error), HasSubstr("2.png"));
  EXPECT_THAT(to_string(*mixed.error), HasSubstr("200 x 96"));

  std::filesystem::create_directory(folder / "texts");
  write_bytes(folder / "texts" / "1.png", "no picture at all");
  EXPECT_THAT(to_string(*read_video(folder / "texts").error), HasSubstr("1.png"));
}

TEST(ImageFolder, LeavesADamagedImageOutButKeepsItsPlace) {
  const TemporaryFolder folder;
  for (int i = 0; i < 5; ++i)
    write_image(folder / (std::to_string(i) + ".jpg"), i);
  const std::string bytes = whole_file(folder / "2.jpg");
  write_bytes(folder / "2.jpg", bytes.substr(0, bytes.size() / 2));
  const ReadVideo video = read_video(folder.path());
  ASSERT_FALSE(video.error);
  ASSERT_EQ(video.frames.size(), 4U);
  EXPECT_EQ(video.damaged, 1);
  EXPECT_EQ(video.frames[2].number, 3);
  EXPECT_EQ(video.frames[2].code, 3);
}

}  // namespace
}  // namespace swarmsmith
