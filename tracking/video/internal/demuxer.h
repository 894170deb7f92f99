#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/internal/byte_stream.h"

namespace swarmsmith::av {

/// Reads the video packets of a file, in the order in which they are stored.
class Demuxer {
 public:
  /// E_VIDEO_UNREADABLE if it is not a video of a known kind. Only formats and codecs that cameras
  /// and recorders write are tried, because the library has many others that are less well
  /// maintained.
  static Expected<Demuxer> open(ByteStream bytes, const std::string& name);

  /// Null at the end.
  AVPacket* next();
  /// Whether the file ended although its header announces more.
  bool broke_off() const { return broke_off_; }

  const AVFormatContext& format() const { return *format_; }
  const AVStream& stream() const { return *format_->streams[stream_]; }
  /// The number of video tracks that are not read, without cover pictures; and the number of the
  /// track that is read, among all video tracks.
  int other_videos() const;
  int number_of_video() const;
  /// Audio Video Interleave: has a constant rate and no times.
  bool is_avi() const { return std::string_view(format_->iformat->name) == "avi"; }

 private:
  struct Close {
    void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  };
  using Format = std::unique_ptr<AVFormatContext, Close>;
  Demuxer(ByteStream bytes, Format format, int stream);

  ByteStream bytes_;  // must outlive format_, which reads from it
  Format format_;
  PacketPtr packet_{av_packet_alloc()};
  int stream_ = -1;
  bool broke_off_ = false;
};

/// Information on the frames of a file, from its packets.
struct PacketTable {
  /// Times of the frames in display order, in the stream's time base; for an .avi their indices.
  std::vector<std::int64_t> times;
  bool has_times = false;     ///< each frame has its own time
  bool has_count = false;     ///< constant rate, and the number of frames agrees with the header
  bool is_truncated = false;  ///< it ends earlier than its header says
};

/// Reads all packets. Fails if there are none, or more than in a recording of several days.
Expected<PacketTable> packets_of(Demuxer& demuxer, const std::string& name);

}  // namespace swarmsmith::av
