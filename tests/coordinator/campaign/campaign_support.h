#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "coordinator/campaign/campaign_file.h"
#include "irace_core/parameter_space.h"
#include "tests/support/checks.h"

namespace swarmsmith {

/// The shortest campaign file, with room for what a test adds: more [campaign] keys, more
/// [[mission]] keys, and so on.
struct FileText {
  std::string campaign = {};
  std::string mission = "name = \"aggregation\"\n";
  std::string method = "name = \"watermelon\"\n";
  std::string race = "max_experiments = 2_000\n";
  std::string rest = {};

  std::string text() const {
    return "format = 1\n[campaign]\n" + campaign + "[[mission]]\n" + mission + "[[method]]\n" +
           method + "[race]\n" + race + rest;
  }
};

inline CampaignOrErrors parse(const std::string& text) {
  return parse_campaign(text, "in/x.toml");
}

inline Campaign parsed(const std::string& text) {
  return value_of(parse(text));
}

/// The errors as lines "file:line:column: sentence".
inline std::vector<std::string> complaints(const std::string& text) {
  return complaints_of(parse(text));
}

/// Every active parameter uniform in its domain, reals with two decimals.
inline Configuration random_configuration(const ParameterSpace& space, Rng& rng) {
  Assignment values(space);
  for (const std::size_t i : space.hierarchy_order()) {
    if (!space.is_active(i, values)) continue;
    if (!space.is_numeric(i)) {
      values.set(i, static_cast<double>(rng.below(space.value_count(i))));
      continue;
    }
    const Interval interval = space.interval(i, values)->value();
    const bool whole = std::holds_alternative<Integer>(space[i].domain);
    values.set(
        i, whole ? static_cast<double>(rng.uniform_int(static_cast<std::int64_t>(interval.lower),
                                                       static_cast<std::int64_t>(interval.upper)))
                 : std::round(rng.uniform(interval.lower, interval.upper) * 100) / 100);
  }
  return values.configuration();
}

}  // namespace swarmsmith
