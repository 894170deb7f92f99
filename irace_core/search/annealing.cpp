#include "irace_core/search/annealing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "base/assert.h"
#include "base/math.h"
#include "base/plain_text.h"
#include "base/text/toml_text.h"
#include "irace_core/internal/sampling.h"
#include "irace_core/search/random.h"

namespace swarmsmith::search {
namespace {

/// Number of random configurations that define a temperature of 1.
constexpr std::int64_t kScaleSample = 20;

// The published schedule, in score units (docs/methods.md).
constexpr double kPublishedStart = 125;
constexpr double kPublishedEnd = 0.00125;
constexpr std::int64_t kPublishedHold = 3;

/// The runs of the first round: the start and the random configurations on the first window.
std::int64_t scale_runs_of(const AnnealingOptions& options) {
  return (kScaleSample + 1) * options.window;
}

/// The number of runs of an iteration, if incumbent and best are different configurations.
std::int64_t most_runs_of(const AnnealingOptions& options) {
  return options.window + 2 * options.moved;
}

/// The factor between the start temperature and the temperature after `used` runs.
double cooled(const AnnealingOptions& options, std::int64_t budget, std::int64_t used) {
  SWARMSMITH_ASSERT(options.start_temperature > 0, "the start temperature is above 0");
  // Only the runs of the iterations cool: those of the scale and of the final stage are outside of
  // the walk.
  const auto walked = static_cast<double>(used - scale_runs_of(options));
  const auto all = static_cast<double>(budget - scale_runs_of(options) - 2 * options.final_runs);
  const double share = std::clamp(walked / all, 0.0, 1.0);
  // A geometric sequence cannot reach 0, so an end temperature of 0 becomes a very small one.
  const double end = std::max(options.end_temperature, 1e-12) / options.start_temperature;
  // Geometric cooling: equal numbers of runs multiply the temperature by equal factors.
  return pow(end, share);
}

/// A configuration of the search: its id and its costs on the window.
struct Walker {
  std::int64_t id = 0;
  Configuration configuration;
  std::map<std::int64_t, double> costs;  ///< by pair

  double mean() const {
    SWARMSMITH_ASSERT(!costs.empty(), "a walker has a cost");
    double sum = 0;
    for (const auto& [pair, cost] : costs)
      sum += cost;
    return sum / static_cast<double>(costs.size());
  }
  Elite as_elite(double rank) const {
    return {rank, id, mean(), static_cast<std::int64_t>(costs.size())};
  }
};

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0;
  double sum = 0;
  for (const double value : values)
    sum += value;
  const double mean = sum / static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values)
    squares += (value - mean) * (value - mean);
  // The sample's standard deviation: the mean is estimated from the same values.
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

class Annealing final : public Strategy {
 public:
  Annealing(const ParameterSpace& space, const Scenario& scenario, const AnnealingOptions& options,
            Neighbourhood neighbourhood)
      : space_(space),
        budget_(scenario.max_experiments),
        options_(options),
        neighbourhood_(std::move(neighbourhood)),
        rng_(scenario.seed) {}

  /// The smallest budget that works.
  std::int64_t least_budget() const { return scale_runs() + most_runs() + 2 * options_.final_runs; }

  Expected<std::optional<Round>> next(std::int64_t next_id) override {
    if (phase_ == Phase::Over) return std::nullopt;
    if (phase_ == Phase::Scale) return scale_round(next_id);
    if (!walks_on(options_, budget_, used_)) return final_round();
    return step_round(next_id);
  }

  Verdict take(std::span<const double> costs) override {
    SWARMSMITH_ASSERT(costs.size() == runs_.size(), "there is a cost for each run");
    used_ += static_cast<std::int64_t>(costs.size());
    SWARMSMITH_ASSERT(used_ <= budget_, "a search keeps to its budget");
    if (phase_ == Phase::Scale) return take_scale(costs);
    if (phase_ == Phase::Final) return take_final(costs);
    return take_step(costs);
  }

