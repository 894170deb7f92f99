#include "tracking/video/frame_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "base/plain_text.h"
#include "base/text/csv.h"
#include "tracking/rig/issue.h"
#include "tracking/video/internal/iso_time.h"

namespace swarmsmith {
namespace {

Unexpected bad_times(const std::string& text, const std::string& where) {
  return Unexpected(error_of(IssueCode::Timestamps, text, where));
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t'))
    text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t'))
    text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return text;
}

/// The cells of the next row; none if a quote is not closed.
std::vector<std::string> next_cells(CsvReader& reader) {
  std::vector<std::string> cells = reader.next().value_or(std::vector<std::string>());
  for (std::string& cell : cells)
    cell = trimmed(cell);
  return cells;
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Quotes an arbitrary text for a message.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 30;
  std::string shown;
  for (const char c : text.substr(0, kMost))
    shown += c >= ' ' && c <= '~' ? c : '?';
  return "`" + shown + "`";
}

/// Longest time between two frames of one video.
constexpr double kMostPause_s = 3600;

/// Clocks may count from 1970; run logs have the same limit for `start`.
constexpr double kMostClock_s = 1e12;

struct Columns {
  std::size_t frame = 0;
  std::size_t time = 0;
  std::size_t count = 0;
  double unit_s = 1;  ///< unit of the times
};

/// The name of a column of times, and its unit.
struct TimeColumn {
  std::string_view name;
  double unit_s = 1;
};
constexpr std::array kTimeColumns = {TimeColumn{"time_s", 1}, TimeColumn{"time_ms", 1e-3},
                                     TimeColumn{"time_us", 1e-6}, TimeColumn{"time_ns", 1e-9},
                                     TimeColumn{"time", 0}};

const TimeColumn* time_column(std::string_view name) {
  const auto* const found = std::ranges::find(kTimeColumns, name, &TimeColumn::name);
  return found == kTimeColumns.end() ? nullptr : found;
}

Expected<Columns> columns_of(const std::vector<std::string>& names, std::string_view header) {
  std::optional<std::size_t> frame;
  std::optional<std::size_t> time;
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto& column = names[i] == "frame" ? frame : time;
    if (names[i] != "frame" && time_column(names[i]) == nullptr) continue;
    if (column) return bad_times("column " + in_quotes(names[i]) + " appears twice", "line 1");
    column = i;
  }
  if (frame && time) {
    return Columns{*frame, *time, names.size(), time_column(names[*time])->unit_s};
  }
  return bad_times(
      "a file of frame times begins with the columns `frame,time_s` (or `time_ms`, "
      "`time_us`, `time_ns`, or `time` with dates like 2026-11-18T11:06:40.250), this one with " +
          in_quotes(header),
      "line 1");
}

double mean_interval_s(const std::vector<double>& times) {
  return (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

/// Whether times are about a thousand times as far apart as the file's own rate says.
bool is_in_milliseconds(const std::vector<double>& times, double frame_rate) {
  if (times.size() < 2 || !(frame_rate > 0)) return false;
  const double ratio = mean_interval_s(times) * frame_rate;
  return ratio > 300 && ratio < 3000;
}

}  // namespace

Expected<std::vector<double>> parse_frame_times(std::string_view text) {
  CsvReader reader(text);
  if (reader.at_end()) return bad_times("the file of frame times is empty", "line 1");
  const auto columns = columns_of(next_cells(reader), text.substr(0, text.find_first_of("\r\n")));
  if (!columns) return Unexpected(columns.error());
  std::vector<double> times;
  while (!reader.at_end()) {
    const std::string where = fmt::format("line {}", reader.line());
    const std::vector<std::string> cells = next_cells(reader);
    if (cells == std::vector<std::string>{""}) continue;
    if (cells.size() != columns->count) {
      return bad_times(
          fmt::format("{} cells where the first line has {}", cells.size(), columns->count), where);
    }
    const auto frame = number_of<std::int64_t>(cells[columns->frame]);
    if (frame != static_cast<std::int64_t>(times.size())) {
      return bad_times(
          fmt::format("frame {} is expected here, not {}: frames are numbered from 0, without "
                      "gaps",
                      times.size(), in_quotes(cells[columns->frame])),
          where);
    }
    auto time = number_of<double>(cells[columns->time]);
    if (time && columns->unit_s == 0) {
      return bad_times(in_quotes(cells[columns->time]) +
                           " has no unit; name the column `time_s`, `time_ms`, `time_us` or "
                           "`time_ns`",
                       where);
    }
    if (time) *time *= columns->unit_s;
    if (!time) time = iso_time(cells[columns->time]);
    if (!time || !std::isfinite(*time)) {
      return bad_times(in_quotes(cells[columns->time]) +
                           " is not a time: neither a number nor a date like "
                           "2026-11-18T11:06:40.250",
                       where);
    }
    if (!times.empty() && *time <= times.back()) {
      return bad_times(fmt::format("frame {} at {} s is not later than the frame before, at {} s",
                                   times.size(), *time, times.back()),
                       where);
    }
    if (!times.empty() && *time - times.back() > kMostPause_s) {
      return bad_times(fmt::format("frame {} at {} s is more than an hour later than the frame "
                                   "before, at {} s; if they are milli-, micro- or nanoseconds, "
                                   "name the column `time_ms`, `time_us` or `time_ns`",
                                   times.size(), *time, times.back()),
                       where);
    }
    if (times.empty() && std::abs(*time) > kMostClock_s) {
      return bad_times(fmt::format("frame 0 at {} s is not a time that a clock shows; if it is in "
                                   "milli-, micro- or nanoseconds, name the column `time_ms`, "
                                   "`time_us` or `time_ns`",
                                   *time),
                       where);
    }
    times.push_back(*time);
  }
  if (times.empty()) return bad_times("it has no frame", "line 2");
  return times;
}

Expected<FrameClock> FrameClock::of(const SourceInfo& source,
                                    std::optional<std::vector<double>> sidecar) {
  FrameClock clock;
  clock.name_ = source.name;
  if (sidecar) {
    if (is_in_milliseconds(*sidecar, source.frame_rate)) {
      return bad_times(fmt::format("its times are {:.3g} s from frame to frame, but the video has "
                                   "{:.4g} frames/s: are they milliseconds? Name the column "
                                   "`time_ms` then",
                                   mean_interval_s(*sidecar), source.frame_rate),
                       source.name);
    }
    clock.source_ = TimeSource::Sidecar;
    clock.sidecar_ = std::move(*sidecar);
    return clock;
  }
  if (source.has_times) return clock;
  if (source.has_count && source.frame_rate > 0) {
    clock.source_ = TimeSource::FrameRate;
    clock.frame_rate_ = source.frame_rate;
    return clock;
  }
  return bad_times(
      "its frames have no reliable times, and no constant rate fits their number; give the "
      "camera's frame times as a file with the columns `frame,time_s`",
      source.name);
}

Expected<double> FrameClock::time_of(const Frame& frame) {
  std::optional<double> time = frame.time_s;
  if (source_ == TimeSource::Sidecar) {
    if (frame.number >= static_cast<std::int64_t>(sidecar_.size())) {
      return Unexpected(error_of(
          IssueCode::SidecarMismatch,
          fmt::format("the video has a frame {}, but the file of frame times ends with frame {}",
                      frame.number, static_cast<std::int64_t>(sidecar_.size()) - 1),
          name_));
    }
    time = sidecar_[static_cast<std::size_t>(frame.number)];
  } else if (source_ == TimeSource::FrameRate) {
    time = static_cast<double>(frame.number) / frame_rate_;
  }
  if (!time || !std::isfinite(*time)) {
    return bad_times(fmt::format("frame {} has no time", frame.number), name_);
  }
  if (last_ && *time <= *last_) {
    return bad_times(fmt::format("frame {} at {} s is not later than the frame before, at {} s",
                                 frame.number, *time, *last_),
                     name_);
  }
  last_ = time;
  return *time;
}

Expected<void> FrameClock::finish(std::int64_t frames) const {
  const auto rows = static_cast<std::int64_t>(sidecar_.size());
  if (source_ != TimeSource::Sidecar || rows <= frames) return {};
  return Unexpected(error_of(
      IssueCode::SidecarMismatch,
      fmt::format("{} in the video, {} in the file of frame times", counted(frames, "frame"), rows),
      name_));
}

}  // namespace swarmsmith
