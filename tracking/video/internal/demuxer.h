#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/internal/byte_stream.h"

namespace swarmsmith::av {

/// The video packets of a file, in the order in which they are stored.
class Demuxer {
 public:
  /// E_VIDEO_UNREADABLE for what is not a video of a known kind. Only kinds and codecs that cameras
  /// and recorders write are tried; the library's others are many, and less looked after.
  static Expected<Demuxer> open(ByteStream bytes, const std::string& name);

  /// Null at the end.
  AVPacket* next();
  /// Whether the end came where the file says that more follows.
  bool broke_off() const { return broke_off_; }

  const AVFormatContext& format() const { return *format_; }
  const AVStream& stream() const { return *format_->streams[stream_]; }
  /// Video tracks that are not read, pictures of a cover left aside; and the number of the one that
  /// is, among all of them.
  int other_videos() const;
  int number_of_video() const;
  /// Audio Video Interleave: constant rate, no times.
  bool is_avi() const { return std::string_view(format_->iformat->name) == "avi"; }

 private:
  struct Close {
    void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  };
  using Format = std::unique_ptr<AVFormatContext, Close>;
  Demuxer(ByteStream bytes, Format format, int stream);

  ByteStream bytes_;  // outlives format_, which reads from it
  Format format_;
  PacketPtr packet_{av_packet_alloc()};
  int stream_ = -1;
  bool broke_off_ = false;
};

/// What a file's packets say about its frames.
struct PacketTable {
  /// Of the frames in the order of display, in the stream's time base; for an .avi their places.
  std::vector<std::int64_t> times;
  bool has_times = false;     ///< each frame has one of its own
  bool has_count = false;     ///< a constant rate, and as many frames as the header says
  bool is_truncated = false;  ///< it ends before its header says
};

/// Reads all packets. Fails when there are none, or more than a recording of days could have.
Expected<PacketTable> packets_of(Demuxer& demuxer, const std::string& name);

}  // namespace swarmsmith::av