  std::int64_t planned_iterations() const override {
    const std::int64_t steps =
        steps_ + std::max<std::int64_t>(0, budget_ - used_ - 2 * options_.final_runs) / most_runs();
    // The scale, the blocks, the final stage. The number of steps is a lower bound, since a step
    // needs fewer runs while incumbent and best are the same.
    return 1 + (steps + kAnnealingBlock - 1) / kAnnealingBlock + 1;
  }

  Expected<void> extend(std::int64_t) override { return Unexpected(no_extension()); }
  Expected<std::int64_t> least_extension() const override { return Unexpected(no_extension()); }

  void add_to(Digest& digest) const override {
    digest.add(steps_);
    digest.add(used_);
    digest.add(scale_);
    digest.add(published_temperature_);
    for (const Walker* walker : {&incumbent_, &best_}) {
      digest.add(walker->id);
      for (const auto& [pair, cost] : walker->costs)
        digest.add(cost);
    }
  }

 private:
  enum class Phase { Scale, Walking, Final, Over };

  static Error no_extension() {
    return {ErrorKind::BadInput, std::string(AnnealingOptions::kWords.no_extension), ""};
  }

  std::int64_t scale_runs() const { return scale_runs_of(options_); }
  std::int64_t most_runs() const { return most_runs_of(options_); }

  /// Temperatures are in standard deviations of the costs of random configurations, so that a
  /// temperature means the same in every mission (docs/methods.md).
  Expected<std::optional<Round>> scale_round(std::int64_t next_id) {
    Round round;
    Rng rng = rng_.split("scale");
    std::vector<std::int64_t> ids;
    round.newcomers.push_back({neighbourhood_.start, 0});
    for (std::int64_t i = 0; i < kScaleSample; ++i) {
      auto drawn = draw_uniform(space_, {}, rng);
      if (!drawn) return Unexpected(drawn.error());
      round.newcomers.push_back({std::move(*drawn), 0});
    }
    if (options_.start_at_random) std::swap(round.newcomers[0], round.newcomers[1]);
    for (std::size_t i = 0; i < round.newcomers.size(); ++i)
      ids.push_back(next_id + static_cast<std::int64_t>(i));
    incumbent_.id = next_id;
    incumbent_.configuration = round.newcomers[0].configuration;
    round.runs = all_on(ids, 1, options_.window);
    round.start = Round::Start{.budget = static_cast<std::int64_t>(round.runs.size())};
    runs_ = round.runs;
    return round;
  }

  Verdict take_scale(std::span<const double> costs) {
    // scale_round() puts the smallest machine, which is not random, first or second.
    const std::int64_t smallest = incumbent_.id + (options_.start_at_random ? 1 : 0);
    std::vector<double> means;
    for (const Scored& one : ranked(runs_, costs)) {
      // The mean of a rejected configuration is infinite: it has no place in a standard deviation.
      if (one.id != smallest && !std::isinf(one.mean)) means.push_back(one.mean);
    }
    scale_ = standard_deviation(means);
    keep_costs(incumbent_, costs);
    best_ = incumbent_;
    window_begin_ = 1;
    published_temperature_ = kPublishedStart;
    phase_ = Phase::Walking;
    return {.ended = IterationEnded{.reason = "the scale of the costs is known",
                                    .elites = {incumbent_.as_elite(1)}},
            .alive = {incumbent_.id}};
  }

