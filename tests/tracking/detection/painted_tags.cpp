#include "tests/tracking/detection/painted_tags.h"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tracking/detection/internal/family_library.h"

namespace swarmsmith {
namespace {

constexpr int kFiner = 4;  ///< than the picture, before it is averaged
constexpr int kCell = 20;  ///< pixels of a tag's cell in its own image

struct OfficialTag {
  cv::Mat image;      ///< kCell pixels a cell
  double border = 0;  ///< where the border begins, pixels from the left
  double edge = 0;    ///< of the border, pixels
};

OfficialTag official_tag(const std::string& family, int tag, const Shortcomings& look) {
  const FamilyPointer of = tag_family_of(family);
  if (of == nullptr) throw std::out_of_range("no such family");
  image_u8_t* const drawn = apriltag_to_image(of.get(), static_cast<std::uint16_t>(tag));
  if (drawn == nullptr) throw std::out_of_range("no such tag");
  const cv::Mat cells(drawn->height, drawn->width, CV_8U, drawn->buf,
                      static_cast<std::size_t>(drawn->stride));
  OfficialTag official;
  cv::resize(cells, official.image, {}, kCell, kCell, cv::INTER_NEAREST);
  official.image.convertTo(official.image, CV_32F, (look.white - look.black) / 255, look.black);
  official.border = kCell * (of->total_width - of->width_at_border) / 2.0;
  official.edge = kCell * of->width_at_border;
  // image_u8_destroy is in a library that pkg-config does not name.
  std::free(drawn->buf);
  std::free(drawn);
  return official;
}

/// Puts a tag into a picture of kFiner times the resolution.
void put(const OfficialTag& official, const TagCorners& corners, cv::Mat& finer) {
  // Edges of cells lie half a pixel before the middle of a pixel.
  const auto low = static_cast<float>(official.border - 0.5);
  const auto high = static_cast<float>(official.border + official.edge - 0.5);
  const std::vector<cv::Point2f> from{{low, high}, {high, high}, {high, low}, {low, low}};
  std::vector<cv::Point2f> to;
  for (const ImagePoint& corner : corners)
    to.emplace_back(static_cast<float>(kFiner * corner.u + (kFiner - 1) / 2.0),
                    static_cast<float>(kFiner * corner.v + (kFiner - 1) / 2.0));
  // A tag's image is larger than its border: a quiet zone, in some families whole rings of cells.
  const cv::Rect border = cv::boundingRect(to);
  const int more = std::max(border.width, border.height);
  const cv::Rect around =
      (border + cv::Size(2 * more, 2 * more) - cv::Point(more, more)) & cv::Rect({}, finer.size());
  for (cv::Point2f& point : to)
    point -= cv::Point2f(static_cast<float>(around.x), static_cast<float>(around.y));
  cv::Mat part = finer(around);
  cv::warpPerspective(official.image, part, cv::getPerspectiveTransform(from, to), around.size(),
                      cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
}

}  // namespace

TagCorners square_corners(double u, double v, double edge_px, double turned_rad) {
  const double c = std::cos(turned_rad) * edge_px / 2;
  const double s = std::sin(turned_rad) * edge_px / 2;
  const auto corner = [&](double x, double y) {
    return ImagePoint{u + x * c - y * s, v - (x * s + y * c)};
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

PaintedPicture painted(int width, int height, const std::string& family,
                       const std::vector<PaintedTag>& tags, const Shortcomings& shortcomings,
                       std::uint64_t seed) {
  cv::Mat finer(height * kFiner, width * kFiner, CV_32F, cv::Scalar(shortcomings.floor));
  for (const PaintedTag& each : tags)
    put(official_tag(family, each.tag, shortcomings), each.corners, finer);
  cv::Mat picture;
  cv::resize(finer, picture, {width, height}, 0, 0, cv::INTER_AREA);
  if (shortcomings.blur_px > 0)
    cv::GaussianBlur(picture, picture, {}, shortcomings.blur_px, shortcomings.blur_px);
  if (shortcomings.noise > 0) {
    cv::Mat noise(picture.size(), CV_32F);
    cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, shortcomings.noise);
    picture += noise;
  }
  PaintedPicture result{width, height,
                        std::vector<std::uint8_t>(static_cast<std::size_t>(width * height))};
  cv::Mat bytes(height, width, CV_8U, result.pixels.data());
  picture.convertTo(bytes, CV_8U);
  return result;
}

}  // namespace swarmsmith
