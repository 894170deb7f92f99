#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/clock.h"

namespace swarmsmith {

/// The messages between a robot's control software, its drivers (or a simulated world that replaces
/// them) and the operator. Plain values in SI units, as they were sent: without clamping,
/// resampling or labelling. Robot frame: x forward, y left, angles counter-clockwise.
///
/// `kTopic` is the topic's name in the robot's name space; a message without one is never sent.
/// `kNumbers` are the fields that are sent, in this order (docs/robot-messages.md).

inline constexpr std::size_t kRangeSensors = 8;

/// The arrival time of a message.
struct Arrival {
  TimePoint at{};             ///< time of arrival here, by the steady clock; set by the transport
  std::int64_t stamp_ns = 0;  ///< stamp of its header, by the sender's clock; 0: none
};

/// The proximity sensors, by index. Values as drivers send them: -infinity for too near, +infinity
/// for no obstacle, NaN for a sensor that is off.
struct RangesMessage {
  static constexpr const char* kTopic = "ranges";
  Arrival arrival{};
  std::vector<double> ranges_m{};

  static constexpr std::tuple kNumbers{&RangesMessage::ranges_m};
};

/// The colour of the floor, in the scale of the driver (0 to 255 or 0 to 1).
struct GroundColorMessage {
  static constexpr const char* kTopic = "ground_color";
  Arrival arrival{};
  double r = 0;
  double g = 0;
  double b = 0;

  static constexpr std::tuple kNumbers{&GroundColorMessage::r, &GroundColorMessage::g,
                                       &GroundColorMessage::b};
};

/// One revolution of the lidar: value i was measured at `angle_min_rad` + i *
/// `angle_increment_rad`.
struct ScanMessage {
  static constexpr const char* kTopic = "scan";
  Arrival arrival{};
  double angle_min_rad = 0;
  double angle_max_rad = 0;
  double angle_increment_rad = 0;
  double range_min_m = 0;
  double range_max_m = 0;
  std::vector<double> ranges_m{};  ///< any number of values; 0, NaN and infinity mean no return

  static constexpr std::tuple kNumbers{
      &ScanMessage::angle_min_rad, &ScanMessage::angle_max_rad, &ScanMessage::angle_increment_rad,
      &ScanMessage::range_min_m,   &ScanMessage::range_max_m,   &ScanMessage::ranges_m};
};

/// A robot nearby: distance of its centre and the unit vector towards it in the robot's frame.
struct SeenRobot {
  double distance_m = 0;
  double direction_x = 1;
  double direction_y = 0;
};

/// Robots nearby, from hardware that detects them without a scan.
struct NeighboursMessage {
  static constexpr const char* kTopic = "neighbours";
  Arrival arrival{};
  std::vector<SeenRobot> robots{};

  static constexpr std::tuple kNumbers{&NeighboursMessage::robots};
};

/// Lux along the directions of the proximity sensors, by index.
struct LightMessage {
  static constexpr const char* kTopic = "light";
  Arrival arrival{};
  std::vector<double> lux{};

  static constexpr std::tuple kNumbers{&LightMessage::lux};
};

struct BatteryMessage {
  static constexpr const char* kTopic = "battery";
  Arrival arrival{};
  double voltage_V = 0;
  double charge = 0;  ///< 0 empty to 1 full; NaN if unknown

  static constexpr std::tuple kNumbers{&BatteryMessage::voltage_V, &BatteryMessage::charge};
};

/// The report of the treads' driver on the speeds that it executes: the speeds of the command that
/// it obeys, unchanged, or 0 and 0 if the driver itself stops the treads. It is sent several times
/// a second, even while the robot stands still.
struct DrivenMessage {
  static constexpr const char* kTopic = "driven";
  Arrival arrival{};
  double left_mps = 0;
  double right_mps = 0;
  std::string sender{};  ///< the sender, if the transport knows it

