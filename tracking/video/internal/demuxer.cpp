#include "tracking/video/internal/demuxer.h"

extern "C" {
#include <libavutil/dict.h>
#include <libavutil/mem.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "tracking/video/internal/decoder.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith::av {
namespace {

constexpr const char* kContainers = "matroska,mov,avi,mpegts,mjpeg";
/// An .avi gives its length in its first bytes.
bool is_cut_avi(const ByteStream& bytes) {
  std::array<unsigned char, 12> head{};
  const int count = avio_read(bytes.io(), head.data(), static_cast<int>(head.size()));
  avio_seek(bytes.io(), 0, SEEK_SET);
  if (count < static_cast<int>(head.size()) ||
      std::string_view(reinterpret_cast<const char*>(head.data()), 4) != "RIFF") {
    return false;
  }
  constexpr std::int64_t kFirstBytes = 8;
  std::int64_t length = 0;
  for (int i = 7; i >= 4; --i)
    length = 256 * length + head[static_cast<std::size_t>(i)];
  return bytes.size() < length + kFirstBytes;
}

/// Lets the library find the streams; it may decode a little for this.
int find_streams(AVFormatContext* format) {
  std::vector<AVDictionary*> options(format->nb_streams, nullptr);
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::int64_t most = most_pixels(format->streams[i]->codecpar->codec_id);
    av_dict_set_int(&options[i], "max_pixels", most, 0);
    av_dict_set_int(&options[i], "threads", 1, 0);
  }
  const int code = avformat_find_stream_info(format, options.data());
  for (AVDictionary*& words : options)
    av_dict_free(&words);
  return code;
}

/// In VP8, frames that are decoded but never shown have their own packets.
bool is_shown(const AVStream& stream, const AVPacket& packet) {
  if ((packet.flags & AV_PKT_FLAG_DISCARD) != 0) return false;
  constexpr int kShowFrame = 0x10;  // RFC 6386, section 9.1
  return stream.codecpar->codec_id != AV_CODEC_ID_VP8 || packet.size == 0 ||
         (packet.data[0] & kShowFrame) != 0;
}

/// Whether the header's duration exceeds the time of the last frame by more than a second.
bool ends_early(const Demuxer& demuxer, const PacketTable& table) {
  const AVFormatContext& format = demuxer.format();
  if (format.duration <= 0 || format.duration_estimation_method != AVFMT_DURATION_FROM_STREAM ||
      !table.has_times) {
    return false;
  }
  const double unit = av_q2d(demuxer.stream().time_base);
  const double start = format.start_time == AV_NOPTS_VALUE
                           ? 0
                           : static_cast<double>(format.start_time) / AV_TIME_BASE;
  const double end = static_cast<double>(format.duration) / AV_TIME_BASE + std::min(start, 0.0);
  constexpr double kSlack_s = 1;
  return static_cast<double>(table.times.back()) * unit + kSlack_s < end;
}

}  // namespace

Demuxer::Demuxer(ByteStream bytes, Format format, int stream)
    : bytes_(std::move(bytes)), format_(std::move(format)), stream_(stream) {
  for (unsigned i = 0; i < format_->nb_streams; ++i) {
    if (static_cast<int>(i) != stream) format_->streams[i]->discard = AVDISCARD_ALL;
  }
}

