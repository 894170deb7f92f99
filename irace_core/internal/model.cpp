#include "irace_core/internal/model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "base/math.h"
#include "irace_core/internal/sampling.h"

namespace swarmsmith::irace {
namespace {

void normalise(std::span<double> probabilities) {
  double sum = 0;
  for (const double p : probabilities)
    sum += p;
  SWARMSMITH_ASSERT(sum > 0, "at least one value has a probability above 0");
  for (double& p : probabilities)
    p /= sum;
}

/// The last value gets the remainder of the sum that rounding leaves.
std::size_t draw_choice(std::span<const double> probabilities, Rng& rng) {
  SWARMSMITH_ASSERT(!probabilities.empty(), "a choice has a value");
  double left = rng.uniform();
  for (std::size_t i = 0; i + 1 < probabilities.size(); ++i) {
    left -= probabilities[i];
    if (left < 0) return i;
  }
  return probabilities.size() - 1;
}

bool is_categorical(const Domain& domain) {
  return std::holds_alternative<Categorical>(domain);
}

/// Maps values of a logarithmic domain to [0, 1] and back.
struct LogScale {
  double low;
  double width;

  LogScale(const Interval& domain, bool whole)
      : low(log(domain.lower)), width(log(whole ? domain.upper + 1 : domain.upper) - low) {}
  double to_unit(double value) const { return (log(value) - low) / width; }
  double from_unit(double y) const { return exp(low + width * y); }
};

/// The truncated normal distribution from which a numeric parameter is sampled; for a logarithmic
/// parameter it is on [0, 1].
TruncatedNormal numeric_distribution(const Domain& domain, const ParameterModel& model, double sd,
                                     const Interval& interval) {
  const bool whole = is_whole(domain);
  const double mean = whole ? model.mean + 0.5 : model.mean;
  if (is_logarithmic(domain)) {
    return {LogScale(interval, whole).to_unit(mean), sd, 0, 1};
  }
  return {mean, sd, interval.lower, whole ? interval.upper + 1 : interval.upper};
}

}  // namespace

double initial_sd(const ParameterSpace& space, std::size_t parameter) {
  const Domain& domain = space[parameter].domain;
  if (is_categorical(domain)) return 0;
  if (std::holds_alternative<Ordinal>(domain)) {
    return static_cast<double>(space.value_count(parameter) - 1) / 2;
  }
  const Interval* interval = space.constant_interval(parameter);
  if (is_logarithmic(domain) || interval == nullptr) return 0.5;
  return (interval->upper - interval->lower) / 2;
}

UpdateStrength update_strength(std::int64_t iteration, std::int64_t iterations,
                               std::int64_t new_configurations, int variable_parameters,
                               bool elitist) {
  SWARMSMITH_ASSERT(1 <= iteration && iteration <= iterations,
                    "an iteration is one of those planned");
  SWARMSMITH_ASSERT(new_configurations >= 1 && variable_parameters >= 1,
                    "a race has a new configuration, and something varies");
  const double root = 1.0 / variable_parameters;
  return {.fraction = static_cast<double>(iteration - 1) / static_cast<double>(iterations),
          .shrink = pow(1.0 / static_cast<double>(new_configurations), root),
          .most = elitist ? pow(0.2, root) : 1};
}

/// irace facts, 6.2, categorical. Without the limit, one value would end up with all the weight,
/// and no other could be sampled again.
void update_probabilities(std::span<double> probabilities, std::size_t chosen,
                          const UpdateStrength& strength) {
  SWARMSMITH_ASSERT(chosen < probabilities.size(), "an elite has one of the values");
  for (double& p : probabilities)
    p *= 1 - strength.fraction;
  probabilities[chosen] += strength.fraction;
  normalise(probabilities);
  for (double& p : probabilities)
    p = std::min(p, strength.most);
  normalise(probabilities);
}

/// irace facts, 7.
void restart_probabilities(std::span<double> probabilities) {
  const double largest = *std::max_element(probabilities.begin(), probabilities.end());
  for (double& p : probabilities)
    p = 0.9 * p + 0.1 * largest;
  normalise(probabilities);
}

/// irace facts, 7: the value of two updates ago, but not wider than after the first update.
double restart_sd(double sd, double initial, std::int64_t new_configurations,
                  int variable_parameters) {
  const auto n = static_cast<double>(new_configurations);
  return std::min(sd * pow(n, 2.0 / variable_parameters),
                  initial * pow(1 / n, 1.0 / variable_parameters));
}

/// irace facts, 6.3: rank r gets E - r + 1 of E (E + 1) / 2 tickets. The arithmetic is in integers,
/// so that rounding has no influence.
std::size_t draw_parent(std::size_t elites, Rng& rng) {
  SWARMSMITH_ASSERT(elites >= 1, "every parent is an elite");
  auto ticket = static_cast<std::int64_t>(rng.below(elites * (elites + 1) / 2));
  for (std::size_t rank = 0;; ++rank) {
    ticket -= static_cast<std::int64_t>(elites - rank);
    if (ticket < 0) return rank;
  }
}

/// Makes the distribution of a numeric or ordinal parameter again, if it does not depend on the
/// other values of a configuration.
void SamplingModels::prepare(std::size_t parameter, ParameterModel& model) const {
  const Domain& domain = (*space_)[parameter].domain;
  model.distribution.reset();
  const Interval* interval = space_->constant_interval(parameter);
  if (is_categorical(domain) || std::isnan(model.mean) || interval == nullptr) return;
  if (!space_->is_numeric(parameter)) {
    // Each value is a cell of width one, and the mean is the middle of a cell.
    const auto count = static_cast<double>(space_->value_count(parameter));
    model.distribution = TruncatedNormal(model.mean + 0.5, model.sd, 0, count);
    return;
  }
  model.distribution = numeric_distribution(domain, model, model.sd, *interval);
}

void SamplingModels::initialise(std::span<const EliteLine> elites) {
  models_.clear();
  for (const EliteLine& elite : elites)
    models_[elite.id] = fresh_model(*elite.configuration);
}

SamplingModels::Model SamplingModels::fresh_model(const Configuration& elite) const {
  Model model(space_->size());
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (is_categorical((*space_)[i].domain)) {
      const std::size_t count = space_->value_count(i);
      model[i].probabilities.assign(count, 1.0 / static_cast<double>(count));
    }
    model[i].sd = initial_sd(*space_, i);
    model[i].mean = elite[i];
    prepare(i, model[i]);
  }
  return model;
}

