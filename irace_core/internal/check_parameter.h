#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// The expressions among the bounds of a domain; none for categorical and ordinal domains and
/// constant bounds.
std::vector<const Expression*> bound_expressions(const Domain& domain);

/// The values of a categorical or ordinal domain; none for numeric ones.
std::span<const std::string> choice_values(const Domain& domain);

/// The domain of a numeric parameter with constant bounds, an empty interval for categorical and
/// ordinal ones; nothing for a dependent domain.
std::optional<Interval> constant_interval(const Domain& domain);

/// Binds condition and bounds to `names`, and turns bounds that mention no parameter into
/// constants. A bound may only mention numeric parameters and only use arithmetic. `all` are the
/// parameters in the order of `names`.
Expected<void> bind_parameter(Parameter& parameter, std::span<const std::string> names,
                              std::span<const Parameter> all);

/// Whether a constant bound of a real keeps its value when rounded to `digits` decimals, and does
/// not become zero (irace facts, 23.2).
bool fits_digits(double bound, int digits);
/// The number of decimals that the constant bounds of all reals need, at least `digits`.
int digits_needed(std::span<const Parameter> parameters, int digits);

/// Checks that doubles represent the bound of an integer, and all smaller whole numbers, exactly.
Expected<void> check_whole(double bound, const std::string& name);

/// Checks a bound parameter without the others: its name, and its values or constant bounds.
Expected<void> check_parameter(const Parameter& parameter, int digits);

}  // namespace swarmsmith::irace
