#pragma once

#include <string>
#include <vector>

#include "tracking/app/refusal.h"
#include "tracking/rig/rig.h"
#include "tracking/rig/run_log.h"

namespace swarmsmith {

/// An E_CONFIG for a name that the arena file does not have, with the known names and the file.
/// `what` is "robot" or "camera".
Error unknown(const std::string& what, const std::string& name,
              const std::vector<std::string>& known, const std::string& file);

/// Fills in names that a log with one camera may omit, and checks its other names against the rig:
/// cameras of videos, and robots that took part. Returns all errors.
std::vector<Error> settle_names(RunLog& log, const Rig& rig);

/// Points by hand that lie outside of the run. To be called when the mission is known.
std::vector<Error> faults_of_points(const RunLog& log);

/// The part of the rig for one run: the cameras that filmed it, in the order of the log's videos,
/// and the robots that took part.
Rig rig_of_run(const Rig& rig, const RunLog& log);

/// Reasons why a run cannot be scored with this rig: calibrations that are missing or do not belong
/// together, robots without an offset, or a different number of robots than the mission has.
std::vector<Error> faults_of_rig(const Rig& rig, const Mission& mission,
                                 bool takes_tags_for_centres);

/// Tags that are expected in the picture and do not belong to robots of the run: the tag of the
/// sync event, and the tags of robots that did not take part.
std::vector<int> other_tags(const Rig& rig, const RunLog& log);

/// The log's patches with the sizes of the mission's places; nothing if the log has no patches.
std::optional<std::vector<Patch>> said_patches(const RunLog& log);

}  // namespace swarmsmith
