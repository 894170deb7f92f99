#pragma once

#include <string>
#include <vector>

#include "tracking/app/refusal.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// E_CONFIG for a name that the arena file does not have: "robot", rvr9, those that it has, its
/// file.
Error unknown(const std::string& what, const std::string& name,
              const std::vector<std::string>& known, const std::string& file);

/// Fills in what a log with one camera need not say, and checks its names against the rig: cameras
/// of videos, robots that took part. Returns everything that is wrong.
std::vector<Error> settle_names(RunLog& log, const Rig& rig);

/// The rig of one run: the cameras that filmed it, in the order of the log's videos, and the robots
/// that took part.
Rig rig_of_run(const Rig& rig, const RunLog& log);

/// What keeps a run in this rig from being scored: calibrations that are missing or do not belong
/// together, robots without an offset, another number of robots than the mission has.
std::vector<Error> faults_of_rig(const Rig& rig, const Mission& mission,
                                 bool takes_tags_for_centres);

/// Tags that are expected in the picture and are not robots of the run: that of the sync event, and
/// those of robots that stood by.
std::vector<int> other_tags(const Rig& rig, const RunLog& log);

/// The log's patches with the sizes of the mission's places; nothing when it says none.
std::optional<std::vector<Patch>> said_patches(const RunLog& log);

}  // namespace swarmsmith
