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

/// An opened video of the run, with its times.
struct PlannedVideo {
  std::filesystem::path path;
  std::unique_ptr<FrameSource> source;
  FrameClock clock;
};

/// The input of `track score` before the first frame is read. All errors that can be found so far
/// were reported.
struct RunPlan {
  std::string arena_text;
  Rig whole_rig;
  Rig rig;  ///< the cameras and robots of this run, cameras in the order of `videos`
  RunLog log;
  CandidateId candidate;  ///< none if it was not given
  std::vector<PlannedVideo> videos;
  RobotFiles robots;
  std::string store;  ///< empty: the run is not stored
  StoreAtRest::IfMissing if_missing = StoreAtRest::IfMissing::Refuse;
  bool takes_tags_for_centres = false;
};

OrRefusal<RunPlan> plan_run(const ScoreArguments& arguments);

/// The text of an arena file and its contents.
struct ArenaFile {
  std::string text;
  Rig rig;
};
OrRefusal<ArenaFile> read_arena_file(const std::string& file);

}  // namespace swarmsmith
