#include "tracking/video/internal/video_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tracking/video/internal/decoder.h"
#include "tracking/video/internal/demuxer.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

class VideoFile final : public FrameSource {
 public:
  VideoFile(SourceInfo info, av::Demuxer demuxer, av::Codec decoder, av::PacketTable table)
      : info_(std::move(info)),
        demuxer_(std::move(demuxer)),
        decoder_(std::move(decoder)),
        table_(std::move(table)),
        is_intra_(av::is_intra_only(decoder_->codec_id)),
        is_placed_(table_.has_times || is_intra_ ||
                   (demuxer_.is_avi() && demuxer_.stream().codecpar->video_delay == 0)) {}

  const SourceInfo& info() const override { return info_; }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override { return pictures_.color(*picture_); }
  std::int64_t damaged_frames() const override { return frame_.number + 1 - shown_ + at_end_; }

  Expected<bool> next() override {
    while (true) {
      av_frame_unref(picture_.get());
      const int code = avcodec_receive_frame(decoder_.get(), picture_.get());
      if (code == AVERROR_EOF) return end();
      if (code == AVERROR(EAGAIN)) {
        feed();
      } else if (code < 0) {
        is_damaged_ = true;
      } else {
        const auto taken = take();
        if (!taken || *taken) return taken;
      }
    }
  }

 private:
  bool end() {
    const auto all = static_cast<std::int64_t>(table_.times.size());
    at_end_ = std::max<std::int64_t>(0, all - (frame_.number + 1));
    return false;
  }

  /// From here on the numbers of frames are unknown, so the rest counts as missing.
  bool lose_count() {
    avcodec_flush_buffers(decoder_.get());
    while (demuxer_.next() != nullptr) {
    }
    return false;
  }

  /// Gives the decoder the next packet, or the end of the stream.
  void feed() {
    const AVPacket* const packet = demuxer_.next();
    ++fed_;
    if (packet != nullptr && packet->size == 0) return;
    const bool cut = packet != nullptr && (packet->flags & AV_PKT_FLAG_CORRUPT) != 0;
    av::take_message();
    if (cut || avcodec_send_packet(decoder_.get(), packet) < 0) is_damaged_ = true;
    // Only this decoder reports a wrong checksum by a message and in no other way.
    is_marked_ = decoder_->codec_id == AV_CODEC_ID_FFV1 && !av::take_message().empty();
  }

  bool is_flagged() const {
    return is_marked_ || picture_->decode_error_flags != 0 ||
           (picture_->flags & AV_FRAME_FLAG_CORRUPT) != 0;
  }

  /// Takes the decoded picture as the frame; false if it is left out.
  Expected<bool> take() {
    if (is_flagged()) is_damaged_ = true;
    // A decoder that flags damaged pictures continues normally with the next one. Pictures that
    // depend on a damaged one may show a tag at an old place, so all pictures until the next key
    // frame are left out.
    const bool stands_alone = is_intra_ || av::is_key_frame(*picture_);
    if (is_flagged() || (is_damaged_ && !stands_alone)) return false;
    if (is_damaged_ && !is_placed_) return lose_count();
    is_damaged_ = false;
    if (picture_->width != info_.size.width || picture_->height != info_.size.height) {
      return unreadable(
          fmt::format("frame {} is {} x {} pixels, {} {} x {}", frame_.number + 1, picture_->width,
                      picture_->height, frame_.number < 0 ? "the file says" : "those before it",
                      info_.size.width, info_.size.height),
          info_.name);
    }
    if (!place()) return false;
    const auto gray = pictures_.gray(*picture_);
    if (!gray) return unreadable("its pixel format cannot be read", info_.name);
    frame_.gray = *gray;
    ++shown_;
    return true;
  }

  /// Finds the picture's number and time; false if it comes too late or is not in the table.
  bool place() {
    std::int64_t number = frame_.number + 1;
    if (is_intra_ && !table_.has_times && !demuxer_.is_avi()) {
      number = fed_ - 1;  // elementary stream: one picture per packet, without delay
    } else if (is_placed_) {
      const std::int64_t time =
          table_.has_times ? picture_->best_effort_timestamp : picture_->pkt_dts;
      const auto found = std::lower_bound(table_.times.begin(), table_.times.end(), time);
      if (found == table_.times.end() || *found != time) return false;
      number = found - table_.times.begin();
      if (number <= frame_.number) return false;
    }
    frame_.number = number;
    if (table_.has_times) {
      const AVStream& stream = demuxer_.stream();
      const std::int64_t zero = has_own_zero() ? table_.times.front() : 0;
      const std::int64_t time = table_.times[static_cast<std::size_t>(number)] - zero;
      frame_.time_s = static_cast<double>(time) * stream.time_base.num / stream.time_base.den;
    }
    return true;
  }

