#pragma once

#include <string>
#include <vector>

#include "base/rng.h"
#include "sim/control/reference_model.h"
#include "sim/mission/colors.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// The errors of the simulated robot's sensors and actuators, compared with ideal ones: data, one
/// struct per device. Standard deviations (sd) and half-widths are in the unit of the reading. The
/// values of the built-in profiles and their sources are in sim/files/profiles.

/// The solver of contacts between robots and with walls; each of the two serves as a check of the
/// other.
enum class ContactModel {
  Exact,  ///< this project's solvers; Box2D for shapes and arenas that they do not support
  Box2d,
};

/// Eight rays (thesis 4.2.9, 7.1). A reading may be a phantom, whatever the distance; otherwise a
/// hit may be missed; otherwise errors are added to the distance, and the limits apply again.
struct ProximitySensing {
  double range_m = kProximityRange_m;  ///< R: beyond it a reading is +infinity
  double sd_m = 0;                     ///< normal noise on finite distances
  double scale_sd = 0;                 ///< finite distances are multiplied by N(1, scale_sd)
  double largest_miss_rate = 0;   ///< each sensor's miss rate is drawn for the run from U(0, this)
  double phantom_rate = 0;        ///< rate of readings that are uniform in [0.05 m, R] instead
  double half_width = 0;          ///< of the uniform noise on strengths
  bool touch_is_nothing = false;  ///< whether an obstacle too near to be measured reads as
                                  ///< +infinity, like no obstacle

  friend bool operator==(const ProximitySensing&, const ProximitySensing&) = default;
};

/// RGB of the floor (thesis 4.2.1, 3.2): bias and noise are added, then it is rounded, clamped and
/// labelled.
struct GroundColorSensing {
  double sd = 0;          ///< normal noise per channel
  double bias_sd = 0;     ///< of the normal bias that a robot has on all channels throughout the
                          ///< run
  double half_width = 0;  ///< of the uniform noise on grey levels in [0, 1], for sensors whose
                          ///< points vote
  bool labeler = false;   ///< whether the nearest label replaces the reading (thesis eq. 3.1, 3.2)
  std::vector<Rgb> labels = default_labels();

  static std::vector<Rgb> default_labels();
  friend bool operator==(const GroundColorSensing&, const GroundColorSensing&) = default;
};

/// The ring of light sensors.
struct LightSensing {
  double half_width = 0;  ///< of the uniform noise on strengths

  friend bool operator==(const LightSensing&, const LightSensing&) = default;
};

/// 719 rays (thesis 4.2.10).
struct LidarSensing {
  double half_width_m = 0;  ///< of the uniform noise

  friend bool operator==(const LidarSensing&, const LidarSensing&) = default;
};

/// Detection of neighbours (thesis 5.1, 7.1).
struct NeighbourSensing {
  enum class Source {
    Camera,  ///< omnidirectional, sees each robot's centre
    Lidar,   ///< clusters of lidar rays that hit the turrets of the others
  };
  Source source = Source::Camera;
  double miss_rate = 0;       ///< probability that a neighbour is missed in a cycle
  double weak_share = 0;      ///< probability that a robot misses more neighbours for the whole run
  double weak_miss_rate = 0;  ///< the miss rate of such a robot
  /// Neighbours are detected at beats, once every this many sub-steps, and the result is kept until
  /// the next beat; 0: in each control cycle. The first beat is drawn per robot and run.
  int every_sub_steps = 0;

  friend bool operator==(const NeighbourSensing&, const NeighbourSensing&) = default;
};

/// The times at which a robot acts (thesis 7.1).
struct ControlTiming {
  /// Delay of a command until it acts, with its probability; drawn for each command. The order is
  /// kept: a late command delays those after it. An empty list means no delay. Probabilities sum to
  /// 1.
  struct Delay {
    int sub_steps = 0;  ///< of 10 ms
    double probability = 0;

    friend bool operator==(const Delay&, const Delay&) = default;
  };
  std::vector<Delay> delays;
  /// A robot's control period is 0.1 s times a factor drawn for the run from this interval, times 1
  /// + U(-jitter, jitter) for each cycle. Scores are still taken every 0.1 s. Bodies move in steps
  /// of 10 ms, so that several shorter cycles happen at the same place.
  double least_period = 1;
  double most_period = 1;
  double jitter = 0;
  /// The driver has a timer with a period of this many sub-steps. At its beats it reads the colour
  /// of the ground, which is kept until the next beat, and then sends the last command that it
  /// received before. 0: colours are read in each control cycle, commands are sent immediately. The
  /// first beat is drawn per robot and run (ros facts, section 1.3).
  int driver_sub_steps = 0;

  friend bool operator==(const ControlTiming&, const ControlTiming&) = default;
};

/// Errors of the treads.
struct Treads {
  double step_mps = 0;  ///< commanded speeds are rounded to multiples of it; 0: no rounding
  /// Each speed is multiplied by 1 + N(0, sd), drawn in each cycle.
  double sd = 0;
  /// Slip of the treads: the fractions of the commanded way and turn that a robot actually moves.
  /// They are drawn for the run from N(way, way_sd) and N(turn, turn_sd), and are at least 0. The
  /// robot's own motion sensors measure as if the treads did not slip.
  double way = 1;
  double way_sd = 0;
  double turn = 1;
  double turn_sd = 0;

  friend bool operator==(const Treads&, const Treads&) = default;
};

/// The point of a robot that the score uses (thesis 7.3).
struct TrackedPoint {
  Point tag;                ///< position of the tag in the robot's frame, metres
  bool scores_tag = false;  ///< whether the score uses the tag; else it uses the centre

  friend bool operator==(const TrackedPoint&, const TrackedPoint&) = default;
};

/// A number of a profile that differs between runs: drawn from the interval for each robot and run,
/// or once per run.
struct FieldRange {
  std::string field;  ///< device and key, such as "treads.sd"
  double least = 0;
  double most = 0;
  bool of_run = false;

  friend bool operator==(const FieldRange&, const FieldRange&) = default;
};

struct Profile {
  std::string name;
  ContactModel contacts = ContactModel::Exact;
  /// Proximity, neighbours (or the scan in which they are found) and commands are rounded to
  /// float32, as on the topics of the robot's drivers.
  bool float32_wire = false;
  ProximitySensing proximity;
  GroundColorSensing ground_color;
  LightSensing light;
  LidarSensing lidar;
  NeighbourSensing neighbours;
  ControlTiming timing;
  Treads treads;
  TrackedPoint tracking;
  /// Each range is for a different field, whose member above holds `least`.
  std::vector<FieldRange> ranges;

  friend bool operator==(const Profile&, const Profile&) = default;
};

/// The profile of one robot in a run: the ranges are replaced by drawn numbers. `run` is the stream
/// of the evaluation.
Profile drawn_profile(const Profile& profile, const Rng& run, int robot);

}  // namespace swarmsmith
