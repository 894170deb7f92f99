#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/id.h"
#include "base/text/table_reader.h"
#include "base/text/whole_file.h"
#include "sim/files/color_text.h"
#include "sim/files/mission_file.h"
#include "sim/files/read_place.h"
#include "tracking/rig/internal/config_errors.h"
#include "tracking/rig/internal/rig_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// Clocks of cameras may count from 1970.
constexpr Limits<double> kClock{-1e12, 1e12};
constexpr Limits<double> kAhead{-86'400, 86'400};
constexpr Limits<double> kLength{0.1, 86'400};

const std::vector<std::string> kSyncs = {"hidden", "shown"};

/// Reads `mission`: the name of a built-in mission, a mission file, or a [[mission]] in the log
/// itself.
Mission read_log_mission(TableReader& root, const std::filesystem::path& folder) {
  if (!root.has("mission")) {
    root.take("mission");
    return {};
  }
  if (std::holds_alternative<Array>(root.take("mission")->value)) {
    auto missions = read_missions(root, folder);
    if (missions.size() == 1) return std::move(missions.front().mission);
    root.complain("mission",
                  "a run has one mission, but the file has " + std::to_string(missions.size()));
    return {};
  }
  const auto word = root.text("mission");
  if (!word) return {};
  auto found = find_mission(*word, folder);
  if (found) return std::move(found->mission);
  for (Error& error : found.error()) {
    if (error.where.empty()) {
      root.complain("mission", std::move(error.message));
    } else {
      root.complain_foreign("mission", std::move(error));
    }
  }
  return {};
}

/// Reads `design` or `candidate`, which name the control software of the robots.
void read_control(TableReader& root, RunLog& log) {
  if (const auto design = root.text("design")) {
    log.design = *design;
    if (!id_from_text<DesignTag>(log.design)) {
      root.complain("design", "`design` must be a design's id, such as \"d3\"; this is \"" +
                                  log.design + "\"");
    }
  }
  if (const auto candidate = root.text("candidate")) {
    log.candidate = *candidate;
    if (!id_from_text<CandidateTag>(log.candidate)) {
      root.complain("candidate",
                    "`candidate` must be a candidate's id, such as \"c812\"; this is \"" +
                        log.candidate + "\"");
    }
  }
  if (root.has("design") && root.has("candidate")) {
    root.complain("candidate",
                  "a candidate belongs to a design; give `design` or `candidate`, not both");
  }
}

/// Reads `start` and `sync`.
RunStart read_start(TableReader& root) {
  RunStart start;
  start.time_s = root.seconds("start", kClock);
  auto sync = root.table("sync");
  if (!sync) return start;
  if (!sync->has("tag")) sync->complain("tag", sync->name() + " needs a `tag`, its number");
  start.sync_tag = static_cast<int>(sync->integer("tag", kTagNumber).value_or(0));
  if (!sync->has("when")) sync->complain("when", sync->name() + " needs `when`: hidden or shown");
  const auto when = sync->choice("when", kSyncs);
  if (when) start.sync = *when == "hidden" ? RunStart::Sync::Hidden : RunStart::Sync::Shown;
  sync->finish();
  return start;
}

RunVideo read_video(TableReader& table) {
  RunVideo video;
  video.camera = table.text("camera").value_or("");
  video.file = need_text(table, "file", "run07.mp4");
  video.times = table.text("times").value_or("");
  video.clock_ahead_s = table.seconds("ahead", kAhead).value_or(0);
  video.length_s = table.seconds("length", kLength);
  table.finish();
  return video;
}

/// Reads `layout` and the [[patch]] tables.
RunLayout read_layout(TableReader& root) {
  static const std::vector<std::string> kLayouts = {"measured"};
  RunLayout layout;
  if (root.choice("layout", kLayouts)) layout.source = RunLayout::Source::Measured;
  for (TableReader& table : root.tables("patch")) {
    PatchPlacement patch;
    patch.centre = need_point(table);
    const auto color = table.text("color");
    const auto known = color ? parse_color(*color) : std::nullopt;
    if (known) {
      patch.color = *known;
    } else if (color) {
      table.complain("color", no_such_color(*color));
    } else if (!table.has("color")) {
      table.complain("color", table.name() + " needs a `color`");
    }
    table.finish();
    layout.patches.push_back(patch);
  }
  if (layout.source == RunLayout::Source::None && !layout.patches.empty()) {
    layout.source = RunLayout::Source::Log;
  }
  return layout;
}

HandPoint read_hand_point(TableReader& table) {
  HandPoint point;
  point.robot = need_text(table, "robot", "rvr1");
  point.camera = table.text("camera").value_or("");
  if (!table.has("time")) table.complain("time", table.name() + " needs a `time` of the run");
  point.time_s = table.seconds("time", kClock).value_or(0);
  constexpr Limits<double> kPixels{-10'000, 100'000};
  for (const auto& [key, value] : {std::pair{"u", &point.middle.u}, {"v", &point.middle.v}}) {
    if (!table.has(key))
      table.complain(key, table.name() + " needs `u` and `v`, the middle of the tag in pixels");
    *value = table.number(key, kPixels).value_or(0);
  }
  if (table.has("heading")) {
    point.heading_deg = table.number("heading", {-360, 360}).value_or(0);
  }
  point.who = need_text(table, "who", "A. Person");
  table.finish();
  return point;
}

RobotNote read_robot_note(TableReader& table) {
  static const std::vector<std::string> names = {std::string(name_of(Verdict::Valid)),
                                                 std::string(name_of(Verdict::Degraded)),
                                                 std::string(name_of(Verdict::Invalid))};
  RobotNote note;
  note.robot = need_text(table, "name", "rvr1");
  note.log = table.text("log").value_or("");
  if (const auto verdict = table.choice("verdict", names)) {
    note.verdict = verdict_from_name(*verdict);
  }
  note.reasons = table.texts("reasons").value_or(std::vector<std::string>());
  table.finish();
  return note;
}

/// A robot may have only one note.
void check_notes(TableReader& root, const std::vector<RobotNote>& notes) {
  for (std::size_t i = 0; i < notes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (notes[i].robot != notes[k].robot) continue;
      root.complain("robot", "two [[robot]] are for robot \"" + notes[i].robot + "\"");
      return;
    }
  }
}

