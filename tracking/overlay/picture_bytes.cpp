#include "tracking/overlay/picture_bytes.h"

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace swarmsmith {
namespace {

std::string bytes_of(const ColorImage& image, const char* ending, const std::vector<int>& how) {
  // OpenCV only reads it, though its type has no word for that.
  const cv::Mat picture(image.height, image.width, CV_8UC3,
                        const_cast<std::uint8_t*>(image.bgr.data()));
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, picture, bytes, how);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string png_of(const ColorImage& image) {
  return bytes_of(image, ".png", {});
}

std::string jpeg_of(const ColorImage& image, int quality) {
  return bytes_of(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

}  // namespace swarmsmith