  /// The clock of a transport stream starts anywhere; players count from the first frame.
  bool has_own_zero() const {
    return std::string_view(demuxer_.format().iformat->name) == "mpegts";
  }

  SourceInfo info_;
  av::Demuxer demuxer_;
  av::Codec decoder_;
  av::PacketTable table_;
  bool is_intra_;
  bool is_placed_;  ///< pictures have a number: by their time, or in an .avi by their packet
  bool is_damaged_ = false;  ///< the decoder reported damage since the last complete picture
  bool is_marked_ = false;   ///< the next picture is damaged, although the decoder does not flag it
  std::int64_t fed_ = 0;     ///< number of packets
  av::FramePtr picture_{av_frame_alloc()};
  av::Pictures pictures_;
  Frame frame_{.number = -1, .time_s = {}, .gray = {}};
  std::int64_t shown_ = 0;
  std::int64_t at_end_ = 0;  ///< frames after the last one shown
};

SourceInfo info_of(const av::Demuxer& demuxer, const av::PacketTable& table,
                   const std::string& name) {
  const AVStream& stream = demuxer.stream();
  SourceInfo info;
  info.name = name;
  info.size = {stream.codecpar->width, stream.codecpar->height};
  if (stream.avg_frame_rate.num > 0 && stream.avg_frame_rate.den > 0) {
    info.frame_rate = av_q2d(stream.avg_frame_rate);
  }
  info.expected_frames = static_cast<std::int64_t>(table.times.size());
  info.has_times = table.has_times;
  info.has_count = table.has_count;
  info.is_truncated = table.is_truncated;
  const AVFieldOrder fields = stream.codecpar->field_order;
  if (fields != AV_FIELD_UNKNOWN && fields != AV_FIELD_PROGRESSIVE) {
    info.oddities.emplace_back(
        "it says that it is interlaced: each picture is two, taken one after the other, and what "
        "moves is torn in lines; film progressively, or separate them first (`ffmpeg -i IN -vf "
        "yadif=1 OUT`)");
  }
  if (const int others = demuxer.other_videos(); others > 0) {
    info.oddities.push_back(
        fmt::format("it has {} video tracks, and number {} is read ({} x {} pixels); another one "
                    "is made a file by `ffmpeg -i IN -map 0:v:NUMBER -c copy OUT`",
                    others + 1, demuxer.number_of_video(), info.size.width, info.size.height));
  }
  return info;
}

Expected<std::unique_ptr<FrameSource>> open_stream(av::ByteStream first, av::ByteStream second,
                                                   const std::string& name) {
  av::PacketTable table;
  {
    auto packets = av::Demuxer::open(std::move(first), name);
    if (!packets) return Unexpected(packets.error());
    auto read = av::packets_of(*packets, name);
    if (!read) return Unexpected(read.error());
    table = std::move(*read);
  }
  auto demuxer = av::Demuxer::open(std::move(second), name);
  if (!demuxer) return Unexpected(demuxer.error());
  const AVCodecParameters& about = *demuxer->stream().codecpar;
  const auto fits =
      av::check_size(about.width, about.height, name, av::most_pixels(about.codec_id));
  if (!fits) return Unexpected(fits.error());
  auto decoder = av::open_decoder(about, demuxer->stream().time_base, name);
  if (!decoder) return Unexpected(decoder.error());
  SourceInfo info = info_of(*demuxer, table, name);
  return std::make_unique<VideoFile>(std::move(info), std::move(*demuxer), std::move(*decoder),
                                     std::move(table));
}

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_video_file(const std::string& path) {
  av::set_up();
  auto first = av::ByteStream::reading(path);
  if (!first) return Unexpected(first.error());
  auto second = av::ByteStream::reading(path);
  if (!second) return Unexpected(second.error());
  return open_stream(std::move(*first), std::move(*second), path);
}

Expected<std::unique_ptr<FrameSource>> open_video_bytes(std::string_view bytes,
                                                        const std::string& name) {
  av::set_up();
  return open_stream(av::ByteStream::over(bytes), av::ByteStream::over(bytes), name);
}

}  // namespace swarmsmith
