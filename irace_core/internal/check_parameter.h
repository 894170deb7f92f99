#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// The bounds of a domain that are expressions; none for choices and constants.
std::vector<const Expression*> bound_expressions(const Domain& domain);

/// The values of a categorical or ordinal domain; none for numeric ones.
std::span<const std::string> choice_values(const Domain& domain);

/// The domain of a numeric parameter with constant bounds, an empty one for choices; nothing when
/// it depends on other parameters.
std::optional<Interval> constant_interval(const Domain& domain);

/// Binds condition and bounds to `names`, and turns bounds that mention no parameter into
/// constants. A bound may mention numeric parameters only, and use arithmetic only. `all` are the
/// parameters by the order of `names`.
Expected<void> bind_parameter(Parameter& parameter, std::span<const std::string> names,
                              std::span<const Parameter> all);

/// Whether a constant bound of a real survives rounding to that many digits, and does not vanish
/// (irace facts, 23.2).
bool fits_digits(double bound, int digits);
/// How many the constant bounds of all reals need, `digits` at least.
int digits_needed(std::span<const Parameter> parameters, int digits);

/// Whether a bound of an integer is one that doubles hold exactly, with all below it.
Expected<void> check_whole(double bound, const std::string& name);

/// What can be said of a bound parameter alone: its name, its values or its constant bounds.
Expected<void> check_parameter(const Parameter& parameter, int digits);

}  // namespace swarmsmith::irace
