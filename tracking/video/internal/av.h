#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/frame.h>
#include <libswscale/swscale.h>
}

#include <cstdint>
#include <memory>
#include <string>

namespace swarmsmith::av {

/// Pictures beyond these are refused: no camera makes them, damaged files ask for them.
inline constexpr int kMostSide = 16384;
inline constexpr std::int64_t kMostPixels = 100'000'000;
/// Of codecs that keep up to 16 pictures to build others on: 8192 x 4320 and some more.
inline constexpr std::int64_t kMostBuiltOnPixels = 36'000'000;

/// What a stream gets to write; FFmpeg 7 made it constant.
#if LIBAVFORMAT_VERSION_MAJOR >= 61
using WrittenBytes = const std::uint8_t*;
#else
using WrittenBytes = std::uint8_t*;
#endif

/// Whether the picture is built on no other. FFmpeg 6.1 has a flag where older versions have a
/// member.
inline bool is_key_frame(const AVFrame& picture) {
#ifdef AV_FRAME_FLAG_KEY
  return (picture.flags & AV_FRAME_FLAG_KEY) != 0;
#else
  return picture.key_frame != 0;
#endif
}

struct FreeCodec {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
using Codec = std::unique_ptr<AVCodecContext, FreeCodec>;
using FramePtr = std::unique_ptr<AVFrame, FreeFrame>;
using PacketPtr = std::unique_ptr<AVPacket, FreePacket>;
using Scaler = std::unique_ptr<SwsContext, FreeScaler>;

/// Keeps the library's messages from the error stream, and bounds what it may allocate at a time.
/// To be called before anything else of it; more than once does no harm.
void set_up();

/// The last complaint of the library in this thread, on one line, and forgets it; empty: none.
std::string take_message();

/// What a return code means, with the last complaint: "Invalid data found (moov atom not found)".
std::string reason(int code);

}  // namespace swarmsmith::av
