#include "irace_core/internal/sampling.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/math.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith::irace {
namespace {

/// One batch of uniform configurations without duplicates and forbidden ones.
Expected<std::vector<Configuration>> sample_batch(const ParameterSpace& space,
                                                  const ForbiddenList& forbidden, std::int64_t size,
                                                  Rng& rng) {
  std::vector<Configuration> batch;
  std::set<std::uint64_t> seen;  // digests of 64 bits: equal ones are compared in full
  for (std::int64_t i = 0; i < size; ++i) {
    auto sampled = sample_uniform(space, rng);
    if (!sampled) return Unexpected(sampled.error());
    const bool is_new = seen.insert(sampled->digest()).second ||
                        std::find(batch.begin(), batch.end(), *sampled) == batch.end();
    if (is_new && !forbidden.contains(*sampled)) batch.push_back(std::move(*sampled));
  }
  return batch;
}

}  // namespace

bool is_logarithmic(const Domain& domain) {
  if (const auto* whole = std::get_if<Integer>(&domain)) return whole->log;
  if (const auto* real = std::get_if<Real>(&domain)) return real->log;
  return false;
}

bool is_whole(const Domain& domain) {
  return std::holds_alternative<Integer>(domain);
}

double to_domain(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                 double drawn) {
  if (is_whole(space[parameter].domain)) {
    return std::clamp(std::floor(drawn), domain.lower, domain.upper);
  }
  const double rounded = round_to_digits(drawn, space.digits());
  return std::clamp(rounded, domain.lower, domain.upper);
}

double quantile_value(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                      double p) {
  if (!space.is_numeric(parameter)) {
    const auto count = static_cast<double>(space.value_count(parameter));
    return std::min(count - 1, std::floor(p * count));
  }
  const double upper = is_whole(space[parameter].domain) ? domain.upper + 1 : domain.upper;
  double value = p * (upper - domain.lower) + domain.lower;
  if (is_logarithmic(space[parameter].domain)) {
    const double low = log(domain.lower);
    value = std::clamp(exp(low + (log(upper) - low) * p), domain.lower, upper);
  }
  return to_domain(space, parameter, domain, value);
}

Expected<Configuration> sample_uniform(const ParameterSpace& space, Rng& rng) {
  return sample_configuration(space, [&](std::size_t parameter, const Interval& domain) {
    return quantile_value(space, parameter, domain, rng.uniform());
  });
}

bool ForbiddenList::contains(const Configuration& configuration) const {
  for (const Configuration& rejected : rejected_) {
    bool same = true;
    for (std::size_t i = 0; same && i < rejected.size(); ++i) {
      same = !rejected.is_active(i) || rejected[i] == configuration[i];
    }
    if (same) return true;
  }
  return space_->is_forbidden(configuration);
}

Expected<std::vector<Configuration>> sample_initial(const ParameterSpace& space,
                                                    const ForbiddenList& forbidden,
                                                    std::int64_t wanted, Rng& rng) {
  auto batch = sample_batch(space, forbidden, wanted, rng);
  if (!batch) return batch;
  const auto have = static_cast<std::int64_t>(batch->size());
  if (have < wanted) {
    const auto n = static_cast<double>(wanted);
    const auto missing = static_cast<double>(wanted - have);
    const double larger = std::ceil(n + missing * (2 - static_cast<double>(have) / n));
    const auto size = std::max(static_cast<std::int64_t>(larger),
                               std::min<std::int64_t>(5 * space.variable_count(), 100));
    batch = sample_batch(space, forbidden, size, rng);
    if (!batch) return batch;
  }
  if (batch->empty()) {
    return bad_input(
        "no configuration that is not forbidden was found: the constraints are too strict");
  }
  if (static_cast<std::int64_t>(batch->size()) > wanted) {
    batch->resize(static_cast<std::size_t>(wanted));
  }
  return batch;
}

}  // namespace swarmsmith::irace
