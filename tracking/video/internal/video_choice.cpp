#include "tracking/video/internal/video_choice.h"

extern "C" {
#include <libavutil/opt.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/picture.h"

namespace swarmsmith::av {
namespace {

constexpr Container kContainers[] = {
    {".mkv", "matroska", {1, 1000}}, {".mp4", "mp4", {1, 1'000'000}}, {".avi", "avi", {0, 1}}};

constexpr CodecChoice kCodecs[] = {{"h264", "libx264", AV_PIX_FMT_YUV420P},
                                   {"mjpeg", "mjpeg", AV_PIX_FMT_YUVJ420P},
                                   {"ffv1", "ffv1", AV_PIX_FMT_YUV420P}};

Unexpected config_error(const std::string& text, const std::string& path) {
  return Unexpected(error_of(IssueCode::Config, text, path));
}

}  // namespace

Expected<VideoChoice> video_choice(const std::string& path, ImageSize size,
                                   const VideoOptions& options) {
  VideoChoice choice;
  for (const Container& container : kContainers) {
    if (path.ends_with(container.ending)) choice.container = &container;
  }
  if (choice.container == nullptr) {
    return config_error("a video's name must end in .mkv, .mp4 or .avi", path);
  }
  for (const CodecChoice& codec : kCodecs) {
    if (options.codec == codec.name) choice.codec = &codec;
  }
  if (choice.codec == nullptr) {
    return config_error("codec `" + options.codec + "` is not h264, mjpeg or ffv1", path);
  }
  if (!is_taken(size.width, size.height)) {
    return config_error(fmt::format("a video of {} x {} pixels cannot be made (at most {} a side, "
                                    "100 megapixels)",
                                    size.width, size.height, kMostSide),
                        path);
  }
  if (options.codec == "h264" && (size.width % 2 != 0 || size.height % 2 != 0)) {
    return config_error(fmt::format("h264 needs an even width and height, not {} x {}; use mjpeg "
                                    "or ffv1, or cut a row or column",
                                    size.width, size.height),
                        path);
  }
  constexpr double kMostRate = 10'000;
  if (!(options.frame_rate >= 0.01 && options.frame_rate <= kMostRate)) {
    return config_error("a frame rate must be between 0.01 and 10000 a second", path);
  }
  if (options.quality < 1 || options.quality > 100) {
    return config_error("the quality must be between 1 and 100", path);
  }
  if (options.live && choice.container->ending != ".mkv") {
    return config_error("a recording that survives being cut off must be a .mkv", path);
  }
  if (options.codec == "ffv1" && choice.container->ending == ".mp4") {
    return config_error("ffv1 goes into .mkv or .avi, not .mp4", path);
  }
  return choice;
}

Codec make_encoder(const AVCodec& encoder, const VideoChoice& choice, ImageSize size,
                   const VideoOptions& options) {
  Codec made(avcodec_alloc_context3(&encoder));
  AVCodecContext& e = *made;
  e.width = size.width;
  e.height = size.height;
  e.pix_fmt = choice.codec->format;
  e.framerate = av_d2q(options.frame_rate, 1'000'000);
  // Full range of 8 bits, and the same matrix as OpenCV's conversion to grey.
  e.color_range = AVCOL_RANGE_JPEG;
  e.colorspace = AVCOL_SPC_SMPTE170M;
  // Always write the same bytes.
  e.thread_count = 1;
  e.flags |= AV_CODEC_FLAG_BITEXACT;
  const double worse = (100 - options.quality) / 100.0;
  if (choice.codec->name == "h264") {
    constexpr double kWorstFactor = 51;
    // One key frame per second, so that damage affects at most one second.
    e.gop_size = std::max(1, static_cast<int>(std::lround(options.frame_rate)));
    e.max_b_frames = options.live ? 0 : options.b_frames;
    // A fixed quantiser, and fixed positions of key frames and B frames: the heuristics of x264 for
    // better ones read slightly beyond their own buffers, so their result may vary.
    const double factor = std::max(1.0, kWorstFactor * worse);
    av_opt_set_int(e.priv_data, "qp", std::lround(factor), 0);
    av_opt_set_int(e.priv_data, "sc_threshold", 0, 0);
    av_opt_set_int(e.priv_data, "b_strategy", 0, 0);
    av_opt_set_int(e.priv_data, "weightp", 0, 0);
    av_opt_set(e.priv_data, "preset", options.live ? "superfast" : "veryfast", 0);
    if (options.live) av_opt_set(e.priv_data, "tune", "zerolatency", 0);
  } else if (choice.codec->name == "mjpeg") {
    constexpr double kWorstScale = 30;
    e.flags |= AV_CODEC_FLAG_QSCALE;
    e.global_quality = static_cast<int>(FF_QP2LAMBDA * (1 + kWorstScale * worse * worse));
  } else if (choice.codec->name == "ffv1") {
    e.gop_size = 1;
    av_opt_set_int(&e, "level", 3, 0);
    av_opt_set_int(e.priv_data, "slicecrc", 1, 0);
  }
  return made;
}

}  // namespace swarmsmith::av
