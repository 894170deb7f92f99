#include "tests/irace_core/files/random_spaces.h"

#include <array>
#include <cmath>

#include "tests/irace_core/files/random_expressions.h"
#include "tests/support/checks.h"

namespace swarmsmith::testing {
namespace {

std::int64_t below(Rng& rng, int n) {
  return rng.uniform_int(0, n - 1);
}

template <class T, std::size_t n>
const T& pick(Rng& rng, const std::array<T, n>& from) {
  return from[rng.below(n)];
}

std::vector<std::string> some_values(Rng& rng) {
  const std::array<std::string, 16> kValues = {
      "a",  "B2",        "x.y", "-1",  "1e0", "",          "two words", "a,b",
      "NA", "gr\u00fcn", "#1",  "p|q", "(s)", "say \"x\"", "it's",      " lead"};
  std::vector<std::string> all(kValues.begin(), kValues.end());
  rng.shuffle(std::span<std::string>(all));
  all.resize(1 + rng.below(5));
  return all;
}

/// A constant domain that fits the digits.
std::pair<Bound, Bound> constants(Rng& rng, int digits, bool positive) {
  double steps = 1;  // in one
  for (int i = 0; i < digits && i < 6; ++i)
    steps *= 10;
  const double lower = static_cast<double>(rng.uniform_int(positive ? 1 : -500, 500));
  const double upper = lower + static_cast<double>(rng.uniform_int(1, 1000));
  return {lower / steps, upper / steps};
}

Domain random_domain(Rng& rng, int digits, const std::vector<std::string>& numeric) {
  const auto kind = below(rng, 6);
  if (kind == 0) return Categorical{some_values(rng)};
  if (kind == 1) {
    std::vector<std::string> values = some_values(rng);
    values.emplace_back("high");  // numbers alone would have to increase
    return Ordinal{std::move(values)};
  }
  const bool dependent = kind == 2 && !numeric.empty();
  const bool log = !dependent && below(rng, 3) == 0;
  const bool whole = below(rng, 2) == 0;
  auto [lower, upper] = constants(rng, whole ? 0 : digits, log);
  if (dependent) {
    RandomExpressions random(rng, numeric);
    upper = random.bound(1 + static_cast<int>(below(rng, 3)));
    if (below(rng, 2) == 0) lower = random.bound(2);
  }
  if (whole) return Integer{lower, upper, log};
  return Real{lower, upper, log};
}

}  // namespace

ParameterSpace random_space(Rng& rng) {
  const std::array<std::string, 7> kSwitches = {"",         "--x ", "-p",          "--rho  ",
                                                "--a=b#1 ", "a|b ", "--gr\u00fcn "};
  const std::array<std::string, 12> kNames = {"a",   "b.1", "_c", "1d", ".e",        "T",
                                              "min", "if",  "g",  "h",  "NumStates", "k_9"};
  const auto digits = static_cast<int>(rng.uniform_int(1, 15));
  std::vector<std::string> names;
  std::vector<std::string> numeric;
  std::vector<Parameter> parameters;
  const std::size_t count = 2 + rng.below(kNames.size() - 2);
  for (std::size_t i = 0; i < count; ++i) {
    Parameter parameter{kNames[i], pick(rng, kSwitches), random_domain(rng, digits, numeric), {}};
    if (i == 0) parameter.domain = Integer{1.0, 4.0};
    if (!names.empty() && below(rng, 2) == 0) {
      // A constant that is neither TRUE nor FALSE is not a condition.
      do {
        parameter.condition = RandomExpressions(rng, names).any(4);
      } while (parameter.condition->operands().empty() && parameter.condition->name().empty());
    }
    names.push_back(parameter.name);
    const bool is_numeric = std::holds_alternative<Integer>(parameter.domain) ||
                            std::holds_alternative<Real>(parameter.domain);
    if (is_numeric) numeric.push_back(parameter.name);
    parameters.push_back(std::move(parameter));
  }
  std::vector<Expression> forbidden;
  for (std::int64_t i = below(rng, 3); i > 0; --i) {
    Expression clause = RandomExpressions(rng, names).any(4);
    // A line of a file is a comparison, or made of such; the rest is compared with a number.
    const Operation operation = clause.operation();
    const bool is_statement = (operation >= Operation::Not && operation <= Operation::In) ||
                              operation == Operation::IsMissing || operation == Operation::IfElse;
    if (!is_statement)
      clause = Expression::call(Operation::Less, {std::move(clause), Expression::number(0.5)});
    forbidden.push_back(std::move(clause));
  }
  return value_of(ParameterSpace::make(std::move(parameters), std::move(forbidden), digits));
}

std::optional<Configuration> random_configuration(const ParameterSpace& space, Rng& rng) {
  Assignment values(space);
  for (const std::size_t i : space.hierarchy_order()) {
    if (!space.is_active(i, values)) continue;
    if (!space.is_numeric(i)) {
      values.set(i, static_cast<double>(rng.below(space.value_count(i))));
      continue;
    }
    const auto domain = space.interval(i, values);
    if (!domain) return std::nullopt;
    if (!*domain) continue;
    const double at = rng.uniform((*domain)->lower, (*domain)->upper);
    const bool whole = std::holds_alternative<Integer>(space[i].domain);
    values.set(i, whole ? std::floor(at) : (*domain)->lower);
  }
  return values.configuration();
}

}  // namespace swarmsmith::testing
