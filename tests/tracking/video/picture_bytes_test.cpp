#include "tracking/video/picture_bytes.h"

#include <cstdlib>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"

namespace swarmsmith {
namespace {

/// Colours that change slowly; odd sizes have half a pixel of colour at their ends.
ColorImage painted(int width, int height) {
  ColorImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : {40 + x, 200 - y, 90 + x / 2})
        image.bgr.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return image;
}

ColorImage read_back(const std::string& bytes, const std::string& ending) {
  const TemporaryFolder folder;
  write_bytes(folder / ("a" + ending), bytes);
  auto source = FrameSource::open(folder / ("a" + ending));
  EXPECT_TRUE(source) << to_string(source.error());
  EXPECT_TRUE((*source)->next().value_or(false));
  return (*source)->color();
}

TEST(PictureBytes, APngHasEveryBit) {
  for (const auto& [width, height] : {std::pair{64, 48}, std::pair{33, 17}, std::pair{1, 1}}) {
    const ColorImage image = painted(width, height);
    const auto bytes = value_of(png_of(image));
    const ColorImage read = read_back(bytes, ".png");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.bgr, image.bgr);
  }
}

TEST(PictureBytes, AJpegIsNearAndSmallerWhenWorse) {
  const ColorImage image = painted(97, 63);
  const auto good = jpeg_of(image, 90);
  const auto bad = jpeg_of(image, 20);
  ASSERT_TRUE(good && bad);
  EXPECT_THAT(*good, StartsWith("\xff\xd8"));
  EXPECT_LT(bad->size(), good->size());
  const ColorImage read = read_back(*good, ".jpg");
  ASSERT_EQ(read.bgr.size(), image.bgr.size());
  int worst = 0;
  for (std::size_t i = 0; i < image.bgr.size(); ++i)
    worst = std::max(worst, std::abs(int{read.bgr[i]} - int{image.bgr[i]}));
  EXPECT_LE(worst, 12);
}

TEST(PictureBytes, APictureThatCannotBeIsASentence) {
  EXPECT_THAT(complaint_of(png_of(ColorImage{})), HasSubstr("cannot be encoded as png"));
}

}  // namespace
}  // namespace swarmsmith
