#include "irace_core/files/command_line_text.h"

namespace swarmsmith {

std::string value_text(const ParameterSpace& space, std::size_t parameter, double value) {
  return space.is_numeric(parameter) ? to_fixed_text(value) : space.scalar(parameter, value).text;
}

std::string command_line_text(const ParameterSpace& space, const Configuration& configuration) {
  std::string text;
  bool first = true;
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    if (!first) text += ' ';
    first = false;
    text += space[i].switch_text + value_text(space, i, configuration[i]);
  }
  return text;
}

std::string aclib_text(const ParameterSpace& space, const Configuration& configuration) {
  std::string text;
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    const std::string value = space.is_numeric(i) ? to_text(Scalar::real(configuration[i]))
                                                  : space.scalar(i, configuration[i]).text;
    text += (text.empty() ? "-" : " -") + space[i].switch_text + " " + value;
  }
  return text;
}

}  // namespace swarmsmith
