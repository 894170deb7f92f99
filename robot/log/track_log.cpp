#include "robot/log/track_log.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text/csv.h"
#include "base/text/toml_text.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kLackOfClock =
    "they are not from `swarmsmith track record` on this host; give the start with `track score "
    "--start`, or cover a tag";

/// The reason why the start time is unknown; empty if it is known.
std::string doubt_of(const StartedRun& run, const std::optional<CameraClock>& clock) {
  if (run.video.empty()) return "no video was given";
  if (!clock) return "the video's clock is not known";
  constexpr std::string_view kWhy =
      "was it filmed on another host, or is it the video of another run?";
  if (run.at_clock_s < clock->first_clock_s) {
    return fmt::format("{} begins {:.2f} s after the robots did; {}", run.video,
                       clock->first_clock_s - run.at_clock_s, kWhy);
  }
  if (run.at_clock_s > clock->last_clock_s) {
    return fmt::format("{} ends {:.2f} s before the robots began; {}", run.video,
                       run.at_clock_s - clock->last_clock_s, kWhy);
  }
  return {};
}

Section head_of(const StartedRun& run) {
  Section head{"", "", {{"format", "1"}, {"name", quoted_text(run.run)}}};
  const auto add = [&head](const char* key, const std::string& value) {
    if (!value.empty()) head.lines.push_back({key, quoted_text(value)});
  };
  if (!run.recorded.empty()) head.lines.push_back({"recorded", run.recorded});
  add("mission", run.mission);
  if (run.candidate.empty()) add("design", run.design);
  add("candidate", run.candidate);
  head.lines.push_back({"source", quoted_text("real")});
  if (!run.nodes.empty()) {
    head.lines.push_back({"robots", "[" + list_of(run.nodes, [](const NodeReport& node) {
                                      return quoted_text(node.robot);
                                    }) + "]"});
  }
  return head;
}

Section section_of(const NodeReport& node) {
  Section section{"[[robot]]", "robot.", {{"name", quoted_text(node.robot)}}};
  if (!node.log.empty()) section.lines.push_back({"log", quoted_text(node.log)});
  // Its behaviour after its last state is unknown, so its verdict cannot be better.
  const RunVerdict verdict = node.verdict.value_or(RunVerdict::Invalid);
  section.lines.push_back({"verdict", quoted_text(name_of(verdict))});
  std::vector<std::string> reasons = node.reasons;
  if (!node.verdict && reasons.empty()) reasons = {"it did not answer after the run"};
  if (!reasons.empty()) {
    section.lines.push_back({"reasons", "[" + list_of(reasons, quoted_text) + "]"});
  }
  return section;
}

}  // namespace

Expected<CameraClock> camera_clock_of(std::string_view sidecar, const std::string& file) {
  // The last row may be incomplete.
  const auto table = parse_csv(sidecar.substr(0, sidecar.rfind('\n') + 1), file);
  if (!table) return Unexpected(table.error().front());
  if (!table->column("time_s")) {
    return bad_input("this is not a file of frame times: it has no column `time_s`", file);
  }
  if (!table->column("clock_s")) {
    return bad_input("these frame times have no column `clock_s`: " + std::string(kLackOfClock),
                     file);
  }
  std::optional<CameraClock> clock;
  for (const CsvRow& row : table->rows) {
    const auto time_s = number_in(cell_of(*table, row, "time_s"));
    const auto clock_s = number_in(cell_of(*table, row, "clock_s"));
    if (!time_s || !clock_s || !std::isfinite(*time_s) || !std::isfinite(*clock_s)) {
      return bad_input("`time_s` and `clock_s` must be numbers", table->place(row));
    }
    if (!clock) clock = CameraClock{*time_s, *clock_s, *clock_s};
    clock->last_clock_s = *clock_s;
  }
  if (!clock) return bad_input("it has no frame yet; is the camera on?", file);
  return *clock;
}

TrackLog track_log_of(const StartedRun& run, const std::optional<CameraClock>& clock) {
  TrackLog log;
  Section head = head_of(run);
  const std::string doubt = doubt_of(run, clock);
  if (doubt.empty()) {
    // `clock_s` and the run's start are CLOCK_MONOTONIC of this host; `time_s` is the video's time.
    const double start_s = run.at_clock_s - clock->first_clock_s + clock->first_time_s;
    head.lines.push_back({"start", quoted_text(fmt::format("{:.6f} s", start_s))});
  } else {
    log.warnings.push_back(fmt::format("the run log has no `start`: {}", doubt));
  }
  if (run.sync_tag) {
    head.lines.push_back({"sync", fmt::format("{{ tag = {}, when = \"hidden\" }}", *run.sync_tag)});
  }
  if (run.has_patches) head.lines.push_back({"layout", quoted_text("measured")});
  std::vector<Section> sections = {std::move(head)};
  if (!run.video.empty()) {
    Section video{"[[video]]", "video.", {}};
    if (!run.camera.empty()) video.lines.push_back({"camera", quoted_text(run.camera)});
    video.lines.push_back({"file", quoted_text(run.video)});
    sections.push_back(std::move(video));
  }
  for (const NodeReport& node : run.nodes)
    sections.push_back(section_of(node));
  log.text = "# Written by `swarmsmith-robot start`, for `swarmsmith track score --run`.\n";
  if (!doubt.empty()) {
    log.text += fmt::format(
        "# `start` is missing: {}\n"
        "# The robots began at {:.6f} s of this host's CLOCK_MONOTONIC, `clock_s` of the frame "
        "times.\n",
        doubt, run.at_clock_s);
  }
  log.text += text_of(sections);
  return log;
}

}  // namespace swarmsmith
