#include "coordinator/campaign/network_space.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

Expected<ParameterSpace> network_space(const Method& method, int digits) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 1; i <= kWheels * input_count(method.inputs); ++i) {
    const std::string name = "w" + std::to_string(i);
    parameters.push_back(
        {name, "--" + name + " ", Real{-method.most_weight, method.most_weight}, std::nullopt});
  }
  return ParameterSpace::make(std::move(parameters), {}, digits);
}

Network to_network(const Method& method, const Configuration& configuration) {
  Network network{.inputs = method.inputs, .weights = {}};
  network.weights.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    network.weights.push_back(configuration[i]);
  return network;
}

}  // namespace swarmsmith
