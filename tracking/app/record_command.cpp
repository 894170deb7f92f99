#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>

#include "tracking/app/commands.h"
#include "tracking/app/stop_signal.h"
#include "tracking/rig/issue.h"
#include "tracking/video/frame_clock.h"
#include "tracking/video/frame_source.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Words {
  std::string source;
  std::string file;
  std::string seconds;
  std::string rate;
  std::string codec = "h264";
  std::optional<std::int64_t> quality;
  bool realtime = false;
};

/// A positive number of an option, or nothing when it is not there.
Expected<std::optional<double>> positive(const std::string& text, const char* option) {
  if (text.empty()) return std::optional<double>();
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr double kMost = 1e7;
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() ||
      !(value > 0 && value <= kMost)) {
    return bad_input(fmt::format("`{}` is no positive number", text), option);
  }
  return std::optional<double>(value);
}

/// The frame times beside the video. They get their name only when the video is whole: after a
/// crash the rows and the frames that reached the disk need not agree, and the video has times of
/// its own.
class Sidecar {
 public:
  Sidecar(const std::string& video, bool has_clock)
      : file_(video.substr(0, video.rfind('.')) + ".times.csv"), has_clock_(has_clock) {
    out_.open(file_ + ".part", std::ios::binary | std::ios::trunc);
    out_ << (has_clock ? "frame,time_s,clock_s\n" : "frame,time_s\n") << std::flush;
  }

  const std::string& file() const { return file_; }

  Expected<void> add(std::int64_t frame, double time_s, double clock_s) {
    out_ << fmt::format("{},{:.6f}", frame, time_s);
    if (has_clock_) out_ << fmt::format(",{:.6f}", clock_s);
    out_ << '\n' << std::flush;
    if (out_) return {};
    return Unexpected(cannot_write(file_ + ".part"));
  }

  Expected<void> finish() {
    out_.close();
    std::error_code error;
    std::filesystem::rename(file_ + ".part", file_, error);
    if (!out_ || error) return Unexpected(cannot_write(file_));
    return {};
  }

 private:
  std::string file_;
  bool has_clock_;
  std::ofstream out_;
};

/// One recording, from the first frame to the last.
class Recording {
 public:
  Recording(FrameSource& source, VideoWriter writer, Sidecar sidecar, const Words& words,
            std::optional<double> seconds, std::optional<double> rate)
      : source_(source),
        writer_(std::move(writer)),
        sidecar_(std::move(sidecar)),
        paced_(words.realtime && !source.info().is_live),
        seconds_(seconds),
        rate_(rate) {}

  /// All frames; what is recorded is whole when it comes back, with an error or without.
  Expected<void> run(Output& output) {
    Expected<void> done = all_frames(output);
    // What was recorded until then is good, whatever ended it; but a full disk ends nothing well.
    if (!done && done.error().kind == ErrorKind::Unavailable) return done;
    if (auto ended = writer_.finish(); !ended) return ended;
    if (auto ended = sidecar_.finish(); !ended) return ended;
    return done;
  }

  std::int64_t frames() const { return frames_; }
  std::int64_t dropped() const { return source_.damaged_frames() + too_close_; }
  double seconds() const { return last_s_; }
  double rate() const {
    return frames_ > 1 && last_s_ > 0 ? static_cast<double>(frames_ - 1) / last_s_ : 0;
  }
  std::string summary() const {
    return fmt::format("{} frames in {:.1f} s, {:.1f} a second, {} dropped", frames_, last_s_,
                       rate(), dropped());
  }
  const std::string& times_file() const { return sidecar_.file(); }
  /// Removes a recording without a frame.
  void remove(const std::string& file) const {
    std::error_code ignored;
    for (const std::string& name : {file, sidecar_.file(), sidecar_.file() + ".part"})
      std::filesystem::remove(name, ignored);
  }
  /// Takes the line of progress away.
  void clear_line(Output& output) const {
    if (shown_) output.err << "\r\x1b[2K" << std::flush;
  }

 private:
  Expected<void> all_frames(Output& output) {
    while (!stop_was_asked_for()) {
      const auto more = source_.next();
      if (!more) return Unexpected(more.error());
      if (!*more) return {};
      const auto clock = time_of(source_.frame());
      if (!clock) return Unexpected(clock.error());
      if (!first_) {
        first_ = *clock;
        started_ = Clock::now();
      }
      const double time = *clock - *first_;
      if (seconds_ && time >= *seconds_) return {};
      if (paced_) wait_until(time);
      if (auto kept = keep(time, *clock); !kept) return kept;
      tell(output);
    }
    return {};
  }

  Expected<double> time_of(const Frame& frame) const {
    if (frame.time_s) return *frame.time_s;
    if (rate_) return static_cast<double>(frame.number) / *rate_;
    return Unexpected(error_of(IssueCode::Timestamps,
                               "its frames have no times; say with --rate how many a second",
                               source_.info().name));
  }

  Expected<void> keep(double time, double clock) {
    // Matroska counts milliseconds. Pictures that a network held back may come at once.
    const std::int64_t ms = std::llround(time * 1000);
    if (frames_ > 0 && ms <= last_ms_) {
      ++too_close_;
      return {};
    }
    if (auto written = writer_.write(source_.color(), time); !written) return written;
    last_ms_ = ms;
    last_s_ = time;
    return sidecar_.add(frames_++, time, clock);
  }

