#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/store_at_rest.h"
#include "tracking/app/refusal.h"
#include "tracking/app/robot_files.h"
#include "tracking/app/score_arguments.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"
#include "tracking/video/frame_clock.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A video of the run, opened, with its times.
struct PlannedVideo {
  std::filesystem::path path;
  std::unique_ptr<FrameSource> source;
  FrameClock clock;
};

/// What `track score` knows before it looks at the first frame: all that can be refused has been.
struct RunPlan {
  std::string arena_text;
  Rig whole_rig;
  Rig rig;  ///< the cameras and robots of this run, cameras as `videos`
  RunLog log;
  CandidateId candidate;  ///< none when it was not given
  std::vector<PlannedVideo> videos;
  RobotFiles robots;
  std::string store;  ///< empty: the run is not kept
  StoreAtRest::IfMissing if_missing = StoreAtRest::IfMissing::Refuse;
  bool takes_tags_for_centres = false;
};

OrRefusal<RunPlan> plan_run(const ScoreArguments& arguments);

/// An arena file's text and what it says.
struct ArenaFile {
  std::string text;
  Rig rig;
};
OrRefusal<ArenaFile> read_arena_file(const std::string& file);

}  // namespace swarmsmith
