#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/control/readings.h"

namespace swarmsmith {

struct Flavour;

/// The inputs of a network. A vector has four projections, on the directions at 45, 135, 225 and
/// 315 degrees from the robot's head; negative projections count as 0. All inputs are in [0, 1];
/// the last one is a bias of 1 (docs/methods.md).
enum class NetworkInputs {
  Rvr,      ///< 4 obstacles, 3 colour channels of the floor, count, 4 neighbours, bias
  RvrGray,  ///< the same with the floor's grey level instead of its colour
  Rm12,     ///< 4 obstacles, 4 light, floor in 3 levels, count, 4 neighbours, bias
  Rm11,     ///< 8 proximity, 8 light, the floor in 3 levels 3 times, count, 4 neighbours, bias
};

inline constexpr std::size_t kWheels = 2;
/// The weights of the search space are between -5 and 5.
inline constexpr double kMostWeight = 5;

/// `rvr`, `rvr-gray`, `rm1.2` or `rm1.1`.
std::string_view name_of(NetworkInputs inputs);
std::optional<NetworkInputs> network_inputs_from(std::string_view name);
/// 13, 11, 15 or 25, the bias included.
std::size_t input_count(NetworkInputs inputs);
/// Short names of the inputs, in order, for figures and tables.
std::vector<std::string> input_names(NetworkInputs inputs);

/// EvoStick's control software: a feed-forward network without a hidden layer and without memory
/// (Francesca et al., Swarm Intelligence 8(2), 2014).
struct Network {
  NetworkInputs inputs = NetworkInputs::Rvr;
  /// The weights of the left wheel, one per input, then the weights of the right wheel.
  std::vector<double> weights;

  friend bool operator==(const Network&, const Network&) = default;
};

/// The error in the network, if there is one: the number of weights does not match the inputs, a
/// weight is not finite, or the inputs need sensors that the flavour does not use.
std::optional<Error> check(const Network& network, const Flavour& flavour);

/// Reads `--network rvr --weights -1.25,0.5,...`. `where` of errors is as in parse_machine.
Expected<Network> parse_network(std::string_view text, const Flavour& flavour);
/// The canonical text, with each weight in the shortest form that reads back to the same value.
/// Throws std::invalid_argument when the network does not fit the flavour.
std::string print_network(const Network& network, const Flavour& flavour);

/// The inputs of one cycle, in order; only the first `input_count` are used.
inline constexpr std::size_t kMostInputs = 25;
using InputValues = std::array<double, kMostInputs>;
InputValues network_inputs(NetworkInputs set, Senses& senses, const Flavour& flavour);

/// A running network. It reads all its sensors in each cycle.
class NetworkControl {
 public:
  /// `network` and `flavour` must outlive the object.
  NetworkControl(const Network& network, const Flavour& flavour)
      : network_(&network), flavour_(&flavour) {}

  /// Each wheel turns at V tanh(2.4621365 s), where s is the weighted sum of the inputs.
  Command step(Senses& senses) const;

  /// Always 0: a network has no states.
  static int state() { return 0; }
  static std::uint64_t drawn() { return 0; }

 private:
  const Network* network_;
  const Flavour* flavour_;
};

}  // namespace swarmsmith