  /// The window of pairs moves on by `moved`: the incumbent and the best are run only on the new
  /// pairs, the candidate on the whole window, so that all three are compared on the same pairs.
  Expected<std::optional<Round>> step_round(std::int64_t next_id) {
    SWARMSMITH_ASSERT(phase_ == Phase::Walking, "steps lie between the scale and the final stage");
    // A stream for each iteration: the numbers that one iteration draws do not shift those of the
    // next one.
    step_rng_ = rng_.split("perturb", static_cast<std::uint64_t>(++steps_));
    auto perturbed = neighbourhood_.perturb(incumbent_.configuration, step_rng_);
    if (!perturbed) return Unexpected(perturbed.error());
    Round round;
    // One decision, so one step in the events, though it has runs on several pairs.
    round.is_one_step = true;
    if ((steps_ - 1) % kAnnealingBlock == 0) {
      round.start =
          Round::Start{.elites = elite_ids(),
                       .budget = std::min(kAnnealingBlock * most_runs(), budget_ - used_)};
    }
    candidate_ = {.id = next_id, .configuration = *perturbed, .costs = {}};
    // The parent is the incumbent, so the parents show which candidates were accepted.
    round.newcomers.push_back({std::move(*perturbed), incumbent_.id});

    window_begin_ += options_.moved;
    const std::int64_t end = window_begin_ + options_.window;
    std::set<std::int64_t> ids = {incumbent_.id, best_.id, candidate_.id};
    for (std::int64_t pair = window_begin_; pair < end; ++pair) {
      for (const std::int64_t id : ids) {
        const bool is_new = pair >= end - options_.moved;
        if (id == candidate_.id || is_new) round.runs.emplace_back(id, pair);
      }
    }
    runs_ = round.runs;
    SWARMSMITH_ASSERT(static_cast<std::int64_t>(runs_.size()) <= most_runs(),
                      "an iteration costs what walks_on() leaves for it");
    return round;
  }

  Verdict take_step(std::span<const double> costs) {
    for (Walker* walker : {&incumbent_, &best_, &candidate_})
      keep_costs(*walker, costs);
    if (is_accepted()) {
      incumbent_ = candidate_;
      // All three have costs on the same window here, so their means can be compared.
      if (candidate_.mean() <= best_.mean()) best_ = candidate_;
    }
    cool();
    Verdict verdict{.ended = std::nullopt, .alive = elite_ids()};
    std::ranges::sort(verdict.alive);
    if (steps_ % kAnnealingBlock == 0) verdict.ended = end_of_block();
    return verdict;
  }

  IterationEnded end_of_block() const {
    IterationEnded ended{.reason = "a block of iterations is over", .elites = {best_.as_elite(1)}};
    if (incumbent_.id != best_.id) ended.elites.push_back(incumbent_.as_elite(2));
    return ended;
  }

  /// The criterion of Metropolis et al. (Journal of Chemical Physics 21, 1953). The random number
  /// is drawn in any case, so that later draws do not depend on the costs.
  bool is_accepted() {
    const double draw = step_rng_.uniform();
    const double now = candidate_.mean();
    const double before = incumbent_.mean();
    if (now <= before) return true;
    // With T = 0 the search is iterative improvement: nothing worse is accepted (docs/methods.md).
    const double t = temperature();
    return t > 0 && draw < exp((before - now) / t);
  }

  double temperature() const {
    // The published temperatures are in score units, others are multiples of the scale.
    if (options_.cooling == Cooling::Published) return published_temperature_;
    if (options_.start_temperature == 0) return 0;
    return scale_ * options_.start_temperature * cooled(options_, budget_, used_);
  }

  /// The published schedule halves the temperature after every third iteration; at its end it
  /// starts again, from the best configuration (docs/methods.md, `cooling`).
  void cool() {
    // Geometric cooling follows from the number of runs (see cooled()).
    if (options_.cooling != Cooling::Published) return;
    if (steps_ % kPublishedHold == 0) published_temperature_ /= 2;
    if (published_temperature_ >= kPublishedEnd) return;
    published_temperature_ = kPublishedStart;
    incumbent_ = best_;
  }

  /// Runs incumbent and best on pairs after the last window: the lower mean wins.
  Expected<std::optional<Round>> final_round() {
    SWARMSMITH_ASSERT(phase_ == Phase::Walking, "the final stage comes once, after the steps");
    phase_ = Phase::Final;
    Round round;
    const std::vector<std::int64_t> ids = elite_ids();
    // If incumbent and best are the same configuration, it gets the runs reserved for both.
    const std::int64_t runs = (budget_ - used_) / static_cast<std::int64_t>(ids.size());
    SWARMSMITH_ASSERT(runs >= options_.final_runs, "walks_on() leaves runs for the final stage");
    const std::int64_t first = window_begin_ + options_.window;
    round.runs = all_on(ids, first, std::min(runs, 2 * options_.final_runs));
    round.start = Round::Start{
        .elites = ids, .budget = static_cast<std::int64_t>(round.runs.size()), .is_final = true};
    runs_ = round.runs;
    return round;
  }

