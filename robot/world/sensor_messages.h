#pragma once

#include <cstdint>
#include <vector>

#include "robot/transport/ends.h"
#include "robot/transport/messages.h"
#include "sim/engine/decider.h"

namespace swarmsmith {

/// What the simulator senses, as drivers send it.

/// All that control software may read, for lock-step by number.
SensesMessage senses_message(const Decider::Question& question, std::int64_t seed);

/// The readings as the drivers' own messages.
std::vector<ToRobot> driver_messages(const SensorTopics& sensors, SimulatedSenses& senses,
                                     std::int64_t stamp_ns);

/// Time of the run as a header's stamp: exact for instants of 10 ms, and never 0, which is not a
/// stamp.
std::int64_t stamp_of_time(double time_s);

/// What a world sends unless told otherwise: neighbours as the simulator finds them. Its scan has
/// all that the lidar meets, walls too, while its neighbours come from the others' turrets alone:
/// control software that finds neighbours in the scan may see others.
SensorTopics world_topics();

}  // namespace swarmsmith
