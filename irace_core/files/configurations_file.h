#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// Reads a table of configurations, in the file's order (irace facts, 23.4): the first line has the
/// parameters' names, fixed ones may be left out, NA and <NA> are inactive. Reals are rounded to
/// the digits of the space. Errors: `where` is file:line:column; the message has the
/// configuration's number, the parameter and the reason. Forbidden configurations are read like
/// others.
Expected<std::vector<Configuration>> parse_configurations_file(const IraceText& source,
                                                               const ParameterSpace& space);

/// The same table, which reads back as the same configurations. An error names a value that the
/// format cannot hold.
Expected<std::string> print_configurations_file(const ParameterSpace& space,
                                                std::span<const Configuration> configurations);

}  // namespace swarmsmith
