#include "irace_core/iterated_race.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "irace_core/internal/race_loop.h"
#include "irace_core/internal/schedule.h"

namespace swarmsmith {
namespace {

Expected<void> check_initial(const ParameterSpace& space,
                             const std::vector<Configuration>& initial) {
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const std::string number = "initial configuration " + std::to_string(i + 1);
    if (auto checked = space.check(initial[i]); !checked) {
      const std::string where = checked.error().where;
      return bad_input(checked.error().message, where.empty() ? number : number + ", " + where);
    }
    // irace facts, 23.4: a row that occurs twice is an error.
    for (std::size_t j = 0; j < i; ++j) {
      if (initial[i] == initial[j]) {
        return bad_input("is the same as number " + std::to_string(j + 1), number);
      }
    }
  }
  return {};
}

}  // namespace

std::int64_t total_budget(const ParameterSpace& space, const Scenario& scenario) {
  return irace::Schedule(scenario, space.variable_count()).total_budget();
}

Expected<IteratedRace> IteratedRace::start(ParameterSpace space, Scenario scenario,
                                           std::vector<Configuration> initial, Repair repair) {
  if (auto checked = check(scenario); !checked) return Unexpected(checked.error());
  if (auto checked = check_initial(space, initial); !checked) return Unexpected(checked.error());
  auto state =
      std::make_unique<State>(std::move(space), scenario, std::move(initial), std::move(repair));
  if (auto begun = state->begin(); !begun) return Unexpected(begun.error());
  return IteratedRace(std::move(state));
}

IteratedRace::IteratedRace(std::unique_ptr<State> state) : state_(std::move(state)) {}
IteratedRace::IteratedRace(IteratedRace&&) noexcept = default;
IteratedRace& IteratedRace::operator=(IteratedRace&&) noexcept = default;
IteratedRace::~IteratedRace() = default;

bool IteratedRace::finished() const {
  return state_->finished;
}
const std::optional<Error>& IteratedRace::failure() const {
  return state_->failure;
}
std::span<const Experiment> IteratedRace::wanted() const {
  return state_->wanted;
}

void IteratedRace::tell(std::span<const Measurement> measurements) {
  if (measurements.size() != state_->wanted.size()) {
    throw std::invalid_argument("got " + std::to_string(measurements.size()) + " costs for " +
                                std::to_string(state_->wanted.size()) + " wanted experiments");
  }
  for (const Measurement& measurement : measurements) {
    // A race could not rank it, and marks missing results by NaN. A target that prints NaN is an
    // error (irace facts, 12), not a rejection.
    if (std::isnan(measurement.cost)) throw std::invalid_argument("a cost is not a number");
  }
  state_->tell(measurements);
}

void IteratedRace::tell(std::span<const double> costs) {
  std::vector<Measurement> measurements;
  for (const double cost : costs)
    // A time of 0 means that it is unknown.
    measurements.push_back({cost, 0});
  tell(measurements);
}

std::vector<Experiment> IteratedRace::ahead(std::int64_t pairs) const {
  return state_->ahead(pairs);
}

Expected<void> IteratedRace::extend(std::int64_t experiments) {
  return state_->extend(experiments);
}

Expected<std::int64_t> IteratedRace::least_extension() const {
  return state_->least_extension();
}

std::vector<std::int64_t> IteratedRace::alive() const {
  return state_->alive();
}

std::vector<RaceEvent> IteratedRace::take_events() {
  return std::exchange(state_->events, {});
}

const Configuration& IteratedRace::configuration(std::int64_t id) const {
  return state_->candidates.at(static_cast<std::size_t>(id - 1)).configuration.get();
}

const ParameterSpace& IteratedRace::space() const {
  return state_->space;
}
const Scenario& IteratedRace::scenario() const {
  return state_->scenario;
}
std::span<const Elite> IteratedRace::elites() const {
  return state_->elites;
}

std::int64_t IteratedRace::experiments_used() const {
  return state_->used();
}

std::int64_t IteratedRace::budget() const {
  return state_->budget();
}
double IteratedRace::time_used() const {
  return state_->time ? state_->time->used() : 0;
}
std::int64_t IteratedRace::iteration() const {
  return state_->iteration;
}
std::int64_t IteratedRace::n_iterations() const {
  return state_->iterations;
}

std::int64_t IteratedRace::n_alive() const {
  return state_->race ? static_cast<std::int64_t>(state_->race->alive_count())
                      : static_cast<std::int64_t>(state_->elites.size());
}

std::int64_t IteratedRace::n_configurations() const {
  return static_cast<std::int64_t>(state_->candidates.size());
}

}  // namespace swarmsmith
