#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// Puts the bounds of a dependency file, as AutoMoDe's patched irace reads it, into the parameters:
/// `name (lower|upper)` a line, each side an expression or empty. Such files are public in the
/// repositories of AutoMoDe (`N0x0 (|NumStates-1)`); how the patch treats a bound that lies outside
/// the parameter file's is not: here the new bound takes the old one's place.
Expected<void> apply_dependency_file(const IraceText& source, std::vector<Parameter>& parameters,
                                     std::vector<Error>& warnings);

}  // namespace swarmsmith::irace
