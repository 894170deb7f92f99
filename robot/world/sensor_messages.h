#pragma once

#include <cstdint>
#include <vector>

#include "robot/transport/ends.h"
#include "robot/transport/messages.h"
#include "sim/engine/decider.h"

namespace swarmsmith {

/// The simulator's readings in the format of drivers' messages.

/// All readings that control software may use, for numbered lock-step.
SensesMessage senses_message(const Decider::Question& question, std::int64_t seed);

/// The readings as the drivers' separate messages.
std::vector<ToRobot> driver_messages(const SensorTopics& sensors, SimulatedSenses& senses,
                                     std::int64_t stamp_ns);

/// Time of the run as the stamp of a header: exact for multiples of 10 ms, and never 0, which means
/// no stamp.
std::int64_t stamp_of_time(double time_s);

/// The topics that a world sends by default: neighbours as the simulator finds them. Its scan
/// includes everything that the lidar hits, walls too, while its neighbours come only from the
/// turrets of the others: control software that finds neighbours in the scan may find different
/// ones.
SensorTopics world_topics();

}  // namespace swarmsmith
