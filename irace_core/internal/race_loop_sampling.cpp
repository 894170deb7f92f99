#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/race_loop.h"
#include "irace_core/internal/similarity.h"

namespace swarmsmith {

using irace::EliteLine;
using irace::RacePlan;

std::int64_t IteratedRace::State::add(Candidate candidate, std::int64_t in_iteration) {
  const auto id = static_cast<std::int64_t>(candidates.size()) + 1;
  events.emplace_back(
      ConfigurationSampled{id, candidate.parent, in_iteration, candidate.configuration.get()});
  candidates.push_back(std::move(candidate));
  return id;
}

Expected<std::vector<std::int64_t>> IteratedRace::State::sample_initial(std::int64_t count,
                                                                        std::int64_t in_iteration) {
  auto sampled = initial_.sample(count, forbidden_, repair_);
  if (!sampled) return Unexpected(sampled.error());
  std::vector<std::int64_t> ids;
  // irace facts, 5: a first configuration has no parent.
  for (Configuration& configuration : *sampled)
    ids.push_back(add({std::move(configuration), 0, true, {}}, in_iteration));
  sampling_drawn_ = initial_.position();
  return ids;
}

Expected<std::vector<std::int64_t>> IteratedRace::State::first_contestants(const RacePlan& plan) {
  const auto most = static_cast<std::size_t>(plan.configurations);
  // Only an estimate of max_time gives elites before the first race. If there are more than the
  // race takes, the best by overall rank stay (irace facts, 3.5).
  if (elites.size() > most) {
    std::stable_sort(elites.begin(), elites.end(),
                     [](const Elite& a, const Elite& b) { return a.rank < b.rank; });
    elites.resize(most);
  }
  std::vector<std::int64_t> ids;
  for (const Elite& elite : elites)
    ids.push_back(elite.configuration);
  // Given configurations come next, before sampled ones (irace facts, 5). Those with results are
  // among the elites, or were left out above.
  for (std::int64_t id = 1; id <= initial_count_ && ids.size() < most; ++id) {
    if (candidate(id).takes_part && candidate(id).results.empty()) ids.push_back(id);
  }
  const auto given = static_cast<std::int64_t>(ids.size() - elites.size());
  std::int64_t able = 0;  // without those that are forbidden or were rejected by an estimate
  for (std::int64_t id = 1; id <= initial_count_; ++id)
    able += candidate(id).takes_part && candidate(id).results.empty() ? 1 : 0;
  if (given < able && elites.empty()) {
    warn("only " + std::to_string(given) + " of the " + std::to_string(able) +
         " initial configurations take part: the first race has no room for more");
  }
  // The batch of Sobol points may be smaller than wanted, in a space with few values or with strict
  // constraints (irace facts, 5).
  if (ids.size() < most) {
    const auto missing = static_cast<std::int64_t>(most - ids.size());
    auto sampled = sample_initial(missing, plan.iteration);
    if (!sampled) return sampled;
    ids.insert(ids.end(), sampled->begin(), sampled->end());
  }
  if (ids.empty()) {
    return bad_input(
        "no configuration that is not forbidden was found: the constraints are too strict; forbid "
        "less, or narrow the domains instead");
  }
  // Such a race could compare nothing: it stops as soon as it may (irace facts, 9.3.2 a).
  if (static_cast<std::int64_t>(ids.size()) <= schedule_.min_survival()) {
    return bad_input("only " + std::to_string(ids.size()) +
                     " different configurations were found, and a race needs more than " +
                     std::to_string(schedule_.min_survival()) +
                     ", which survive (min_nb_survival): let fewer survive, or give the parameters "
                     "more values");
  }
  return ids;
}

Expected<std::vector<std::int64_t>> IteratedRace::State::later_contestants(
    const RacePlan& plan, IterationStarted& started) {
  const std::vector<EliteLine> lines = elite_lines();
  const std::int64_t wanted_new = plan.configurations - static_cast<std::int64_t>(elites.size());
  // Models start with the first race's elites (irace facts, 6.1), then each is updated with its
  // elite (6.2).
  if (models_.empty()) models_.initialise(lines);
  models_.update(lines, irace::update_strength(plan.iteration, plan.iterations, wanted_new,
                                               space.variable_count(), scenario.elitist));
  // A stream for each iteration: what one iteration draws does not shift the draws of the next one.
  Rng rng = root_.split("sampling", static_cast<std::uint64_t>(plan.iteration));
  auto sampled = sample_new(wanted_new, rng);
  if (!sampled) return Unexpected(sampled.error());
  // irace facts, 7: similar configurations mean that a model is too narrow to give new information,
  // so it is widened and all configurations are sampled again, once. The random numbers already
  // drawn stay used.
  if (scenario.soft_restart) {
    const std::vector<std::int64_t> restarted = lines_to_restart(*sampled);
    for (const std::int64_t id : restarted)
      models_.restart(id, wanted_new);
    if (!restarted.empty()) {
      started.soft_restart = true;
      sampled = sample_new(wanted_new, rng);
      if (!sampled) return Unexpected(sampled.error());
    }
  }
  started.model_digest = models_.digest();
  // The digest of each step contains this number (see report_steps()).
  sampling_drawn_ = rng.drawn();
  std::vector<std::int64_t> ids;
  for (const Elite& elite : elites)
    ids.push_back(elite.configuration);
  for (Candidate& fresh : *sampled)
    ids.push_back(add(std::move(fresh), plan.iteration));
  SWARMSMITH_ASSERT(static_cast<std::int64_t>(ids.size()) == plan.configurations,
                    "elites and new ones fill the race");
  return ids;
}

/// irace facts, 6.3 and 6.4: the better the rank of an elite, the more often it is a parent.
/// Duplicates are allowed (6.8), forbidden ones are not (8.4).
Expected<std::vector<Candidate>> IteratedRace::State::sample_new(std::int64_t count, Rng& rng) {
  // As in irace (irace facts, 8.4): a limit, since constraints may exclude nearly everything that
  // the models give.
  constexpr int kMostRounds = 100;
  SWARMSMITH_ASSERT(!elites.empty(), "a further race needs elites");
  std::vector<Candidate> sampled;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::int64_t missing = count - static_cast<std::int64_t>(sampled.size());
    if (missing == 0) return sampled;
    for (std::int64_t i = 0; i < missing; ++i) {
      const std::int64_t parent = elites[irace::draw_parent(elites.size(), rng)].configuration;
      auto configuration = models_.sample(parent, rng);
      // irace facts, 8.5: sample, repair, and only then look at what is forbidden.
      if (configuration) {
        configuration = irace::repaired(space, repair_, std::move(*configuration));
      }
      if (!configuration) return Unexpected(configuration.error());
      if (forbidden_.contains(*configuration)) continue;
      sampled.push_back({std::move(*configuration), parent, true, {}});
    }
  }
  if (static_cast<std::int64_t>(sampled.size()) == count) return sampled;
  return bad_input(
      "nearly all that is sampled is forbidden: the constraints are too strict; forbid less, or "
      "narrow the domains instead");
}

