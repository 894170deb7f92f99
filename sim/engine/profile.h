#pragma once

#include <string>
#include <vector>

#include "base/rng.h"
#include "sim/control/reference_model.h"
#include "sim/mission/colors.h"
#include "sim/mission/pose.h"

namespace swarmsmith {

/// How the simulated robot's sensors and actuators fall short of ideal ones: data, one struct a
/// device. Standard deviations (sd) and half-widths are in the reading's unit. Numbers of the
/// built-in profiles and their sources stand in sim/files/profiles.

/// Who solves contacts between robots and with walls; each checks the other.
enum class ContactModel {
  Exact,  ///< our own, for square robots in a convex arena; elsewhere Box2D takes over
  Box2d,
};

/// Eight rays (thesis 4.2.9, 7.1). A reading is a phantom, whatever is there; else a hit may be
/// missed; else a distance is misjudged, and the limits hold again.
struct ProximitySensing {
  double range_m = kProximityRange_m;  ///< R: beyond it a reading is +infinity
  double sd_m = 0;                     ///< normal noise on finite distances
  double scale_sd = 0;                 ///< finite distances times N(1, scale_sd)
  double largest_miss_rate =
      0;                    ///< each sensor's rate of misses, drawn for the run from U(0, this)
  double phantom_rate = 0;  ///< of the readings that are uniform in [0.05 m, R] instead
  double half_width = 0;    ///< of the uniform noise on strengths
  bool touch_is_nothing = false;  ///< what is too near to be measured reads as nothing: +infinity

  friend bool operator==(const ProximitySensing&, const ProximitySensing&) = default;
};

/// RGB of the floor (thesis 4.2.1, 3.2): bias and noise are added, rounded, clamped, then labelled.
struct GroundColorSensing {
  double sd = 0;          ///< normal noise a channel
  double bias_sd = 0;     ///< of the normal bias that a robot has on all channels for the run
  double half_width = 0;  ///< of the uniform noise on grey levels in [0, 1], where points vote
  bool labeler = false;   ///< the nearest label takes the reading's place (thesis eq. 3.1, 3.2)
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

/// Who is near (thesis 5.1, 7.1).
struct NeighbourSensing {
  enum class Source {
    Camera,  ///< omnidirectional, sees each robot's centre
    Lidar,   ///< clusters of lidar rays that meet the others' turrets
  };
  Source source = Source::Camera;
  double miss_rate = 0;       ///< a neighbour is missed in a cycle
  double weak_share = 0;      ///< probability that a robot has trouble for the whole run
  double weak_miss_rate = 0;  ///< then this is its rate
  /// They are looked for at beats of so many sub-steps, and known until the next one; 0: in each
  /// control cycle. When the first beat is, is drawn for robot and run.
  int every_sub_steps = 0;

  friend bool operator==(const NeighbourSensing&, const NeighbourSensing&) = default;
};

/// When a robot acts (thesis 7.1).
struct ControlTiming {
  /// Delay of a command until it acts, with its probability; drawn for each command. Order is kept:
  /// a late command delays those after it. Empty: at once. Probabilities sum to 1.
  struct Delay {
    int sub_steps = 0;  ///< of 10 ms
    double probability = 0;

    friend bool operator==(const Delay&, const Delay&) = default;
  };
  std::vector<Delay> delays;
  /// A robot's control period is 0.1 s times a factor that is drawn for the run from this interval,
  /// times 1 + U(-jitter, jitter) for each cycle. Scores are taken every 0.1 s all the same, and
  /// nothing moves within 10 ms: several cycles of less happen at one place.
  double least_period = 1;
  double most_period = 1;
  double jitter = 0;
  /// The driver has a timer of so many sub-steps; at its beats it reads the ground's colour, which
  /// holds until the next one, and then sends the last command that it was given before. 0: colours
  /// are read in each control cycle, commands are sent at once. When the first beat is, is drawn
  /// for robot and run (ros facts, section 1.3).
  int driver_sub_steps = 0;

  friend bool operator==(const ControlTiming&, const ControlTiming&) = default;
};

/// What the treads take.
struct Treads {
  double step_mps = 0;  ///< commanded speeds are rounded to multiples of it; 0: not at all
  /// Each speed is multiplied by 1 + N(0, sd), anew in each cycle.
  double sd = 0;
  /// Treads slip: a robot goes, and turns, so much of what is commanded. Drawn for the run
  /// from N(way, way_sd) and N(turn, turn_sd), not below 0. What it senses of its own motion is
  /// that of treads that do not slip.
  double way = 1;
  double way_sd = 0;
  double turn = 1;
  double turn_sd = 0;

  friend bool operator==(const Treads&, const Treads&) = default;
};

/// What of a robot the score sees (thesis 7.3).
struct TrackedPoint {
  Point tag;                ///< place of the tag in the robot's frame, metres
  bool scores_tag = false;  ///< else the centre

  friend bool operator==(const TrackedPoint&, const TrackedPoint&) = default;
};

/// A number of a profile that differs from run to run: drawn from the interval for each robot and
/// run, or once for a run.
struct FieldRange {
  std::string field;  ///< device and key, "treads.sd"
  double least = 0;
  double most = 0;
  bool of_run = false;

  friend bool operator==(const FieldRange&, const FieldRange&) = default;
};

struct Profile {
  std::string name;
  ContactModel contacts = ContactModel::Exact;
  /// Proximity, neighbours (or the scan that they come from) and commands are rounded to float32,
  /// as on the topics of the robot's drivers.
  bool float32_wire = false;
  ProximitySensing proximity;
  GroundColorSensing ground_color;
  LightSensing light;
  LidarSensing lidar;
  NeighbourSensing neighbours;
  ControlTiming timing;
  Treads treads;
  TrackedPoint tracking;
  /// Each of a field of its own, which has `least` of it above.
  std::vector<FieldRange> ranges;

  friend bool operator==(const Profile&, const Profile&) = default;
};

/// The profile of one robot in a run: its ranges are drawn, and gone. `run` is the stream of the
/// evaluation.
Profile drawn_profile(const Profile& profile, const Rng& run, int robot);

}  // namespace swarmsmith