  Verdict take_final(std::span<const double> costs) {
    phase_ = Phase::Over;
    const std::vector<Scored> order = ranked(runs_, costs);
    Verdict verdict{
        .ended = IterationEnded{.reason = "the final stage is over", .elites = as_elites(order)},
        .alive = elite_ids()};
    std::ranges::sort(verdict.alive);
    return verdict;
  }

  /// Updates the costs of a walker to the current window.
  void keep_costs(Walker& walker, std::span<const double> costs) const {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (runs_[i].first == walker.id) walker.costs[runs_[i].second] = costs[i];
    }
    // All walkers keep the costs of the same pairs, so that their means can be compared.
    walker.costs.erase(walker.costs.begin(), walker.costs.lower_bound(window_begin_));
    SWARMSMITH_ASSERT(static_cast<std::int64_t>(walker.costs.size()) == options_.window,
                      "a walker has been run on the whole window");
  }

  /// The ids of the best configuration and the incumbent, in this order; only one if they are the
  /// same.
  std::vector<std::int64_t> elite_ids() const {
    if (incumbent_.id == best_.id) return {best_.id};
    return {best_.id, incumbent_.id};
  }

  const ParameterSpace& space_;
  std::int64_t budget_;
  AnnealingOptions options_;
  Neighbourhood neighbourhood_;
  Rng rng_;
  Rng step_rng_{0};
  Phase phase_ = Phase::Scale;
  std::vector<std::pair<std::int64_t, std::int64_t>> runs_;  ///< of the current round
  Walker incumbent_;
  Walker best_;
  Walker candidate_;
  std::int64_t window_begin_ = 1;  ///< first pair of the window
  std::int64_t steps_ = 0;
  std::int64_t used_ = 0;
  double scale_ = 0;  ///< standard deviation of the costs at a temperature of 1
  double published_temperature_ = 0;
};

}  // namespace

bool walks_on(const AnnealingOptions& options, std::int64_t budget, std::int64_t used) {
  return used + most_runs_of(options) + 2 * options.final_runs <= budget;
}

double told_temperature(const AnnealingOptions& options, std::int64_t budget, std::int64_t used,
                        std::int64_t number) {
  if (options.cooling == Cooling::Geometric) {
    if (options.start_temperature == 0) return 0;
    return options.start_temperature * cooled(options, budget, used);
  }
  // The same steps as in Annealing::cool().
  double temperature = kPublishedStart;
  for (std::int64_t i = kPublishedHold; i < number; i += kPublishedHold) {
    temperature /= 2;
    if (temperature < kPublishedEnd) temperature = kPublishedStart;
  }
  return temperature;
}

Neighbourhood one_parameter_neighbourhood(const ParameterSpace& space, Configuration start) {
  const auto perturb = [&space](const Configuration& from, Rng& rng) -> Expected<Configuration> {
    std::vector<std::size_t> changeable;
    for (std::size_t i = 0; i < space.size(); ++i) {
      // A fixed parameter has no other value, and an inactive one has none at all.
      if (from.is_active(i) && !space.is_fixed(i)) changeable.push_back(i);
    }
    constexpr int kTries = 100;
    for (int i = 0; i < kTries && !changeable.empty(); ++i) {
      const std::size_t changed = changeable[rng.below(changeable.size())];
      auto made =
          irace::sample_configuration(space, [&](std::size_t parameter, const Interval& domain) {
            // A value that is kept may lie outside of a dependent domain after the change; it is
            // then drawn anew.
            const bool is_kept =
                parameter != changed && from.is_active(parameter) &&
                (!space.is_numeric(parameter) ||
                 (from[parameter] >= domain.lower && from[parameter] <= domain.upper));
            return is_kept ? from[parameter]
                           : irace::quantile_value(space, parameter, domain, rng.uniform());
          });
      if (!made) return made;
      // A draw may give the old value again: the same configuration would not be a step.
      if (*made != from && !space.is_forbidden(*made)) return made;
    }
    return bad_input("no configuration besides the incumbent is allowed");
  };
  return {std::move(start), perturb};
}

}  // namespace swarmsmith::search

