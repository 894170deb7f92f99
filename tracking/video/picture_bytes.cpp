#include "tracking/video/picture_bytes.h"

#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/video_choice.h"

namespace swarmsmith {
namespace {

/// Encodes one picture and flushes the encoder.
Expected<std::string> bytes_of(const ColorImage& image, const av::CodecChoice& choice,
                               int quality) {
  av::set_up();
  const auto failed = [&](int code) {
    return unexpected(
        ErrorKind::Unavailable,
        "a picture cannot be encoded as " + std::string(choice.name) + ": " + av::reason(code));
  };
  const AVCodec* const encoder = avcodec_find_encoder_by_name(choice.encoder);
  if (encoder == nullptr) return failed(AVERROR_ENCODER_NOT_FOUND);
  const av::Codec codec = av::make_encoder(*encoder, {.codec = &choice},
                                           {image.width, image.height}, {.quality = quality});
  codec->time_base = {1, 1};
  int code = avcodec_open2(codec.get(), encoder, nullptr);
  const av::FramePtr frame(av_frame_alloc());
  frame->format = choice.format;
  frame->width = image.width;
  frame->height = image.height;
  frame->color_range = AVCOL_RANGE_JPEG;
  if (code >= 0) code = av_frame_get_buffer(frame.get(), 0);
  if (code < 0) return failed(code);
  av::Scaler scaler;
  av::fill(*frame, image, scaler);
  frame->quality = codec->global_quality;
  const av::PacketPtr packet(av_packet_alloc());
  code = avcodec_send_frame(codec.get(), frame.get());
  if (code >= 0) code = avcodec_send_frame(codec.get(), nullptr);
  if (code >= 0) code = avcodec_receive_packet(codec.get(), packet.get());
  if (code < 0) return failed(code);
  return std::string(reinterpret_cast<const char*>(packet->data),
                     static_cast<std::size_t>(packet->size));
}

}  // namespace

Expected<std::string> png_of(const ColorImage& image) {
  return bytes_of(image, {"png", "png", AV_PIX_FMT_RGB24}, 100);
}

Expected<std::string> jpeg_of(const ColorImage& image, int quality) {
  return bytes_of(image, {"mjpeg", "mjpeg", AV_PIX_FMT_YUVJ420P}, quality);
}

}  // namespace swarmsmith
