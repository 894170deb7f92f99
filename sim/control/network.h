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

/// What a network reads: four projections of a vector are on 45, 135, 225 and 315 degrees from the
/// robot's head, and what points away counts 0. All inputs are in [0, 1]; the last one is a bias of
/// 1 (docs/methods.md).
enum class NetworkInputs {
  Rvr,      ///< 4 obstacles, 3 colour channels of the floor, count, 4 neighbours, bias
  RvrGray,  ///< the same with the floor's grey level in place of its colour
  Rm12,     ///< 4 obstacles, 4 light, floor in 3 levels, count, 4 neighbours, bias
  Rm11,     ///< 8 proximity, 8 light, 3 times the floor in 3 levels, count, 4 neighbours, bias
};

inline constexpr std::size_t kWheels = 2;
/// Weights of the search space are within these.
inline constexpr double kMostWeight = 5;

/// `rvr`, `rvr-gray`, `rm1.2` or `rm1.1`.
std::string_view name_of(NetworkInputs inputs);
std::optional<NetworkInputs> network_inputs_from(std::string_view name);
/// 13, 11, 15 or 25, the bias included.
std::size_t input_count(NetworkInputs inputs);
/// Short names of the inputs, in order, for pictures and tables.
std::vector<std::string> input_names(NetworkInputs inputs);

/// EvoStick's control software: a feed-forward network without a hidden layer and without memory
/// (Francesca et al., Swarm Intelligence 8(2), 2014).
struct Network {
  NetworkInputs inputs = NetworkInputs::Rvr;
  /// Of the left wheel, one an input, then of the right wheel.
  std::vector<double> weights;

  friend bool operator==(const Network&, const Network&) = default;
};

/// What is wrong with the network, if anything: another number of weights than its inputs need, one
/// that is not a finite number, inputs of sensors that the flavour lacks.
std::optional<Error> check(const Network& network, const Flavour& flavour);

/// Reads `--network rvr --weights -1.25,0.5,...`. `where` of errors is as of parse_machine.
Expected<Network> parse_network(std::string_view text, const Flavour& flavour);
/// The canonical text: each weight in its shortest form that reads back to the same value. Throws
/// std::invalid_argument when the network does not fit the flavour.
std::string print_network(const Network& network, const Flavour& flavour);

/// The inputs of one cycle, in order; the first `input_count` of them.
inline constexpr std::size_t kMostInputs = 25;
using InputValues = std::array<double, kMostInputs>;
InputValues network_inputs(NetworkInputs set, Senses& senses, const Flavour& flavour);

/// A running network. It asks all its sensors in each cycle.
class NetworkControl {
 public:
  /// `network` and `flavour` must outlive the object.
  NetworkControl(const Network& network, const Flavour& flavour)
      : network_(&network), flavour_(&flavour) {}

  /// Each wheel turns at V tanh(2.4621365 s), s the weighted sum of the inputs.
  Command step(Senses& senses) const;

  /// Always 0: it has no states.
  static int state() { return 0; }
  static std::uint64_t drawn() { return 0; }

 private:
  const Network* network_;
  const Flavour* flavour_;
};

}  // namespace swarmsmith
