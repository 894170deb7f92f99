#include "sim/control/network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "base/assert.h"
#include "base/math.h"
#include "sim/control/flavour.h"
#include "sim/control/internal/fields.h"
#include "sim/control/internal/genome.h"
#include "sim/control/internal/module_text.h"

namespace swarmsmith {
namespace {

constexpr std::array kAllInputs = {NetworkInputs::Rvr, NetworkInputs::RvrGray, NetworkInputs::Rm12,
                                   NetworkInputs::Rm11};

/// Slope of the output sigmoid (NEAT 1.2.1; docs/methods.md).
constexpr double kSlope = 4.924273;

/// Diagonals at 45, 135, 225 and 315 degrees.
constexpr std::array<Vector2, 4> kDiagonals = {{{kSqrtHalf, kSqrtHalf},
                                                {-kSqrtHalf, kSqrtHalf},
                                                {-kSqrtHalf, -kSqrtHalf},
                                                {kSqrtHalf, -kSqrtHalf}}};

/// Appends inputs one by one.
struct InputList {
  InputValues values{};
  std::size_t count = 0;

  void add(double value) { values[count++] = value; }
};

void add_projections(const Vector2& vector, InputList& inputs) {
  for (const Vector2& diagonal : kDiagonals)
    inputs.add(std::max(0.0, vector.x * diagonal.x + vector.y * diagonal.y));
}

/// The vector, shortened to length 1 if it is longer.
Vector2 cut(const Vector2& vector) {
  const double length = std::sqrt(vector.x * vector.x + vector.y * vector.y);
  if (length <= 1) return vector;
  return {vector.x / length, vector.y / length};
}

/// tanh(x / 2), which is 2 / (1 + e^-x) - 1.
double tanh_half(double x) {
  return 2 / (1 + exp(-x)) - 1;
}

/// tanh(n / 2) for a number of neighbours; a table holds the values for small swarms.
double count_input(std::size_t count) {
  static const auto kFew = [] {
    std::array<double, 32> values{};
    for (std::size_t n = 0; n < values.size(); ++n)
      values[n] = tanh_half(static_cast<double>(n));
    return values;
  }();
  return count < kFew.size() ? kFew[count] : tanh_half(static_cast<double>(count));
}

/// The sum over neighbours of 1 / (1 + d) in their directions, scaled so that its length l becomes
/// tanh(l / 2).
Vector2 neighbour_vector(std::span<const Neighbour> neighbours, double per_metre) {
  Vector2 sum;
  for (const Neighbour& neighbour : neighbours) {
    const double strength = 1 / (1 + per_metre * neighbour.distance_m);
    sum.x += strength * neighbour.direction_x;
    sum.y += strength * neighbour.direction_y;
  }
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y);
  if (length == 0) return {};
  const double factor = tanh_half(length) / length;
  return {sum.x * factor, sum.y * factor};
}

constexpr double kMostGray = 255'000;  ///< in thousandths of 0..255
constexpr double kMostColor = 255;

void add_floor(NetworkInputs set, const Rgb& color, const FloorModel& model, InputList& inputs) {
  switch (set) {
    case NetworkInputs::Rvr:
      for (const std::uint8_t channel : {color.r, color.g, color.b})
        inputs.add(static_cast<double>(channel) / kMostColor);
      return;
    case NetworkInputs::RvrGray:
      inputs.add(static_cast<double>(gray_level(color)) / kMostGray);
      return;
    case NetworkInputs::Rm12:
    case NetworkInputs::Rm11:
      break;
  }
  const int gray = gray_level(color);
  double level = 0.5;
  if (model.black.contains(gray)) level = 0;
  if (model.white.contains(gray)) level = 1;
  inputs.add(level);
}

/// Adds the readings of the single sensors of both rings.
void add_strengths(Senses& senses, InputList& inputs) {
  for (const double strength : senses.proximity().first<kProximitySensors>())
    inputs.add(strength);
  for (const double strength : senses.light().first<kProximitySensors>())
    inputs.add(strength);
}

/// Adds the inputs with which all sets end.
InputValues with_neighbours(const Vector2& towards, Senses& senses, NetworkInputs set,
                            InputList& inputs) {
  inputs.add(count_input(static_cast<std::size_t>(senses.neighbour_count())));
  add_projections(towards, inputs);
  inputs.add(1);
  SWARMSMITH_ASSERT(inputs.count == input_count(set), "a set of inputs is whole");
  return inputs.values;
}

/// Whether any module of the flavour reads the ring of light sensors.
bool senses_light(const Flavour& flavour) {
  return flavour.find(Module::Phototaxis) != nullptr;
}

}  // namespace