/// irace facts, 7: elites and new configurations are compared with each other. A similar
/// configuration widens the model from which it comes: an elite its own, a new one its parent's.
std::vector<std::int64_t> IteratedRace::State::lines_to_restart(
    const std::vector<Candidate>& sampled) const {
  std::vector<const Configuration*> all;
  std::vector<std::int64_t> owners;
  for (const Elite& elite : elites) {
    all.push_back(&candidate(elite.configuration).configuration.get());
    owners.push_back(elite.configuration);
  }
  for (const Candidate& fresh : sampled) {
    all.push_back(&fresh.configuration.get());
    owners.push_back(fresh.parent);
  }
  std::vector<std::int64_t> ids;
  for (const std::size_t i :
       irace::similar_configurations(space, all, scenario.soft_restart_threshold)) {
    ids.push_back(owners[i]);
  }
  // A model is widened once, however many similar configurations point to it.
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::vector<EliteLine> IteratedRace::State::elite_lines() const {
  std::vector<EliteLine> lines;
  for (const Elite& elite : elites) {
    const Candidate& known = candidate(elite.configuration);
    // The parent is needed for an elite without its own model: it continues with a copy of its
    // parent's (irace facts, 6.2).
    lines.push_back({elite.configuration, known.parent, &known.configuration.get()});
  }
  return lines;
}

}  // namespace swarmsmith
