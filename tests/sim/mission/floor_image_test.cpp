#include "sim/mission/floor_image.h"

#include <png.h>

#include "sim/mission/arena.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// The bytes of a PNG file with these pixels of four channels.
std::string png_of(int width, int height, const std::vector<std::uint8_t>& rgba) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, rgba.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, rgba.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

/// Two columns, three rows: red, green / blue, white / black, transparent.
const std::string kPng = png_of(2, 3, {255, 0,   0,   255, 0, 255, 0, 255, 0,   0,   255, 255,
                                       255, 255, 255, 255, 0, 0,   0, 255, 200, 200, 200, 127});

TEST(Picture, HasThePixelsOfItsFile) {
  const auto picture = Picture::from_png(kPng).value();
  EXPECT_EQ(picture->width(), 2);
  EXPECT_EQ(picture->height(), 3);
  EXPECT_EQ(picture->at(0, 0), (Rgb{255, 0, 0}));
  EXPECT_EQ(picture->at(1, 1), (Rgb{255, 255, 255}));
  EXPECT_EQ(picture->at(0, 2), (Rgb{0, 0, 0}));
  EXPECT_EQ(picture->at(1, 2), std::nullopt);
  EXPECT_EQ(picture->png(), kPng);
}

TEST(Picture, ThatIsNoneIsAnError) {
  const auto error = [](std::string bytes) {
    const auto picture = Picture::from_png(std::move(bytes));
    return picture ? "" : picture.error().message;
  };
  EXPECT_THAT(error(""), HasSubstr("not a PNG image"));
  EXPECT_THAT(error("GIF89a, really"), HasSubstr("not a PNG image"));
  EXPECT_THAT(error(kPng.substr(0, kPng.size() / 2)), HasSubstr("PNG image"));
  EXPECT_THAT(error(std::string(Picture::kMostBytes + 1, 'x')), HasSubstr("at most 1 MB"));
}

TEST(Picture, OfTooManyPixelsIsAnErrorBeforeItIsUnpacked) {
  const std::vector<std::uint8_t> black(4 * 4001 * 4000, 0);
  const std::string bytes = png_of(4001, 4000, black);
  ASSERT_LT(bytes.size(), Picture::kMostBytes);
  const auto picture = Picture::from_png(bytes);
  ASSERT_FALSE(picture);
  EXPECT_THAT(picture.error().message, HasSubstr("4001 x 4000 pixels; at most 16 million"));
}

TEST(Picture, OfOneFileIsDecodedOnce) {
  const std::vector<std::uint8_t> black(4 * 1000 * 1000, 0);
  const std::string bytes = png_of(1000, 1000, black);
  std::vector<std::shared_ptr<const Picture>> pictures;
  for (int i = 0; i < 400; ++i)
    pictures.push_back(Picture::from_png(bytes).value());
  EXPECT_EQ(pictures.front(), pictures.back());
  pictures.clear();
  EXPECT_TRUE(Picture::from_png(bytes).has_value());
}

TEST(Picture, ThatAreInUseHaveALimitTogether) {
  std::vector<std::shared_ptr<const Picture>> pictures;
  std::string refusal;
  for (int side = 3900; side < 4000 && refusal.empty(); ++side) {
    const std::vector<std::uint8_t> black(4 * static_cast<std::size_t>(side * side), 0);
    auto picture = Picture::from_png(png_of(side, side, black));
    if (picture) {
      pictures.push_back(*picture);
    } else {
      refusal = picture.error().message;
    }
  }
  EXPECT_EQ(pictures.size(), 2U);
  EXPECT_THAT(refusal, HasSubstr("more than 32 million pixels together"));
  pictures.clear();
  EXPECT_TRUE(Picture::from_png(kPng).has_value()) << "they are not in use any more";
}

TEST(FloorImage, LiesWithItsTopRowAtTheLargestYAndOwnsItsBorder) {
  Arena arena{.walls = {}, .patches = {}};
  // Pixels of 1 m x 1 m: x from 0 to 2, y from 0 to 3.
  arena.patches.push_back({FloorImage{{{1, 1.5}, 2, 3}, Picture::from_png(kPng).value()}, {}});
  EXPECT_EQ(floor_at(arena, {0.5, 2.5}), (Rgb{255, 0, 0}));
  EXPECT_EQ(floor_at(arena, {1.5, 2.5}), (Rgb{0, 255, 0}));
  EXPECT_EQ(floor_at(arena, {0.5, 0.5}), (Rgb{0, 0, 0}));
  // Between pixels: the right and the lower one.
  EXPECT_EQ(floor_at(arena, {1, 2.5}), (Rgb{0, 255, 0}));
  EXPECT_EQ(floor_at(arena, {0.5, 2}), (Rgb{0, 0, 255}));
  // The outer border belongs to the image, and nothing beyond it.
  EXPECT_EQ(floor_at(arena, {2, 3}), (Rgb{0, 255, 0}));
  EXPECT_EQ(floor_at(arena, {0, 0}), (Rgb{0, 0, 0}));
  EXPECT_EQ(floor_at(arena, {2.000001, 3}), (Rgb{127, 127, 127}));
  // What is transparent shows the floor.
  EXPECT_EQ(floor_at(arena, {1.5, 0.5}), (Rgb{127, 127, 127}));
}

}  // namespace
}  // namespace swarmsmith