/// The elite's own model, otherwise its parent's, otherwise a fresh one (irace facts, 6.2): a new
/// elite continues with the model from which it was sampled. Former models are kept for
/// configurations that become elites again.
SamplingModels::Model SamplingModels::source_of(const EliteLine& elite) const {
  for (const std::int64_t id : {elite.id, elite.parent}) {
    for (const auto* models : {&models_, &former_}) {
      if (const auto found = models->find(id); found != models->end()) return found->second;
    }
  }
  return fresh_model(*elite.configuration);
}

void SamplingModels::update(std::span<const EliteLine> elites, const UpdateStrength& strength) {
  std::map<std::int64_t, Model> updated;
  for (const EliteLine& elite : elites) {
    Model model = source_of(elite);
    for (std::size_t i = 0; i < model.size(); ++i) {
      if (space_->is_fixed(i) || !elite.configuration->is_active(i)) continue;
      if (is_categorical((*space_)[i].domain)) {
        update_probabilities(model[i].probabilities, elite.configuration->choice(i), strength);
        continue;
      }
      model[i].sd *= strength.shrink;
      model[i].mean = (*elite.configuration)[i];
      prepare(i, model[i]);
    }
    updated[elite.id] = std::move(model);
  }
  for (auto& [id, model] : models_) {
    if (!updated.contains(id)) former_[id] = std::move(model);
  }
  models_ = std::move(updated);
}

void SamplingModels::restart(std::int64_t id, std::int64_t new_configurations) {
  Model& model = models_.at(id);
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (space_->is_fixed(i)) continue;
    if (is_categorical((*space_)[i].domain)) {
      restart_probabilities(model[i].probabilities);
      continue;
    }
    model[i].sd = restart_sd(model[i].sd, initial_sd(*space_, i), new_configurations,
                             space_->variable_count());
    prepare(i, model[i]);
  }
}

/// irace facts, 6.4.
double SamplingModels::draw(std::size_t parameter, const ParameterModel& model,
                            const Interval& domain, Rng& rng) const {
  const Domain& kind = (*space_)[parameter].domain;
  if (is_categorical(kind)) return static_cast<double>(draw_choice(model.probabilities, rng));
  if (std::isnan(model.mean)) return quantile_value(*space_, parameter, domain, rng.uniform());
  if (!space_->is_numeric(parameter)) {
    const auto last = static_cast<double>(space_->value_count(parameter) - 1);
    SWARMSMITH_ASSERT(model.distribution, "the values of an ordinal parameter have no dependency");
    return std::min(last, std::floor(model.distribution->sample(rng)));
  }
  if (!model.distribution) {  // the domain depends on other parameters, and so does the spread
    const double sd = model.sd * (domain.upper - domain.lower);
    if (sd < kNoSpread) return domain.lower;
    const double drawn = numeric_distribution(kind, model, sd, domain).sample(rng);
    return to_domain(*space_, parameter, domain, drawn);
  }
  double drawn = model.distribution->sample(rng);
  if (is_logarithmic(kind)) {
    const bool whole = is_whole(kind);
    drawn = std::clamp(LogScale(domain, whole).from_unit(drawn), domain.lower,
                       whole ? domain.upper + 1 : domain.upper);
  }
  return to_domain(*space_, parameter, domain, drawn);
}

Expected<Configuration> SamplingModels::sample(std::int64_t elite, Rng& rng) const {
  const Model& model = models_.at(elite);
  return sample_configuration(*space_, [&](std::size_t parameter, const Interval& domain) {
    return draw(parameter, model[parameter], domain, rng);
  });
}

std::uint64_t SamplingModels::digest() const {
  if (models_.empty()) return 0;
  Digest digest;
  for (const auto& [id, model] : models_) {
    digest.add(id);
    for (const ParameterModel& parameter : model) {
      for (const double p : parameter.probabilities)
        digest.add(p);
      digest.add(parameter.sd);
      digest.add(std::isnan(parameter.mean) ? std::numeric_limits<double>::infinity()
                                            : parameter.mean);
    }
  }
  return digest.value64();
}

}  // namespace swarmsmith::irace