/// A date as text: "2026-11-21".
std::string date_text(std::chrono::year_month_day date) {
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

/// Each video of a run must be from another camera.
void check_videos(TableReader& root, const std::vector<RunVideo>& videos) {
  for (std::size_t i = 0; i < videos.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (videos[i].camera != videos[k].camera) continue;
      root.complain("video", videos[i].camera.empty()
                                 ? "several [[video]]: each needs a `camera`, as in the arena file"
                                 : "two [[video]] are by camera \"" + videos[i].camera + "\"");
      return;
    }
  }
}

std::string time_text(double seconds) {
  return quoted_text(number_text(seconds) + " s");
}

std::vector<SectionLine> head_lines(const RunLog& log) {
  std::vector<SectionLine> lines = {{"format", "1"}, {"name", quoted_text(log.name)}};
  if (!log.recorded.empty()) lines.push_back({"recorded", log.recorded});
  if (!log.design.empty()) lines.push_back({"design", quoted_text(log.design)});
  if (!log.candidate.empty()) lines.push_back({"candidate", quoted_text(log.candidate)});
  lines.push_back({"source", quoted_text(log.source)});
  if (!log.robots.empty()) {
    lines.push_back({"robots", "[" + list_of(log.robots, quoted_text) + "]"});
  }
  if (log.start.time_s) {
    lines.push_back({"start", time_text(*log.start.time_s)});
  }
  if (log.start.sync != RunStart::Sync::None) {
    const bool hidden = log.start.sync == RunStart::Sync::Hidden;
    lines.push_back({"sync", "{ tag = " + std::to_string(log.start.sync_tag) +
                                 ", when = " + quoted_text(kSyncs[hidden ? 0 : 1]) + " }"});
  }
  if (log.layout.source == RunLayout::Source::Measured) {
    lines.push_back({"layout", quoted_text("measured")});
  }
  return lines;
}