std::string_view name_of(NetworkInputs inputs) {
  switch (inputs) {
    case NetworkInputs::Rvr:
      return "rvr";
    case NetworkInputs::RvrGray:
      return "rvr-gray";
    case NetworkInputs::Rm11:
      return "rm1.1";
    case NetworkInputs::Rm12:
      break;
  }
  return "rm1.2";
}

std::optional<NetworkInputs> network_inputs_from(std::string_view name) {
  const auto* found =
      std::ranges::find(kAllInputs, name, [](NetworkInputs inputs) { return name_of(inputs); });
  if (found == kAllInputs.end()) return std::nullopt;
  return *found;
}

std::vector<std::string> input_names(NetworkInputs inputs) {
  std::vector<std::string> names;
  if (inputs == NetworkInputs::Rm11) {
    for (const char* ring : {"proximity ", "light "}) {
      for (int i = 0; i < kProximitySensors; ++i)
        names.push_back(ring + std::to_string(i));
    }
  } else {
    names = {"obstacle 45", "obstacle 135", "obstacle 225", "obstacle 315"};
  }
  const auto add = [&names](std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  if (inputs == NetworkInputs::Rvr) add({"floor red", "floor green", "floor blue"});
  if (inputs == NetworkInputs::RvrGray) add({"floor grey"});
  if (inputs == NetworkInputs::Rm11) add({"floor left", "floor centre", "floor right"});
  if (inputs == NetworkInputs::Rm12)
    add({"light 45", "light 135", "light 225", "light 315", "floor level"});
  add({"neighbour count", "neighbour 45", "neighbour 135", "neighbour 225", "neighbour 315",
       "bias"});
  return names;
}

std::size_t input_count(NetworkInputs inputs) {
  switch (inputs) {
    case NetworkInputs::Rvr:
      return 13;
    case NetworkInputs::RvrGray:
      return 11;
    case NetworkInputs::Rm11:
      return 25;
    case NetworkInputs::Rm12:
      break;
  }
  return 15;
}

std::optional<Error> check(const Network& network, const Flavour& flavour) {
  const std::size_t needed = kWheels * input_count(network.inputs);
  if (network.weights.size() != needed) {
    return Error{ErrorKind::BadInput,
                 "a network with the inputs " + std::string(name_of(network.inputs)) + " has " +
                     std::to_string(needed) + " weights, not " +
                     std::to_string(network.weights.size()),
                 "--weights"};
  }
  for (const double weight : network.weights) {
    if (!std::isfinite(weight))
      return Error{ErrorKind::BadInput, "a weight must be a finite number", "--weights"};
  }
  if (network.inputs == NetworkInputs::Rm11 &&
      flavour.obstacles.reading != ObstacleModel::Reading::AsSensed) {
    return Error{ErrorKind::BadInput,
                 "the inputs rm1.1 are strengths of single sensors, which the flavour " +
                     flavour.name + " does not have: use chocolate-epuck, or other inputs",
                 "--network"};
  }
  if (network.inputs == NetworkInputs::Rm12 && !senses_light(flavour)) {
    return Error{ErrorKind::BadInput,
                 "the inputs rm1.2 read light sensors, which the flavour " + flavour.name +
                     " does not have: use another flavour, or the inputs rvr or rvr-gray",
                 "--network"};
  }
  return std::nullopt;
}

Expected<Network> parse_network(std::string_view text, const Flavour& flavour) {
  const std::vector<Token> tokens = tokens_of(text);
  if (tokens.front().text == kGenomeStart) {
    auto genome = read_genome(tokens);
    if (!genome) return genome;
    if (auto error = check(*genome, flavour))
      return Unexpected(error_at(tokens.front(), error->message));
    return genome;
  }
  constexpr std::size_t kList = 3;
  if (tokens.size() > kList + 2 && tokens[kList].text.ends_with(',')) {
    return Unexpected(error_at(tokens[kList + 1],
                               "write the weights as one list, with commas and without spaces"));
  }
  const auto fields = fields_of(tokens);
  if (!fields) return Unexpected(fields.error());
  Block block("", tokens.back());
  for (const Field& field : *fields) {
    if (auto error = block.add(field)) return Unexpected(*error);
  }
  const auto inputs = block.need("network");
  if (!inputs) return Unexpected(inputs.error());
  const auto weights = block.need("weights");
  if (!weights) return Unexpected(weights.error());
  if (auto error = block.check_empty("a network")) return Unexpected(*error);
  Network network;
  const auto set = network_inputs_from(inputs->value.text);
  if (!set) {
    return Unexpected(error_at(inputs->value, "unknown inputs " + quoted(inputs->value.text) +
                                                  "; known are rvr, rvr-gray, rm1.2 and rm1.1"));
  }
  network.inputs = *set;
  std::string_view rest = weights->value.text;
  while (true) {
    const std::size_t comma = rest.find(',');
    double weight = 0;
    if (!read_number(rest.substr(0, comma), weight)) {
      return Unexpected(
          error_at(weights->value, "weight " + std::to_string(network.weights.size() + 1) +
                                       " is not a number: " + quoted(rest.substr(0, comma))));
    }
    network.weights.push_back(weight);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (auto error = check(network, flavour)) {
    const bool is_input = error->where == "--network";
    return Unexpected(error_at(is_input ? inputs->value : weights->value, error->message));
  }
  return network;
}

std::string print_network(const Network& network, const Flavour& flavour) {
  if (const auto error = check(network, flavour)) throw std::invalid_argument(to_string(*error));
  std::string weights;
  for (const double weight : network.weights)
    weights += (weights.empty() ? "" : ",") + shortest(weight);
  std::string text;
  append_switch(text, "network", "", name_of(network.inputs));
  append_switch(text, "weights", "", weights);
  return text;
}

InputValues network_inputs(NetworkInputs set, Senses& senses, const Flavour& flavour) {
  InputList inputs;
  const std::span<const Neighbour> neighbours = senses.neighbours();
  // Computed before the other sensors are read, because its chain of operations is the longest. The
  // e-puck's programs use centimetres (docs/methods.md), the other inputs metres.
  const Vector2 towards =
      neighbour_vector(neighbours, set == NetworkInputs::Rm11 ? flavour.neighbours.per_metre : 1);
  if (set == NetworkInputs::Rm11) {
    add_strengths(senses, inputs);
    for (int i = 0; i < 3; ++i)
      add_floor(set, senses.ground_color(), flavour.floor, inputs);
    return with_neighbours(towards, senses, set, inputs);
  }
  const bool counts = flavour.obstacles.neighbours_as_obstacles;
  add_projections(
      cut(obstacle_vector(senses.proximity(), counts ? neighbours : std::span<const Neighbour>(),
                          flavour.obstacles)),
      inputs);
  if (set == NetworkInputs::Rm12)
    add_projections(cut(light_vector(senses.light(), flavour.light)), inputs);
  add_floor(set, senses.ground_color(), flavour.floor, inputs);
  return with_neighbours(towards, senses, set, inputs);
}

Command NetworkControl::step(Senses& senses) const {
  const InputValues inputs = network_inputs(network_->inputs, senses, *flavour_);
  const std::size_t count = input_count(network_->inputs);
  std::array<double, kWheels> speeds{};
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
      sum += network_->weights[wheel * count + i] * inputs[i];
    speeds[wheel] = flavour_->speed_mps * tanh_half(kSlope * sum);
  }
  return {speeds[0], speeds[1]};
}

}  // namespace swarmsmith
