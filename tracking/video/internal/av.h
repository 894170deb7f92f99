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

/// Larger pictures are refused: no camera makes them, but damaged files may claim them.
inline constexpr int kMostSide = 16384;
inline constexpr std::int64_t kMostPixels = 100'000'000;
/// The limit for codecs that keep up to 16 reference pictures: a little more than 8192 x 4320.
inline constexpr std::int64_t kMostBuiltOnPixels = 36'000'000;

/// The type of the bytes that a stream writes; constant since FFmpeg 7.
#if LIBAVFORMAT_VERSION_MAJOR >= 61
using WrittenBytes = const std::uint8_t*;
#else
using WrittenBytes = std::uint8_t*;
#endif

/// Whether the picture needs no other picture. FFmpeg 6.1 has a flag for this, older versions a
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

/// Keeps the library's messages from standard error, and limits the size of its allocations. Must
/// be called before any other function of the library; may be called repeatedly.
void set_up();

/// Returns the library's last message in this thread as one line, and clears it; empty if there is
/// none.
std::string take_message();

/// The meaning of a return code, with the last message: "Invalid data found (moov atom not found)".
std::string reason(int code);

}  // namespace swarmsmith::av
