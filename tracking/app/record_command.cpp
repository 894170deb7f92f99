#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "base/process/stop_signal.h"
#include "base/text/json.h"
#include "tracking/app/commands.h"
#include "tracking/app/recording.h"
#include "tracking/app/sidecar_file.h"
#include "tracking/rig/issue.h"
#include "tracking/video/frame_source.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {
namespace {

struct RecordWords {
  std::string source;
  std::string file;
  std::string seconds;
  std::string rate;
  std::string codec = "h264";
  std::optional<std::int64_t> quality;
  bool realtime = false;
};

/// The positive number of an option, or nothing if the option is missing.
Expected<std::optional<double>> positive(const std::string& text, const char* option) {
  if (text.empty()) return std::optional<double>();
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr double kMost = 1e7;
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() ||
      !(value > 0 && value <= kMost)) {
    return bad_input(fmt::format("`{}` is not a positive number", text), option);
  }
  return std::optional<double>(value);
}

/// The frame rate for counting the times of frames that have none.
std::optional<double> counting_rate(const SourceInfo& info, std::optional<double> asked) {
  if (asked) return asked;
  if (info.has_count && info.frame_rate > 0) return info.frame_rate;
  return std::nullopt;
}

ExitCode answer(const RecordWords& words, const Recording& recording, Output& output) {
  if (output.json) {
    output.out << JsonObject()
                      .add("file", words.file)
                      .add("times", recording.times_file())
                      .add("frames", recording.frames())
                      .add("seconds", recording.seconds())
                      .add("dropped", recording.dropped())
                      .text()
               << "\n";
  } else {
    output.out << words.file << ": " << recording.summary() << "\n"
               << recording.times_file() << ": the time of each\n";
  }
  return ExitCode::Done;
}

ExitCode record(const RecordWords& words, Output& output) {
  const auto failed = [&](const Error& error) {
    return fail(output, exit_code_of_tracking(error), error);
  };
  const auto seconds = positive(words.seconds, "--seconds");
  if (!seconds) return failed(seconds.error());
  const auto rate = positive(words.rate, "--rate");
  if (!rate) return failed(rate.error());
  if (const auto right = check_recording_name(words.file); !right) return failed(right.error());
  if (words.quality && words.codec == "ffv1") {
    return failed({ErrorKind::BadInput,
                   "ffv1 keeps every bit and has no quality; leave out --quality", "--quality"});
  }
  auto source = FrameSource::open(words.source);
  if (!source) return failed(source.error());
  const SourceInfo& info = (*source)->info();
  const std::optional<double> counted = counting_rate(info, *rate);
  // As for `score`: what a sidecar says comes first.
  std::optional<FrameClock> clock;
  if (!info.is_live) {
    auto times = times_beside(words.source);
    if (!times) return failed(times.error());
    if (*times) {
      auto of_sidecar = FrameClock::of(info, std::move(*times));
      if (!of_sidecar) return failed(of_sidecar.error());
      clock = std::move(*of_sidecar);
    }
  }
  VideoOptions options{.codec = words.codec, .live = true};
  // The frame rate in the header of a video with irregular times may be any value.
  if (info.frame_rate > 0) options.frame_rate = std::clamp(info.frame_rate, 1.0, 240.0);
  if (counted) options.frame_rate = *counted;
  if (words.quality) options.quality = static_cast<int>(*words.quality);
  catch_stop_signals();
  auto writer = VideoWriter::open(words.file, info.size, options);
  if (!writer) return failed(writer.error());
  Recording recording(**source, std::move(*writer), Sidecar(words.file, info.is_live),
                      {.seconds = *seconds,
                       .rate = counted,
                       .clock = std::move(clock),
                       .paced = words.realtime && !info.is_live});
  Expected<void> done = recording.run(output);
  recording.clear_line(output);
  if (recording.frames() == 0) {
    remove_recording(words.file);
    if (done) done = Unexpected(error_of(IssueCode::VideoUnreadable, "no frame came", info.name));
    return failed(done.error());
  }
  if (done) return answer(words, recording, output);
  Error error = done.error();
  error.message +=
      fmt::format("; {} has what came before, at most {:.1f} s", words.file, recording.seconds());
  return failed(error);
}

}  // namespace

CommandRun declare_record(Options& options) {
  auto words = std::make_shared<RecordWords>();
  options.text("SOURCE FILE", words->source, "Camera, address, video file, folder of images or bag",
               Options::Need::Required);
  options.text("FILE", words->file, "Video to write, a .mkv", Options::Need::Required);
  options.text("--seconds SECONDS", words->seconds, "Stop after N seconds (default: until Ctrl-C)");
  options.text("--rate RATE", words->rate, "Frames a second, for images and videos without times");
  options.choice("--codec", words->codec, {"h264", "mjpeg", "ffv1"},
                 "Codec of the video (default h264)");
  options.integer("--quality", words->quality, {1, 100}, "Quality, 1 to 100 (default 80)");
  options.flag("--realtime", words->realtime, "Play a video or folder at its own speed");
  return [words](Output& output) { return record(*words, output); };
}

}  // namespace swarmsmith