Expected<Demuxer> Demuxer::open(ByteStream bytes, const std::string& name) {
  take_message();
  if (bytes.size() == 0) return unreadable("the file is empty", name);
  const bool cut = is_cut_avi(bytes);
  AVFormatContext* opened = avformat_alloc_context();
  opened->pb = bytes.io();
  opened->format_whitelist = av_strdup(kContainers);
  opened->codec_whitelist = av_strdup(kTakenDecoders);
  constexpr int kMostStreams = 64;
  opened->max_streams = kMostStreams;
  // If this fails, the library frees the context.
  const int code = avformat_open_input(&opened, nullptr, nullptr, nullptr);
  if (code < 0) {
    const std::string words = reason(code);
    // In .mp4 and .mov files the index is written last, when the recording ends.
    if (words.find("moov atom not found") != std::string::npos) {
      return unreadable(
          "its index is missing (moov): the recording was not ended properly, or the file is "
          "incomplete. Copy it again from the camera, which may repair it when it is switched on; "
          "record .mkv, which can be read without its end",
          name);
    }
    return unreadable("is not a readable video: " + words + "; .mp4, .mkv, .avi and .ts are", name);
  }
  Format format(opened);
  const int found = find_streams(format.get());
  if (found < 0) return unreadable("its streams cannot be read: " + reason(found), name);
  const int stream = av_find_best_stream(format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream < 0) return unreadable("it has no video, only other streams", name);
  take_message();  // discard messages from the search for streams
  Demuxer demuxer(std::move(bytes), std::move(format), stream);
  demuxer.broke_off_ = cut;
  return demuxer;
}

namespace {

bool is_film(const AVStream& stream) {
  return stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO &&
         (stream.disposition & AV_DISPOSITION_ATTACHED_PIC) == 0;
}

}  // namespace

int Demuxer::other_videos() const {
  int count = 0;
  for (unsigned i = 0; i < format_->nb_streams; ++i) {
    if (static_cast<int>(i) != stream_ && is_film(*format_->streams[i])) ++count;
  }
  return count;
}

int Demuxer::number_of_video() const {
  int number = 0;
  for (int i = 0; i < stream_; ++i) {
    if (is_film(*format_->streams[i])) ++number;
  }
  return number;
}

AVPacket* Demuxer::next() {
  constexpr int kMostErrors = 1000;  // consecutive errors
  for (int errors = 0; errors < kMostErrors;) {
    av_packet_unref(packet_.get());
    const int code = av_read_frame(format_.get(), packet_.get());
    if (code == AVERROR_EOF) return nullptr;
    if (code >= 0 && packet_->stream_index == stream_) return packet_.get();
    if (code < 0) ++errors;
    if (code < 0) broke_off_ = true;
  }
  return nullptr;
}

Expected<PacketTable> packets_of(Demuxer& demuxer, const std::string& name) {
  constexpr std::size_t kMostFrames = 4'000'000;  // 37 hours at 30 frames/s
  PacketTable table;
  bool all_timed = true;
  while (const AVPacket* const packet = demuxer.next()) {
    if (!is_shown(demuxer.stream(), *packet)) continue;
    if (packet->size == 0 && !demuxer.is_avi()) continue;
    if (table.times.size() == kMostFrames) {
      return unreadable(fmt::format("more than {} frames", kMostFrames), name);
    }
    const std::int64_t time = demuxer.is_avi() ? packet->dts : packet->pts;
    all_timed = all_timed && time != AV_NOPTS_VALUE;
    table.times.push_back(time);
  }
  if (table.times.empty()) {
    const std::string words = take_message();
    return unreadable("it has no frame" + (words.empty() ? "" : ": " + words), name);
  }
  std::sort(table.times.begin(), table.times.end());
  if (demuxer.is_avi() && table.times.front() >= 0 &&
      table.times.back() < static_cast<std::int64_t>(kMostFrames)) {
    // If the recorder dropped a frame, an .avi has an empty chunk for it, which the library skips
    // but counts.
    const auto places = static_cast<std::size_t>(table.times.back()) + 1;
    table.times.resize(places);
    std::iota(table.times.begin(), table.times.end(), std::int64_t{0});
  }
  const bool distinct =
      std::adjacent_find(table.times.begin(), table.times.end()) == table.times.end();
  // Elementary streams have no times; the library invents some.
  const bool is_bare = std::string_view(demuxer.format().iformat->name) == "mjpeg";
  table.has_times = all_timed && distinct && !demuxer.is_avi() && !is_bare;
  const auto frames = static_cast<std::int64_t>(table.times.size());
  const std::int64_t declared = demuxer.stream().nb_frames;
  table.is_truncated = (demuxer.broke_off() && declared > frames) || ends_early(demuxer, table);
  table.has_count = demuxer.is_avi() && (declared == frames || table.is_truncated);
  return table;
}

}  // namespace swarmsmith::av