Section video_section(const RunVideo& video) {
  Section section{"[[video]]", "video.", {}};
  if (!video.camera.empty()) section.lines.push_back({"camera", quoted_text(video.camera)});
  section.lines.push_back({"file", quoted_text(video.file)});
  if (!video.times.empty()) section.lines.push_back({"times", quoted_text(video.times)});
  section.lines.push_back({"ahead", time_text(video.clock_ahead_s)});
  if (video.length_s) section.lines.push_back({"length", time_text(*video.length_s)});
  return section;
}

}  // namespace

std::string run_name_of(const std::filesystem::path& file) {
  const bool is_folder = file.filename().empty() && file.has_parent_path();
  const std::string stem = (is_folder ? file.parent_path() : file).stem().string();
  std::string name;
  for (const char letter : stem) {
    if (is_name(std::string_view(&letter, 1))) {
      name += letter;
    } else if (!name.ends_with('_')) {
      name += '_';
    }
  }
  return is_name(name) ? name : "run";
}

OrComplaints<RunLog> parse_run_log(std::string_view text, const std::filesystem::path& file) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(config_errors({document.error()}));
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  RunLog log;
  read_format(root);
  log.name = root.text("name").value_or(run_name_of(file));
  if (root.has("name")) check_name(root, log.name, {});
  if (const auto date = root.date("recorded")) log.recorded = date_text(*date);
  log.mission = read_log_mission(root, file.parent_path());
  read_control(root, log);
  if (const auto source = root.text("source")) {
    log.source = *source;
    if (!is_name(log.source)) {
      root.complain("source",
                    "`source` must be a name, such as \"real\"; this is \"" + log.source + "\"");
    }
  }
  if (auto robots = root.texts("robots")) log.robots = std::move(*robots);
  log.start = read_start(root);
  log.layout = read_layout(root);
  for (TableReader& table : root.tables("video"))
    log.videos.push_back(read_video(table));
  check_videos(root, log.videos);
  for (TableReader& table : root.tables("point"))
    log.points.push_back(read_hand_point(table));
  for (TableReader& table : root.tables("robot"))
    log.notes.push_back(read_robot_note(table));
  check_notes(root, log.notes);
  root.finish();
  if (!complaints.empty()) return tl::unexpected(config_errors(complaints.take()));
  return log;
}

OrComplaints<RunLog> read_run_log(const std::filesystem::path& file) {
  const auto text = read_file(file, "run log");
  if (!text) return tl::unexpected(config_errors({text.error()}));
  return parse_run_log(*text, file);
}

std::string run_log_text(const RunLog& log) {
  std::vector<Section> sections = {{"", "", head_lines(log)}};
  for (const RunVideo& video : log.videos)
    sections.push_back(video_section(video));
  for (const RobotNote& note : log.notes) {
    Section section{"[[robot]]", "robot.", {{"name", quoted_text(note.robot)}}};
    if (!note.log.empty()) section.lines.push_back({"log", quoted_text(note.log)});
    if (note.verdict) {
      section.lines.push_back({"verdict", quoted_text(name_of(*note.verdict))});
    }
    if (!note.reasons.empty()) {
      section.lines.push_back({"reasons", "[" + list_of(note.reasons, quoted_text) + "]"});
    }
    sections.push_back(std::move(section));
  }
  for (const HandPoint& point : log.points) {
    Section section{"[[point]]", "point.", {{"robot", quoted_text(point.robot)}}};
    if (!point.camera.empty()) section.lines.push_back({"camera", quoted_text(point.camera)});
    section.lines.push_back({"time", time_text(point.time_s)});
    section.lines.push_back({"u", number_text(point.middle.u)});
    section.lines.push_back({"v", number_text(point.middle.v)});
    if (point.heading_deg) section.lines.push_back({"heading", number_text(*point.heading_deg)});
    section.lines.push_back({"who", quoted_text(point.who)});
    sections.push_back(std::move(section));
  }
  for (const PatchPlacement& patch : log.layout.patches) {
    sections.push_back({"[[patch]]",
                        "patch.",
                        {{"x", number_text(patch.centre.x)},
                         {"y", number_text(patch.centre.y)},
                         {"color", quoted_text(color_text(patch.color))}}});
  }
  if (!log.mission.name.empty()) {
    for (Section& section : mission_sections({log.mission}))
      sections.push_back(std::move(section));
  }
  return text_of(sections);
}

}  // namespace swarmsmith
