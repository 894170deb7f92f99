#include "tracking/video/internal/still_picture.h"

#include <array>
#include <memory>
#include <string_view>

#include "tracking/video/internal/decoder.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith::av {
namespace {

/// Uses the first bytes, because file names may be wrong.
AVCodecID codec_of(std::string_view bytes) {
  struct Mark {
    std::string_view begin;
    AVCodecID codec;
  };
  using namespace std::string_view_literals;
  constexpr std::array<Mark, 7> kMarks = {{{"\x89PNG", AV_CODEC_ID_PNG},
                                           {"\xff\xd8", AV_CODEC_ID_MJPEG},
                                           {"BM", AV_CODEC_ID_BMP},
                                           {"II*\0"sv, AV_CODEC_ID_TIFF},
                                           {"MM\0*"sv, AV_CODEC_ID_TIFF},
                                           {"P5", AV_CODEC_ID_PGM},
                                           {"P6", AV_CODEC_ID_PPM}}};
  for (const Mark& mark : kMarks) {
    if (bytes.starts_with(mark.begin)) return mark.codec;
  }
  return AV_CODEC_ID_NONE;
}

}  // namespace

Expected<FramePtr> decode_still(const AVPacket& bytes, const std::string& name) {
  take_message();
  const AVCodecID codec =
      codec_of({reinterpret_cast<const char*>(bytes.data), static_cast<std::size_t>(bytes.size)});
  if (codec == AV_CODEC_ID_NONE)
    return unreadable("is not a PNG, JPEG, BMP, TIFF, PGM or PPM", name);
  std::unique_ptr<AVCodecParameters, void (*)(AVCodecParameters*)> about(
      avcodec_parameters_alloc(), [](AVCodecParameters* p) { avcodec_parameters_free(&p); });
  about->codec_type = AVMEDIA_TYPE_VIDEO;
  about->codec_id = codec;
  auto decoder = open_decoder(*about, {1, 1}, name);
  if (!decoder) return Unexpected(decoder.error());
  FramePtr picture(av_frame_alloc());
  int code = avcodec_send_packet(decoder->get(), &bytes);
  if (code >= 0) avcodec_send_packet(decoder->get(), nullptr);
  if (code >= 0) code = avcodec_receive_frame(decoder->get(), picture.get());
  if (code < 0) return unreadable("cannot be decoded: " + reason(code), name);
  if (picture->decode_error_flags != 0 || (picture->flags & AV_FRAME_FLAG_CORRUPT) != 0) {
    return unreadable("is damaged: " + take_message(), name);
  }
  if (auto fits = check_size(picture->width, picture->height, name); !fits) {
    return Unexpected(fits.error());
  }
  return picture;
}

}  // namespace swarmsmith::av
