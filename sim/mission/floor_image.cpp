#include "sim/mission/floor_image.h"

#include <png.h>

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace swarmsmith {
namespace {

/// libpng's state, which must be freed.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

/// The pictures in use, kept to share them: a mission may show one in forty places, and a
/// coordinator has many campaigns.
class Known {
 public:
  /// The picture made from the same bytes; null if there is none.
  std::shared_ptr<const Picture> find(const std::string& png) {
    const std::scoped_lock lock(mutex_);
    std::erase_if(pictures_, [](const auto& picture) { return picture.expired(); });
    for (const auto& known : pictures_) {
      if (auto picture = known.lock(); picture != nullptr && picture->png() == png) return picture;
    }
    return nullptr;
  }
  void add(const std::shared_ptr<const Picture>& picture) {
    const std::scoped_lock lock(mutex_);
    pictures_.push_back(picture);
  }
  std::int64_t pixels() {
    const std::scoped_lock lock(mutex_);
    std::int64_t sum = 0;
    for (const auto& known : pictures_) {
      if (const auto picture = known.lock())
        sum += std::int64_t{picture->width()} * std::int64_t{picture->height()};
    }
    return sum;
  }

 private:
  std::mutex mutex_;
  std::vector<std::weak_ptr<const Picture>> pictures_;
};

Known& known_pictures() {
  static Known known;
  return known;
}

}  // namespace

Expected<std::shared_ptr<const Picture>> Picture::from_png(std::string bytes,
                                                           std::int64_t most_in_use) {
  if (bytes.size() > kMostBytes) {
    return bad_input("the image has " + std::to_string(bytes.size()) +
                     " bytes; at most 1 MB is allowed: make it smaller, or use fewer colours");
  }
  if (auto known = known_pictures().find(bytes)) return known;
  PngImage image;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    return bad_input("this is not a PNG image: " + std::string(image.message));
  }
  const std::int64_t pixels = std::int64_t{image.width} * std::int64_t{image.height};
  if (pixels > kMostPixels) {
    return bad_input("the image has " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) +
                     " pixels; at most 16 million are allowed: make it smaller");
  }
  if (pixels + known_pictures().pixels() > most_in_use) {
    return bad_input("the pictures of all floors have more than " +
                     std::to_string(most_in_use / 1'000'000) +
                     " million pixels together: make them smaller");
  }
  image.format = PNG_FORMAT_RGBA;
  // Otherwise libpng would treat files with 16 bits per channel as linear light.
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  // Shared, because an arena is copied for each run but its pictures need not be.
  std::shared_ptr<Picture> picture(new Picture);
  picture->width_ = static_cast<int>(image.width);
  picture->height_ = static_cast<int>(image.height);
  picture->pixels_.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture->pixels_.data(), 0, nullptr) == 0) {
    return bad_input("the PNG image is damaged: " + std::string(image.message));
  }
  picture->png_ = std::move(bytes);
  known_pictures().add(picture);
  return picture;
}

std::optional<Rgb> Picture::at(int column, int row) const {
  const auto first = 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(column));
  if (pixels_[first + 3] < 128) return std::nullopt;
  return Rgb{pixels_[first], pixels_[first + 1], pixels_[first + 2]};
}

std::optional<Rgb> pixel_at(const Picture& picture, Point top_left, double width_m, double height_m,
                            Point point) {
  const double across = (point.x - top_left.x) / width_m;
  const double down = (top_left.y - point.y) / height_m;
  if (!(across >= 0 && across <= 1 && down >= 0 && down <= 1)) return std::nullopt;
  const int column = static_cast<int>(across * picture.width());
  const int row = static_cast<int>(down * picture.height());
  return picture.at(std::min(column, picture.width() - 1), std::min(row, picture.height() - 1));
}

}  // namespace swarmsmith
