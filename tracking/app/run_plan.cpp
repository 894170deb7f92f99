#include "tracking/app/run_plan.h"

#include <algorithm>
#include <string_view>

#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/whole_file.h"
#include "tracking/app/run_checks.h"
#include "tracking/app/run_options.h"
#include "tracking/app/run_store.h"
#include "tracking/app/sidecar_file.h"
#include "tracking/rig/picture_size.h"
#include "tracking/rig/rig_file.h"
#include "tracking/scoring/run_patches.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// A run log for videos without one.
RunLog log_of_words(const std::vector<std::string>& videos) {
  RunLog log;
  if (!videos.empty()) log.name = run_name_of(file_of_source(videos.front()));
  for (const std::string& video : videos)
    log.videos.push_back({.camera = {}, .file = video, .times = {}});
  return log;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// The files of the videos and sidecars. Names on the command line are relative to the current
/// folder, names in the log to the log's folder.
struct VideoFiles {
  std::vector<fs::path> videos;
  std::vector<fs::path> times;  ///< an entry is empty if there is no sidecar
};

OrRefusal<VideoFiles> files_of(const ScoreArguments& arguments, RunLog& log) {
  const auto count = log.videos.size();
  if (count == 0) {
    return refused(
        ExitCode::Usage,
        wrong_option("no video given; name its file, or a run log with [[video]]", "VIDEO"));
  }
  if (!arguments.videos.empty() && arguments.videos.size() != count) {
    return refused(ExitCode::Usage, wrong_option("the run log has " + counted(count, "video") +
                                                     "; name as many videos, or none",
                                                 "VIDEO"));
  }
  if (!arguments.times.empty() && arguments.times.size() != count) {
    return refused(ExitCode::Usage, wrong_option("the run has " + counted(count, "video") +
                                                     "; give --times once for each",
                                                 "--times"));
  }
  const fs::path folder = fs::path(arguments.run).parent_path();
  VideoFiles files;
  for (std::size_t i = 0; i < count; ++i) {
    RunVideo& video = log.videos[i];
    if (!arguments.videos.empty()) video.file = arguments.videos[i];
    // `camera:0` and URLs are not files.
    const bool from_here = !arguments.videos.empty() || video.file.find("://") != std::string::npos;
    files.videos.push_back(from_here ? fs::path(video.file) : folder / video.file);
    if (!arguments.times.empty()) {
      video.times = arguments.times[i];
      files.times.emplace_back(video.times);
    } else if (!video.times.empty()) {
      files.times.push_back(folder / video.times);
    } else {
      files.times.push_back(sidecar_beside(files.videos.back().string()));
      video.times = files.times.back().filename().string();
    }
  }
  for (const RunVideo& video : log.videos) {
    for (const std::string& name : {video.file, video.times}) {
      if (is_utf8(name)) continue;
      return refused(error_of(
          IssueCode::Config,
          "the name of this file is not UTF-8, so that a store cannot keep it; rename it", name));
    }
  }
  return files;
}

/// Settles the store and the control software; if the log does not give a mission, it is the one
/// for which the control software was designed. Returns the machine if the control software is
/// known.
OrRefusal<std::optional<RanMachine>> settle_control(const ScoreArguments& arguments,
                                                    RunPlan& plan) {
  plan.store = !arguments.into.empty() ? arguments.into : store_word(arguments.store);
  RunLog& log = plan.log;
  if (auto named = check_source(log, plan.store); !named)
    return tl::unexpected(std::move(named.error()));
  const bool says_control = !log.design.empty() || !log.candidate.empty();
  if (!arguments.into.empty() && !says_control) plan.if_missing = StoreAtRest::IfMissing::Make;
  if (!plan.store.empty()) {
    // Opened only to report errors before the video is read. It is opened again for writing, so
    // that a campaign can run meanwhile.
    auto store = open_store(plan.store, plan.if_missing);
    if (!store) return tl::unexpected(std::move(store.error()));
  }
  if (says_control && plan.store.empty()) {
    return refused(
        ExitCode::Usage,
        wrong_option("a design or candidate belongs to a store: name it with --into", "--into"));
  }
  std::optional<RanMachine> machine;
  if (says_control) {
    auto control = control_of(plan.store, log);
    if (!control) return tl::unexpected(std::move(control.error()));
    plan.candidate = control->candidate;
    machine = control->machine;
    if (log.mission.name.empty()) log.mission = control->mission;
    if (auto fits = check_mission(*control, log, plan.store); !fits)
      return tl::unexpected(std::move(fits.error()));
  }
  if (log.mission.name.empty()) {
    return refused(wrong_option(
        "no mission given; name it in the run log or with --mission, or give the design "
        "that ran: --design",
        "--mission"));
  }
  return machine;
}

/// Checks given patches against the mission; measured patches are added later.
OrRefusal<void> settle_layout(RunLog& log) {
  if (log.layout.source == RunLayout::Source::Measured) {
    log.layout.patches.clear();
    if (log.mission.shuffled.places.empty()) log.layout = {};
    return {};
  }
  auto patches = run_patches(log.mission, said_patches(log));
  if (!patches) return refused(patches.error());
  return {};
}

/// Opens the videos; reports the first one that cannot be opened.
OrRefusal<void> open_videos(const VideoFiles& files, RunPlan& plan) {
  for (std::size_t i = 0; i < files.videos.size(); ++i) {
    auto source = FrameSource::open(files.videos[i].string());
    if (!source) return refused(source.error());
    const SourceInfo& info = (*source)->info();
    if (info.is_live) {
      return refused(
          wrong_option("a live camera cannot be scored; record it with `swarmsmith track record`, "
                       "then score the file",
                       info.name));
    }
    const CameraSetup& camera = plan.rig.cameras[i];
    const auto fits =
        check_picture_size(camera.model_file, plan.rig.models.at(camera.model_file).model.size,
                           info.size, info.oddities, files.videos[i].string());
    if (!fits) return refused(fits.error());
    std::optional<std::vector<double>> times;
    if (!files.times[i].empty()) {
      const auto text = read_file(files.times[i], "frame times");
      if (!text)
        return refused(
            error_of(IssueCode::SidecarMismatch, text.error().message, text.error().where));
      auto parsed = parse_frame_times(*text);
      if (!parsed) {
        Error error = parsed.error();
        error.where = files.times[i].string() + (error.where.empty() ? "" : ":" + error.where);
        return refused(std::move(error));
      }
      times = std::move(*parsed);
    }
    auto clock = FrameClock::of(info, std::move(times));
    if (!clock) return refused(clock.error());
    plan.videos.push_back({files.videos[i], std::move(*source), std::move(*clock)});
  }
  return {};
}

}  // namespace

