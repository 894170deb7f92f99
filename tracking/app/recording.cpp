#include "tracking/app/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "base/output_file.h"
#include "base/plain_text.h"
#include "base/process/stop_signal.h"
#include "console/terminal.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {
namespace {

std::string sidecar_name(const std::string& video) {
  return video.substr(0, video.rfind('.')) + ".times.csv";
}

}  // namespace

Expected<void> check_recording_name(const std::string& file) {
  if (!file.ends_with(".mkv")) {
    return bad_input("a recording must be a .mkv, which stays readable if it is cut off", file);
  }
  std::error_code ignored;
  for (const std::string& name : {file, sidecar_name(file)}) {
    if (!std::filesystem::exists(name, ignored)) continue;
    return bad_input("already exists; a recording never overwrites a file", name);
  }
  return {};
}

void remove_recording(const std::string& video) {
  std::error_code ignored;
  for (const std::string& name : {video, sidecar_name(video), sidecar_name(video) + ".part"})
    std::filesystem::remove(name, ignored);
}

Sidecar::Sidecar(const std::string& video, bool has_clock)
    : file_(sidecar_name(video)), has_clock_(has_clock) {
  out_.open(file_ + ".part", std::ios::binary | std::ios::trunc);
  out_ << (has_clock ? "frame,time_s,clock_s\n" : "frame,time_s\n") << std::flush;
}

bool Sidecar::is_later(double time_s) const {
  return !last_ms_ || std::llround(time_s * 1000) > *last_ms_;
}

Expected<void> Sidecar::add(std::int64_t frame, double time_s, double clock_s) {
  last_ms_ = std::llround(time_s * 1000);
  out_ << fmt::format("{},{:.6f}", frame, time_s);
  if (has_clock_) out_ << fmt::format(",{:.6f}", clock_s);
  out_ << '\n' << std::flush;
  if (out_) return {};
  return Unexpected(cannot_write(file_ + ".part"));
}

Expected<void> Sidecar::finish() {
  out_.close();
  std::error_code error;
  std::filesystem::rename(file_ + ".part", file_, error);
  if (!out_ || error) return Unexpected(cannot_write(file_));
  return {};
}

Recording::Recording(FrameSource& source, VideoWriter writer, Sidecar sidecar,
                     RecordingOptions options)
    : source_(source),
      writer_(std::move(writer)),
      sidecar_(std::move(sidecar)),
      options_(options) {}

Expected<void> Recording::run(Output& output) {
  Expected<void> done = all_frames(output);
  // The recording so far is completed, whatever ended it; only on a full disk this is impossible.
  if (!done && done.error().kind == ErrorKind::Unavailable) return done;
  if (auto ended = writer_.finish(); !ended) return ended;
  if (auto ended = sidecar_.finish(); !ended) return ended;
  return done;
}

void Recording::clear_line(Output& output) const {
  if (shown_) output.err << kClearLine << std::flush;
}

std::string Recording::summary() const {
  const double rate = frames_ > 1 && last_s_ > 0 ? static_cast<double>(frames_ - 1) / last_s_ : 0;
  return fmt::format("{} in {:.1f} s, {:.1f} a second, {} dropped", counted(frames_, "frame"),
                     last_s_, rate, dropped());
}

Expected<void> Recording::all_frames(Output& output) {
  while (stop_signal() == 0) {
    const auto more = source_.next();
    if (!more) return Unexpected(more.error());
    if (!*more) {
      if (!options_.clock) return {};
      return options_.clock->finish(frames_ + dropped());
    }
    const auto clock = time_of(source_.frame());
    if (!clock) return Unexpected(clock.error());
    if (!first_) {
      first_ = *clock;
      started_ = Clock::now();
    }
    const double time = *clock - *first_;
    if (options_.seconds && time >= *options_.seconds) return {};
    if (options_.paced) wait_until(time);
    if (auto kept = keep(time, *clock); !kept) return kept;
    tell(output);
  }
  return {};
}

Expected<double> Recording::time_of(const Frame& frame) {
  if (options_.clock) return options_.clock->time_of(frame);
  if (frame.time_s) return *frame.time_s;
  if (options_.rate) return static_cast<double>(frame.number) / *options_.rate;
  return Unexpected(error_of(IssueCode::Timestamps,
                             "its frames have no times; give the frames per second with --rate",
                             source_.info().name));
}

Expected<void> Recording::keep(double time, double clock) {
  if (!sidecar_.is_later(time)) {
    ++too_close_;
    return {};
  }
  if (auto written = writer_.write(source_.color(), time); !written) return written;
  last_s_ = time;
  return sidecar_.add(frames_++, time, clock);
}

/// Waits until a frame is due, or the user asks to stop.
void Recording::wait_until(double time) const {
  const auto due =
      started_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time));
  constexpr std::chrono::milliseconds kLookAgain{20};
  while (stop_signal() == 0 && Clock::now() < due)
    std::this_thread::sleep_until(std::min(due, Clock::now() + kLookAgain));
}

void Recording::tell(Output& output) {
  const auto now = Clock::now();
  if (output.quiet || now < next_line_) return;
  const bool terminal = output.err_is_terminal;
  next_line_ = now + (terminal ? std::chrono::milliseconds(500) : std::chrono::seconds(10));
  output.err << (terminal ? kClearLine : Verbatim{}) << summary() << (terminal ? "" : "\n")
             << std::flush;
  shown_ = terminal;
}

}  // namespace swarmsmith