  /// Until a frame is due, or somebody wants to stop.
  void wait_until(double time) const {
    const auto due =
        started_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time));
    constexpr std::chrono::milliseconds kPatience{20};
    while (!stop_was_asked_for() && Clock::now() < due)
      std::this_thread::sleep_until(std::min(due, Clock::now() + kPatience));
  }

  void tell(Output& output) {
    const auto now = Clock::now();
    if (output.quiet || now < next_line_) return;
    const bool terminal = output.err_is_terminal;
    next_line_ = now + (terminal ? std::chrono::milliseconds(500) : std::chrono::seconds(10));
    constexpr const char* kClearLine = "\r\x1b[2K";
    output.err << (terminal ? kClearLine : "") << summary() << (terminal ? "" : "\n") << std::flush;
    shown_ = terminal;
  }

  FrameSource& source_;
  VideoWriter writer_;
  Sidecar sidecar_;
  bool paced_;
  std::optional<double> seconds_;
  std::optional<double> rate_;
  std::optional<double> first_;
  Clock::time_point started_;
  Clock::time_point next_line_ = Clock::now() + std::chrono::seconds(1);
  bool shown_ = false;
  std::int64_t frames_ = 0;
  std::int64_t too_close_ = 0;
  std::int64_t last_ms_ = 0;
  double last_s_ = 0;
};

Expected<void> check_names(const Words& words) {
  if (!words.file.ends_with(".mkv")) {
    return bad_input("a recording is a .mkv, which stays readable when it is cut off", words.file);
  }
  std::error_code ignored;
  if (std::filesystem::exists(words.file, ignored)) {
    return bad_input("is there already; a recording never overwrites one", words.file);
  }
  return {};
}

/// How many frames a second when each has no time of its own.
std::optional<double> counting_rate(const SourceInfo& info, std::optional<double> asked) {
  if (asked) return asked;
  if (info.has_count && info.frame_rate > 0) return info.frame_rate;
  return std::nullopt;
}

ExitCode answer(const Words& words, const Recording& recording, Output& output) {
  if (output.json) {
    output.out << fmt::format(
        "{{\"file\":{},\"times\":{},\"frames\":{},\"seconds\":{},\"dropped\":{}}}\n",
        json_text(words.file), json_text(recording.times_file()), recording.frames(),
        json_number(recording.seconds()), recording.dropped());
  } else {
    output.out << words.file << ": " << recording.summary() << "\n"
               << recording.times_file() << ": the time of each\n";
  }
  return ExitCode::Done;
}

ExitCode record(const Words& words, Output& output) {
  const auto failed = [&](const Error& error) {
    return fail(output, exit_code_of_tracking(error), error);
  };
  const auto seconds = positive(words.seconds, "--seconds");
  if (!seconds) return failed(seconds.error());
  const auto rate = positive(words.rate, "--rate");
  if (!rate) return failed(rate.error());
  if (const auto right = check_names(words); !right) return failed(right.error());
  catch_stop_signals();
  auto source = FrameSource::open(words.source);
  if (!source) return failed(source.error());
  const SourceInfo& info = (*source)->info();
  const std::optional<double> counted = counting_rate(info, *rate);
  VideoOptions options{.codec = words.codec, .live = true};
  if (info.frame_rate > 0) options.frame_rate = info.frame_rate;
  if (counted) options.frame_rate = *counted;
  if (words.quality) options.quality = static_cast<int>(*words.quality);
  auto writer = VideoWriter::open(words.file, info.size, options);
  if (!writer) return failed(writer.error());
  Recording recording(**source, std::move(*writer), Sidecar(words.file, info.is_live), words,
                      *seconds, counted);
  Expected<void> done = recording.run(output);
  recording.clear_line(output);
  if (recording.frames() == 0) {
    recording.remove(words.file);
    if (done) done = Unexpected(error_of(IssueCode::VideoUnreadable, "no frame came", info.name));
    return failed(done.error());
  }
  if (done) return answer(words, recording, output);
  Error error = done.error();
  error.message +=
      fmt::format("; {} holds what came before, at most {:.1f} s", words.file, recording.seconds());
  return failed(error);
}

}  // namespace

Run declare_record(Options& options) {
  auto words = std::make_shared<Words>();
  options.text("SOURCE", words->source, "Camera, address, video file or folder of images",
               Options::Need::Required);
  options.text("FILE", words->file, "Video to write, a .mkv", Options::Need::Required);
  options.text("--seconds", words->seconds, "Stop after so long (default: until Ctrl-C)");
  options.text("--rate", words->rate, "Frames a second, for images and videos without times");
  options.choice("--codec", words->codec, {"h264", "mjpeg", "ffv1"},
                 "How to pack the pictures (default h264)");
  options.integer("--quality", words->quality, {1, 100}, "From 1 to 100 (default 80)");
  options.flag("--realtime", words->realtime, "Play a video or folder as fast as it was taken");
  return [words](Output& output) { return record(*words, output); };
}

}  // namespace swarmsmith::cli
