#include "irace_core/internal/sampling.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith::irace {
namespace {

/// The active parameters with their values.
std::string show(const ParameterSpace& space, const Configuration& configuration) {
  std::string shown;
  for (std::size_t i = 0; i < space.size() && i < configuration.size(); ++i) {
    if (!configuration.is_active(i)) continue;
    const bool is_value =
        space.is_numeric(i) ||
        (configuration[i] >= 0 && configuration[i] < static_cast<double>(space.value_count(i)));
    shown += (shown.empty() ? "" : ", ") + space[i].name + " = " +
             (is_value ? to_text(space.scalar(i, configuration[i])) : "?");
  }
  return shown;
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
  SWARMSMITH_ASSERT(domain.lower <= domain.upper,
                    "an empty domain is an error that was found earlier");
  if (is_whole(space[parameter].domain)) {
    // Each whole number is a cell of width one, up to upper + 1, so that both ends are as probable
    // as the others. upper + 1 itself counts as upper (irace facts, 6.4).
    return std::clamp(std::floor(drawn), domain.lower, domain.upper);
  }
  // Constant bounds have no more than `digits` decimals (irace facts, 6.7). Computed bounds may
  // have more, so that rounding can leave their domain.
  const double rounded = round_to_digits(drawn, space.digits());
  return std::clamp(rounded, domain.lower, domain.upper);
}

/// irace facts, 6.6.
double quantile_value(const ParameterSpace& space, std::size_t parameter, const Interval& domain,
                      double p) {
  SWARMSMITH_ASSERT(p >= 0 && p < 1, "a quantile lies in [0, 1)");
  if (!space.is_numeric(parameter)) {
    const auto count = static_cast<double>(space.value_count(parameter));
    return std::min(count - 1, std::floor(p * count));
  }
  const double upper = is_whole(space[parameter].domain) ? domain.upper + 1 : domain.upper;
  double value = p * (upper - domain.lower) + domain.lower;
  if (is_logarithmic(space[parameter].domain)) {
    const double low = log(domain.lower);
    // The logarithm and exp round, so the result may lie just outside of the domain.
    value = std::clamp(exp(low + (log(upper) - low) * p), domain.lower, upper);
  }
  return to_domain(space, parameter, domain, value);
}

/// irace facts, 8.4: a rejected configuration forbids all that have its active values. An inactive
/// value is NaN and differs from every value.
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

Expected<Configuration> repaired(const ParameterSpace& space, const Repair& repair,
                                 Configuration sampled) {
  if (!repair) return sampled;
  auto changed = repair(sampled);
  if (!changed) return changed;
  // A repair is the user's code, so its result is checked like a given configuration.
  const auto checked =
      changed->size() == space.size()
          ? space.check(*changed)
          : Expected<void>(bad_input("does not have one value for each parameter"));
  if (checked) return changed;
  const Error& error = checked.error();
  return bad_input("the repair made (" + show(space, *changed) + ") of (" + show(space, sampled) +
                       "), which is not a configuration of this space: " +
                       (error.where.empty() ? "" : error.where + ": ") + error.message,
                   "repairConfiguration");
}

InitialSampler::InitialSampler(const ParameterSpace& space, Rng rng)
    : space_(&space), rng_(rng), dimension_(space.size(), 0) {
  std::size_t dimensions = 0;
  for (std::size_t i = 0; i < space.size(); ++i) {
    if (!space.is_fixed(i)) dimension_[i] = dimensions++;
  }
  // Step 1 of irace facts, 5. The largest integer of R is the largest seed.
  constexpr std::int64_t kLargestSeed = 2147483647;
  const auto seed = static_cast<std::uint32_t>(rng_.uniform_int(1, kLargestSeed));
  // With more parameters than the table has dimensions, the configurations are uniform draws (R's
  // irace fails then: irace facts, 25.4).
  if (dimensions == 0 || dimensions > SobolSequence::most_dimensions()) return;
  sequence_.emplace(dimensions, seed);
  point_.resize(dimensions);
}

Expected<Configuration> InitialSampler::next_point() {
  const std::uint32_t index = position_++;
  if (!sequence_) return sample_uniform(*space_, rng_);
  sequence_->point(index, point_);
  // A parameter keeps its coordinate whether others are active or not; the coordinate of an
  // inactive one is not used.
  return sample_configuration(*space_, [&](std::size_t parameter, const Interval& domain) {
    return quantile_value(*space_, parameter, domain, point_[dimension_[parameter]]);
  });
}

Expected<std::vector<Configuration>> InitialSampler::sample(std::int64_t wanted,
                                                            const ForbiddenList& forbidden,
                                                            const Repair& repair) {
  std::vector<Configuration> batch;
  std::int64_t size = wanted;
  for (std::int64_t i = 0; i < size; ++i) {
    auto sampled = next_point();
    // irace facts, 8.5: repair comes before the forbidden test. Two points may become equal by it,
    // so duplicates are found after it.
    if (sampled) sampled = repaired(*space_, repair, std::move(*sampled));
    if (!sampled) return Unexpected(sampled.error());
    if (seen_.insert(sampled->digest()).second && !forbidden.contains(*sampled)) {
      batch.push_back(std::move(*sampled));
    }
    const auto have = static_cast<std::int64_t>(batch.size());
    // irace cuts a larger batch to the wanted number (irace facts, 5); here the rest stays in the
    // sequence for the next call.
    if (have == wanted) break;
    if (i + 1 != wanted) continue;
    // Step 4 of irace facts, 5: a larger batch, once. Its first points are the ones already made,
    // so only the further ones are made.
    const auto n = static_cast<double>(wanted);
    const double larger =
        std::ceil(n + (n - static_cast<double>(have)) * (2 - static_cast<double>(have) / n));
    size = std::max(static_cast<std::int64_t>(larger),
                    std::min(std::int64_t{5} * space_->variable_count(), std::int64_t{100}));
  }
  return batch;
}

}  // namespace swarmsmith::irace

namespace swarmsmith {

Expected<Configuration> sample_uniform(const ParameterSpace& space, Rng& rng) {
  return irace::sample_configuration(space, [&](std::size_t parameter, const Interval& domain) {
    return irace::quantile_value(space, parameter, domain, rng.uniform());
  });
}

}  // namespace swarmsmith
