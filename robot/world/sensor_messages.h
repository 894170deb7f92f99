#pragma once

#include "robot/transport/ends.h"
#include "robot/transport/messages.h"
#include "sim/engine/decider.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// What the simulator senses, as drivers send it.

/// All that control software may read, for lock-step by number.
SensesMessage senses_message(const Decider::Question& question, std::int64_t seed);

RangesMessage ranges_message(Senses& senses);
GroundColorMessage ground_color_message(Senses& senses);
NeighboursMessage neighbours_message(Senses& senses);
LightMessage light_message(Senses& senses);
ScanMessage scan_message(SimulatedSenses& senses);
ImuMessage imu_message(SimulatedSenses& senses);
OdometryMessage odometry_message(SimulatedSenses& senses);

/// Time of the run as a header's stamp: exact for instants of 10 ms, and never 0, which is no
/// stamp.
std::int64_t stamp_of_time(double time_s);

/// Which sensors a world sends with this profile. A lidar's scan is sent as such, unless the
/// profile misses neighbours, which a scan cannot say.
SensorTopics topics_of(const Profile& profile);

}  // namespace swarmsmith
