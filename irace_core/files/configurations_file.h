#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// Reads a table of configurations, in the order of the file (irace facts, 23.4). The first line
/// has the names of the parameters; fixed parameters may be left out; NA and <NA> mean inactive.
/// Reals are rounded to the digits of the space. In errors, `where` is file:line:column, and the
/// message gives the number of the configuration, the parameter and the reason. Forbidden
/// configurations are read like others.
Expected<std::vector<Configuration>> parse_configurations_file(const IraceText& source,
                                                               const ParameterSpace& space);

/// The same table, from which the same configurations are read back. If the format cannot hold a
/// value, the error names it.
Expected<std::string> print_configurations_file(const ParameterSpace& space,
                                                std::span<const Configuration> configurations);

}  // namespace swarmsmith
