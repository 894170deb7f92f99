#include "tracking/video/internal/picture.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "tracking/rig/issue.h"

namespace swarmsmith::av {
namespace {

/// Exact arithmetic: the same bytes on every processor.
constexpr int kExact = SWS_BILINEAR | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INT;

/// In Y'UV and grey formats with 8 bits per sample, the first plane is the brightness.
bool has_gray_plane(AVPixelFormat format) {
  const AVPixFmtDescriptor* about = av_pix_fmt_desc_get(format);
  constexpr std::uint64_t kOther = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL |
                                   AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL |
                                   AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_FLOAT;
  if (about == nullptr || (about->flags & kOther) != 0) return false;
  const AVComponentDescriptor& y = about->comp[0];
  return y.plane == 0 && y.step == 1 && y.offset == 0 && y.depth == 8 && y.shift == 0;
}

bool is_full_range(const AVFrame& frame) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  const AVPixFmtDescriptor* about = av_pix_fmt_desc_get(format);
  return frame.color_range == AVCOL_RANGE_JPEG || format == AV_PIX_FMT_YUVJ420P ||
         format == AV_PIX_FMT_YUVJ422P || format == AV_PIX_FMT_YUVJ444P ||
         format == AV_PIX_FMT_YUVJ440P || format == AV_PIX_FMT_YUVJ411P ||
         (about != nullptr &&
          ((about->flags & AV_PIX_FMT_FLAG_RGB) != 0 ||
           (about->nb_components < 3 && frame.color_range == AVCOL_RANGE_UNSPECIFIED)));
}

/// If the matrix is not specified: still pictures, motion JPEG and small videos use BT.601; players
/// assume BT.709 for larger videos.
int matrix_of(const AVFrame& frame) {
  constexpr int kHighDefinition = 720;
  switch (static_cast<int>(frame.colorspace)) {
    case AVCOL_SPC_BT709:
      return SWS_CS_ITU709;
    case AVCOL_SPC_UNSPECIFIED:
      return frame.height >= kHighDefinition && !is_full_range(frame) ? SWS_CS_ITU709
                                                                      : SWS_CS_ITU601;
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL:
      return SWS_CS_BT2020;
    default:
      return SWS_CS_ITU601;
  }
}

/// Replaces full-range formats; swscale needs the normal format and a separate range.
AVPixelFormat without_range(AVPixelFormat format) {
  switch (static_cast<int>(format)) {
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    case AV_PIX_FMT_YUVJ440P:
      return AV_PIX_FMT_YUV440P;
    default:
      return format;
  }
}

SwsContext* scaler(Scaler& kept, const AVFrame& frame, AVPixelFormat to) {
  const AVPixelFormat from = without_range(static_cast<AVPixelFormat>(frame.format));
  kept.reset(sws_getCachedContext(kept.release(), frame.width, frame.height, from, frame.width,
                                  frame.height, to, kExact, nullptr, nullptr, nullptr));
  if (kept == nullptr) return nullptr;
  constexpr int kOne = 1 << 16;  // unit of contrast and saturation
  // Fails for grey to grey, where there is nothing to set.
  sws_setColorspaceDetails(kept.get(), sws_getCoefficients(matrix_of(frame)),
                           is_full_range(frame) ? 1 : 0, sws_getCoefficients(SWS_CS_ITU601), 1, 0,
                           kOne, kOne);
  return kept.get();
}

}  // namespace

bool is_taken(int width, int height, std::int64_t most_pixels) {
  return width > 0 && height > 0 && width <= kMostSide && height <= kMostSide &&
         std::int64_t{width} * height <= most_pixels;
}

Expected<void> check_size(int width, int height, const std::string& where,
                          std::int64_t most_pixels) {
  if (is_taken(width, height, most_pixels)) return {};
  return Unexpected(error_of(
      IssueCode::VideoUnreadable,
      fmt::format("pictures of {} x {} pixels cannot be used (at most {} a side, {} megapixels)",
                  width, height, kMostSide, most_pixels / 1'000'000),
      where));
}

std::optional<GrayImage> Pictures::gray(const AVFrame& frame) {
  if (has_gray_plane(static_cast<AVPixelFormat>(frame.format))) {
    return GrayImage{frame.data[0], frame.width, frame.height, frame.linesize[0]};
  }
  SwsContext* const convert = scaler(to_gray_, frame, AV_PIX_FMT_GRAY8);
  if (convert == nullptr) return std::nullopt;
  gray_.resize(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  const std::array<std::uint8_t*, 4> planes{gray_.data()};
  const std::array<int, 4> strides{frame.width};
  sws_scale(convert, frame.data, frame.linesize, 0, frame.height, planes.data(), strides.data());
  return GrayImage{gray_.data(), frame.width, frame.height, frame.width};
}

ColorImage Pictures::color(const AVFrame& frame) {
  ColorImage image{frame.width, frame.height, {}};
  image.bgr.resize(3 * static_cast<std::size_t>(frame.width) *
                   static_cast<std::size_t>(frame.height));
  SwsContext* const convert = scaler(to_color_, frame, AV_PIX_FMT_BGR24);
  if (convert == nullptr) return image;
  const std::array<std::uint8_t*, 4> planes{image.bgr.data()};
  const std::array<int, 4> strides{3 * frame.width};
  sws_scale(convert, frame.data, frame.linesize, 0, frame.height, planes.data(), strides.data());
  return image;
}

void fill(AVFrame& frame, const ColorImage& image, Scaler& kept) {
  if (kept == nullptr) {
    // Two pixels share one colour sample; without the flag, the last pixel of an odd row is paired
    // with the first pixel of the next row.
    const int how = frame.width % 2 == 0 ? kExact : kExact | SWS_FULL_CHR_H_INP;
    kept.reset(sws_getContext(frame.width, frame.height, AV_PIX_FMT_BGR24, frame.width,
                              frame.height, without_range(static_cast<AVPixelFormat>(frame.format)),
                              how, nullptr, nullptr, nullptr));
    constexpr int kOne = 1 << 16;
    const int* const bt601 = sws_getCoefficients(SWS_CS_ITU601);
    sws_setColorspaceDetails(kept.get(), bt601, 1, bt601, 1, 0, kOne, kOne);
  }
  const std::array<const std::uint8_t*, 4> planes{image.bgr.data()};
  const std::array<int, 4> strides{3 * image.width};
  sws_scale(kept.get(), planes.data(), strides.data(), 0, image.height, frame.data, frame.linesize);
}

void fill(AVFrame& frame, const GrayImage& image) {
  for (int y = 0; y < image.height; ++y) {
    std::memcpy(frame.data[0] + std::ptrdiff_t{y} * frame.linesize[0],
                image.pixels + y * image.stride, static_cast<std::size_t>(image.width));
  }
  constexpr int kNoColor = 128;
  const int rows = (frame.height + 1) / 2;
  for (const int plane : {1, 2}) {
    std::memset(frame.data[plane], kNoColor,
                static_cast<std::size_t>(rows) * static_cast<std::size_t>(frame.linesize[plane]));
  }
}

}  // namespace swarmsmith::av