OrRefusal<ArenaFile> read_arena_file(const std::string& file) {
  auto text = read_file(file, "arena");
  if (!text) return refused(error_of(IssueCode::Config, text.error().message, text.error().where));
  auto rig = parse_rig(*text, file);
  if (!rig) return refused(std::move(rig.error()));
  return ArenaFile{std::move(*text), std::move(*rig)};
}

OrRefusal<RunPlan> plan_run(const ScoreArguments& arguments) {
  RunPlan plan;
  plan.takes_tags_for_centres = arguments.takes_tags_for_centres;
  std::vector<Error> errors;
  if (arguments.run.empty()) {
    plan.log = log_of_words(arguments.videos);
  } else if (auto log = read_run_log(arguments.run)) {
    plan.log = std::move(*log);
    if (plan.log.videos.empty()) plan.log.videos = log_of_words(arguments.videos).videos;
  } else {
    errors = std::move(log.error());
  }
  auto arena = read_arena_file(arguments.arena);
  if (!arena) {
    errors.insert(errors.end(), arena.error().errors.begin(), arena.error().errors.end());
  }
  if (!errors.empty()) return refused(std::move(errors));
  plan.arena_text = std::move(arena->text);
  plan.whole_rig = std::move(arena->rig);

  auto files = files_of(arguments, plan.log);
  if (!files) return tl::unexpected(std::move(files.error()));
  errors = take_options(arguments, plan.log);
  for (Error& error : settle_names(plan.log, plan.whole_rig))
    errors.push_back(std::move(error));
  if (!errors.empty()) return refused(std::move(errors));
  const auto machine = settle_control(arguments, plan);
  if (!machine) return tl::unexpected(machine.error());
  plan.rig = rig_of_run(plan.whole_rig, plan.log);
  errors = faults_of_rig(plan.rig, plan.log.mission, plan.takes_tags_for_centres);
  for (Error& error : faults_of_points(plan.log))
    errors.push_back(std::move(error));
  if (!errors.empty()) return refused(std::move(errors));
  if (auto settled = settle_layout(plan.log); !settled) {
    return tl::unexpected(std::move(settled.error()));
  }
  if (auto opened = open_videos(*files, plan); !opened) {
    return tl::unexpected(std::move(opened.error()));
  }
  plan.robots = read_robot_files(plan.log, fs::path(arguments.run).parent_path(), *machine);
  return plan;
}

}  // namespace swarmsmith
