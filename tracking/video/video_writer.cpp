#include "tracking/video/video_writer.h"

extern "C" {
#include <libavutil/dict.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/output_file.h"
#include "tracking/video/internal/byte_stream.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/video_choice.h"

namespace swarmsmith {
namespace {

struct FreeMuxer {
  void operator()(AVFormatContext* muxer) const { avformat_free_context(muxer); }
};

}  // namespace

struct VideoWriter::State {
  std::string path;
  std::string open_path;  ///< name of the file until it is finished
  VideoOptions options;
  ImageSize size;
  AVRational grain{1, 1000};
  bool counts = false;  ///< the container has a rate, but no times
  av::Codec encoder;
  std::unique_ptr<AVFormatContext, FreeMuxer> muxer;
  std::optional<av::ByteStream> file;
  av::FramePtr frame{av_frame_alloc()};
  av::PacketPtr packet{av_packet_alloc()};
  av::Scaler scaler;
  std::int64_t frames = 0;
  std::int64_t last_pts = -1;
  std::int64_t flushed_pts = 0;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (file && !options.live) {
      file.reset();
      std::remove(open_path.c_str());
    }
  }

  Expected<void> open(const av::VideoChoice& choice);
  Expected<void> open_encoder(const av::VideoChoice& choice);
  Expected<void> open_muxer(const av::Container& container);
  Expected<std::int64_t> pts_of(double time_s) const;
  /// Writes the encoder's queue to the file.
  Expected<void> store();
  Expected<void> encode(std::int64_t pts);
  Expected<void> failed(int code, std::string_view what) const;
  Expected<void> check_disk() const;
};

Expected<void> VideoWriter::State::failed(int code, std::string_view what) const {
  if (auto disk = check_disk(); !disk) return disk;
  return unexpected(ErrorKind::Unavailable, std::string(what) + ": " + av::reason(code), path);
}

Expected<void> VideoWriter::State::check_disk() const {
  const int error = file->failed_with();
  if (error == 0) return {};
  return unexpected(ErrorKind::Unavailable,
                    "cannot be written: " + std::generic_category().message(error), path);
}

Expected<void> VideoWriter::State::open_encoder(const av::VideoChoice& choice) {
  const AVCodec* const found = avcodec_find_encoder_by_name(choice.codec->encoder);
  if (found == nullptr) {
    return unexpected(ErrorKind::Unavailable,
                      fmt::format("libavcodec was built without {}", choice.codec->encoder), path);
  }
  encoder = av::make_encoder(*found, choice, size, options);
  encoder->time_base = grain;
  if ((muxer->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
    encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  }
  const int code = avcodec_open2(encoder.get(), found, nullptr);
  if (code < 0) return failed(code, "the encoder cannot be opened");
  return {};
}

Expected<void> VideoWriter::State::open_muxer(const av::Container& container) {
  AVFormatContext* made = nullptr;
  const int code = avformat_alloc_output_context2(&made, nullptr, container.muxer, nullptr);
  if (code < 0) return failed(code, "the container cannot be made");
  muxer.reset(made);
  made->pb = file->io();
  made->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_CUSTOM_IO;
  // Keep the times: the encoder's delay must not shift them.
  made->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
  return {};
}

Expected<void> VideoWriter::State::open(const av::VideoChoice& choice) {
  counts = choice.container->grain.num == 0;
  grain = counts ? av_inv_q(av_d2q(options.frame_rate, 1'000'000)) : choice.container->grain;
  open_path = options.live ? path : path + ".part";
  auto stream_file = av::ByteStream::writing(open_path);
  if (!stream_file) return Unexpected(stream_file.error());
  file = std::move(*stream_file);
  if (auto opened = open_muxer(*choice.container); !opened) return opened;
  if (auto opened = open_encoder(choice); !opened) return opened;
  AVStream* const stream = avformat_new_stream(muxer.get(), nullptr);
  avcodec_parameters_from_context(stream->codecpar, encoder.get());
  stream->time_base = grain;
  stream->avg_frame_rate = encoder->framerate;
  AVDictionary* words = nullptr;
  if (choice.container->ending == ".mp4") {
    av_dict_set_int(&words, "video_track_timescale", grain.den, 0);
    // The unit of edit lists; the default of 1 ms would round the start.
    av_dict_set_int(&words, "movie_timescale", grain.den, 0);
  }
  const int code = avformat_write_header(muxer.get(), &words);
  av_dict_free(&words);
  if (code < 0) return failed(code, "the header cannot be written");
  frame->format = encoder->pix_fmt;
  frame->width = size.width;
  frame->height = size.height;
  frame->color_range = AVCOL_RANGE_JPEG;
  frame->colorspace = AVCOL_SPC_SMPTE170M;
  const int buffers = av_frame_get_buffer(frame.get(), 0);
  if (buffers < 0) return failed(buffers, "no memory for a picture");
  return {};
}

Expected<std::int64_t> VideoWriter::State::pts_of(double time_s) const {
  constexpr double kMostSeconds = 1e7;  // four months; also keeps the counts in range
  if (!(time_s >= 0 && time_s <= kMostSeconds)) {
    return bad_input(fmt::format("frame {}: time {} s is not between 0 and 1e7 s", frames, time_s),
                     path);
  }
  const double exact = time_s / av_q2d(grain);
  const std::int64_t pts = std::llround(exact);
  if (counts) {
    constexpr double kMostUneven = 0.05;  // share of a frame
    if (std::abs(exact - static_cast<double>(frames)) > kMostUneven) {
      return bad_input(
          fmt::format("frame {}: an .avi has no times, only {} frames a second from 0 s on, so {} "
                      "s cannot be kept; write a .mkv or .mp4",
                      frames, options.frame_rate, time_s),
          path);
    }
  } else if (pts <= last_pts) {
    return bad_input(fmt::format("frame {}: time {} s is not later than the frame before, in steps "
                                 "of {} s",
                                 frames, time_s, av_q2d(grain)),
                     path);
  }
  return counts ? frames : pts;
}

Expected<void> VideoWriter::State::store() {
  while (true) {
    const int code = avcodec_receive_packet(encoder.get(), packet.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return check_disk();
    if (code < 0) return failed(code, "a frame cannot be encoded");
    AVStream* const stream = muxer->streams[0];
    av_packet_rescale_ts(packet.get(), grain, stream->time_base);
    packet->stream_index = 0;
    const std::int64_t pts = packet->pts;
    // The duration of the last frame is unknown, and players drop a frame without a duration.
    packet->duration = std::max<std::int64_t>(
        1, std::llround(1 / (options.frame_rate * av_q2d(stream->time_base))));
    const int written = av_write_frame(muxer.get(), packet.get());
    av_packet_unref(packet.get());
    if (written < 0) return failed(written, "a frame cannot be written");
    // Matroska collects frames in clusters in memory; at most half a second of frames may be lost.
    const std::int64_t half_second = stream->time_base.den / (2 * stream->time_base.num);
    if (options.live && pts - flushed_pts >= half_second) {
      flushed_pts = pts;
      av_write_frame(muxer.get(), nullptr);
      avio_flush(file->io());
    }
  }
}

Expected<void> VideoWriter::State::encode(std::int64_t pts) {
  frame->pts = pts;
  const int code = avcodec_send_frame(encoder.get(), frame.get());
  if (code < 0) return failed(code, "a frame cannot be encoded");
  last_pts = pts;
  ++frames;
  return store();
}

VideoWriter::VideoWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

Expected<VideoWriter> VideoWriter::open(const std::string& path, ImageSize size,
                                        const VideoOptions& options) {
  av::set_up();
  const auto choice = av::video_choice(path, size, options);
  if (!choice) return Unexpected(choice.error());
  auto place = output_place(path, FileKind::Video);
  if (!place) return Unexpected(place.error());
  auto state = std::make_unique<State>();
  state->path = place->string();
  state->options = options;
  state->size = size;
  if (auto opened = state->open(*choice); !opened) return Unexpected(opened.error());
  return VideoWriter(std::move(state));
}

namespace {

Expected<void> same_size(int width, int height, ImageSize size, const std::string& path) {
  if (width == size.width && height == size.height) return {};
  return bad_input(fmt::format("a picture of {} x {} in a video of {} x {}", width, height,
                               size.width, size.height),
                   path);
}

}  // namespace

Expected<void> VideoWriter::write(const GrayImage& image, double time_s) {
  State& s = *state_;
  if (auto fits = same_size(image.width, image.height, s.size, s.path); !fits) return fits;
  const auto pts = s.pts_of(time_s);
  if (!pts) return Unexpected(pts.error());
  if (av_frame_make_writable(s.frame.get()) < 0) return s.failed(AVERROR(ENOMEM), "no memory");
  av::fill(*s.frame, image);
  return s.encode(*pts);
}

Expected<void> VideoWriter::write(const ColorImage& image, double time_s) {
  State& s = *state_;
  if (auto fits = same_size(image.width, image.height, s.size, s.path); !fits) return fits;
  const auto pts = s.pts_of(time_s);
  if (!pts) return Unexpected(pts.error());
  if (av_frame_make_writable(s.frame.get()) < 0) return s.failed(AVERROR(ENOMEM), "no memory");
  av::fill(*s.frame, image, s.scaler);
  return s.encode(*pts);
}

Expected<void> VideoWriter::finish() {
  State& s = *state_;
  avcodec_send_frame(s.encoder.get(), nullptr);
  if (auto stored = s.store(); !stored) return stored;
  const int code = av_write_trailer(s.muxer.get());
  if (code < 0) return s.failed(code, "the end cannot be written");
  const int closed = s.file->close_after_writing();
  if (closed != 0) {
    return unexpected(ErrorKind::Unavailable,
                      "cannot be written: " + std::generic_category().message(closed), s.path);
  }
  if (s.options.live) return {};
  std::error_code renamed;
  std::filesystem::rename(s.open_path, s.path, renamed);
  if (renamed) return unexpected(ErrorKind::Unavailable, renamed.message(), s.path);
  s.file.reset();
  return {};
}

}  // namespace swarmsmith