namespace swarmsmith {
namespace {

/// The number of finished iterations; the first steps only measure the scale.
std::int64_t walked(const AnnealingOptions& options, const SearchPoint& point) {
  return std::max<std::int64_t>(0, point.step - options.window);
}

}  // namespace

std::vector<SearchFault> AnnealingOptions::faults() const {
  std::vector<SearchFault> faults;
  if (moved > window)
    faults.push_back(
        {{"moved"}, "`moved` must be at most `window`: a window moves on by parts of it"});
  // The published schedule has its own temperatures. The default values are allowed here, since
  // they are in the text that stores contain.
  const AnnealingOptions usual;
  const auto refuse = [&](std::string_view key, double value, double usually) {
    if (cooling != Cooling::Published || value == usually) return;
    faults.push_back({{key},
                      "`" + std::string(key) +
                          "` is for geometric cooling; the published one begins at 125 score "
                          "units, and again whenever it is below 0.00125"});
  };
  refuse("start_temperature", start_temperature, usual.start_temperature);
  refuse("end_temperature", end_temperature, usual.end_temperature);
  if (start_temperature > 0 && end_temperature > start_temperature) {
    faults.push_back({{"end_temperature", "start_temperature"},
                      "`end_temperature` (" + number_text(end_temperature) +
                          ") must be at most `start_temperature` (" +
                          number_text(start_temperature) + "): annealing cools"});
  }
  return faults;
}

Expected<std::unique_ptr<search::Strategy>> AnnealingOptions::start(search::Start from) const {
  if (!from.neighbourhood) {
    Rng rng = Rng(from.scenario.seed).split("start");
    // docs/methods.md: the search begins at the first given configuration, otherwise at a random
    // one.
    auto first = from.initial.empty() ? search::draw_uniform(from.space, {}, rng)
                                      : Expected<Configuration>(from.initial.front());
    if (!first) return Unexpected(first.error());
    from.neighbourhood = search::one_parameter_neighbourhood(from.space, std::move(*first));
  }
  auto annealing = std::make_unique<search::Annealing>(from.space, from.scenario, *this,
                                                       std::move(*from.neighbourhood));
  if (from.scenario.max_experiments < annealing->least_budget()) {
    return Unexpected(search::too_small(from.scenario.max_experiments, annealing->least_budget()));
  }
  return annealing;
}

SearchPoint AnnealingOptions::planned(SearchPoint point) const {
  point.is_final = point.iteration > 1 && !search::walks_on(*this, point.budget, point.used);
  return point;
}

StageTexts AnnealingOptions::texts(const SearchPoint& point) const {
  if (point.iteration <= 1) {
    StageTexts texts = usual_texts(kWords, point, "scale of the scores");
    const std::string there = stage::members(kWords, point);
    texts.line = texts.name + ": " + counted(point.configurations, kWords.candidate) + ", " +
                 stage::each(point);
    texts.stage = texts.name + (there.empty() ? "" : ": " + there);
    return texts;
  }
  const std::int64_t before = (point.iteration - 2) * search::kAnnealingBlock;
  const std::int64_t last = std::min(walked(*this, point), before + search::kAnnealingBlock);
  const std::string name = stage::range("iteration", before + 1, last);
  const std::int64_t number = walked(*this, point) + 1;
  char temperature[32];
  std::snprintf(temperature, sizeof temperature, "%.3g",
                search::told_temperature(*this, point.budget, point.used, number));
  // A continued campaign knows its step only after the next step.
  const std::string where =
      point.step > 0 ? "iteration " + std::to_string(number) : "an iteration of " + name;
  // The number of runs of the iterations is not known in advance, so the line is just the name.
  return {.name = name, .line = name, .stage = where + ", temperature " + temperature};
}

}  // namespace swarmsmith