  static constexpr std::tuple kNumbers{&DrivenMessage::left_mps, &DrivenMessage::right_mps};
};

/// Notice that another sender has sent speeds for the treads of this node.
struct RivalMessage {
  Arrival arrival{};
  std::string sender{};
};

/// An order of the operator to all robots: a JSON object, interpreted in robot/runtime.
struct OrderMessage {
  static constexpr const char* kTopic = "order";
  Arrival arrival{};
  std::string text{};
};

/// For numbered lock-step: all readings that control software may use in one cycle, with the bits
/// of the simulator. The node answers with an AnswerMessage; only then the next one is sent.
struct SensesMessage {
  static constexpr const char* kTopic = "senses";
  Arrival arrival{};
  std::int64_t seed = 0;   ///< of the run
  std::int64_t cycle = 0;  ///< from 1, at which a run begins; 0: there are no more runs
  double time_s = 0;       ///< since the start, by the robot's clock
  std::array<double, kRangeSensors> ranges_m{};
  std::array<double, 3> color{};  ///< r, g, b, 0 to 255
  std::array<double, kRangeSensors> light_lux{};
  std::vector<SeenRobot> neighbours{};

  static constexpr std::tuple kNumbers{&SensesMessage::seed,      &SensesMessage::cycle,
                                       &SensesMessage::time_s,    &SensesMessage::ranges_m,
                                       &SensesMessage::color,     &SensesMessage::light_lux,
                                       &SensesMessage::neighbours};
};

/// A problem in the transport, as a sentence: a name that does not resolve, a peer that closed the
/// connection.
struct TroubleMessage {
  std::string text{};
  bool ended = false;  ///< the transport has ended: the receiver must stop
};

/// The messages to a robot's node.
using ToRobot = std::variant<RangesMessage, GroundColorMessage, ScanMessage, NeighboursMessage,
                             LightMessage, BatteryMessage, DrivenMessage, RivalMessage,
                             OrderMessage, SensesMessage, TroubleMessage>;

/// Speeds of the treads over the ground.
struct WheelsMessage {
  static constexpr const char* kTopic = "wheels";
  Arrival arrival{};
  double left_mps = 0;
  double right_mps = 0;
  std::optional<int> state{};  ///< of the machine after the cycle; sent only in lock-step
  std::string sender{};        ///< the sender, if the transport knows it; a driver obeys only one

  static constexpr std::tuple kNumbers{&WheelsMessage::left_mps, &WheelsMessage::right_mps,
                                       &WheelsMessage::state};
};

/// Two LEDs in front, one on each side, one at the back; r, g, b of each, 0 to 255.
struct LedsMessage {
  static constexpr const char* kTopic = "leds";
  Arrival arrival{};
  std::array<double, 15> colors{};

  static constexpr std::tuple kNumbers{&LedsMessage::colors};
};

/// A node sends its state twice a second; after this silence it counts as gone.
inline constexpr Duration kMostSilence = std::chrono::seconds(1);

/// A node's state: a JSON object, defined in robot/runtime.
struct StateMessage {
  static constexpr const char* kTopic = "state";
  Arrival arrival{};
  std::string text{};
};

/// The answer to a SensesMessage, with its seed and cycle.
struct AnswerMessage {
  static constexpr const char* kTopic = "answer";
  Arrival arrival{};
  std::int64_t seed = 0;
  std::int64_t cycle = 0;
  double left_mps = 0;
  double right_mps = 0;
  int state = 0;  ///< of the machine, after the cycle

  static constexpr std::tuple kNumbers{&AnswerMessage::seed, &AnswerMessage::cycle,
                                       &AnswerMessage::left_mps, &AnswerMessage::right_mps,
                                       &AnswerMessage::state};
};

using FromRobot =
    std::variant<WheelsMessage, LedsMessage, StateMessage, AnswerMessage, TroubleMessage>;

template <class Message, class = void>
inline constexpr bool kTravels = false;
template <class Message>
inline constexpr bool kTravels<Message, std::void_t<decltype(Message::kTopic)>> = true;

template <class Message, class = void>
inline constexpr bool kHasSender = false;
template <class Message>
inline constexpr bool kHasSender<Message, std::void_t<decltype(Message::sender)>> = true;

}  // namespace swarmsmith
