#include "tracking/video/internal/decoder.h"

#include <fmt/format.h>

#include <string_view>

#include "tracking/rig/issue.h"

namespace swarmsmith::av {

const char* const kTakenDecoders =
    "h264,hevc,mjpeg,mpeg4,mpeg2video,mpeg1video,vp8,vp9,libdav1d,ffv1,rawvideo,prores,huffyuv,"
    "ffvhuff,png,dvvideo,bmp,tiff,pgm,ppm";

namespace {

bool is_taken(std::string_view decoder) {
  std::string_view rest = kTakenDecoders;
  while (true) {
    const std::size_t end = rest.find(',');
    if (rest.substr(0, end) == decoder) return true;
    if (end == std::string_view::npos) return false;
    rest.remove_prefix(end + 1);
  }
}

/// Whether any error discards the whole picture. Not for H.264 and H.265, where the library treats
/// odd but harmless side data of cameras as an error, and whose decoders flag damaged pictures; and
/// not for TIFF, where an unknown tag is an error.
bool refuses_whole_pictures(AVCodecID codec) {
  return codec != AV_CODEC_ID_H264 && codec != AV_CODEC_ID_HEVC && codec != AV_CODEC_ID_TIFF;
}

}  // namespace

Expected<Codec> open_decoder(const AVCodecParameters& about, AVRational time_base,
                             const std::string& name) {
  const AVCodec* const found = avcodec_find_decoder(about.codec_id);
  if (found == nullptr || !is_taken(found->name)) {
    return Unexpected(
        error_of(IssueCode::VideoUnreadable,
                 fmt::format("its codec `{}` is not supported; h264, hevc, mjpeg, vp9, "
                             "av1, ffv1 and some others are",
                             avcodec_get_name(about.codec_id)),
                 name));
  }
  Codec codec(avcodec_alloc_context3(found));
  int code = avcodec_parameters_to_context(codec.get(), &about);
  codec->thread_count = 1;
  // Without this flag, the left crop of a film is rounded to an alignment that is fast to read.
  codec->flags |= AV_CODEC_FLAG_UNALIGNED;
  codec->pkt_timebase = time_base;
  codec->max_pixels = most_pixels(about.codec_id);
  codec->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER;
  if (refuses_whole_pictures(about.codec_id)) codec->err_recognition |= AV_EF_EXPLODE;
  if (code >= 0) code = avcodec_open2(codec.get(), found, nullptr);
  if (code < 0) {
    return Unexpected(
        error_of(IssueCode::VideoUnreadable,
                 fmt::format("the decoder of {} refuses it: {}", found->name, reason(code)), name));
  }
  return codec;
}

std::int64_t most_pixels(AVCodecID codec) {
  return is_intra_only(codec) || codec == AV_CODEC_ID_FFV1 ? kMostPixels : kMostBuiltOnPixels;
}

bool is_intra_only(AVCodecID codec) {
  const AVCodecDescriptor* const about = avcodec_descriptor_get(codec);
  // FFV1 pictures may depend on previous ones, although the library lists FFV1 as intra-only.
  return about != nullptr && (about->props & AV_CODEC_PROP_INTRA_ONLY) != 0 &&
         codec != AV_CODEC_ID_FFV1;
}

}  // namespace swarmsmith::av
