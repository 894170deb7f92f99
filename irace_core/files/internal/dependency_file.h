#pragma once

#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/irace_text.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// Puts the bounds of a dependency file, as AutoMoDe's patched irace reads it, into the parameters:
/// each line is `name (lower|upper)`, where each side is an expression or empty. The repositories
/// of AutoMoDe contain such files (`N0x0 (|NumStates-1)`). It is not publicly known how the patch
/// treats a bound outside the parameter file's domain; here the new bound replaces the old one.
Expected<void> apply_dependency_file(const IraceText& source, std::vector<Parameter>& parameters,
                                     std::vector<Error>& warnings);

}  // namespace swarmsmith::irace
