#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "base/assert.h"
#include "irace_core/internal/postselection.h"
#include "irace_core/internal/race_loop.h"

namespace swarmsmith {

/// The elites of the last iteration, then those of the one before, and so on, then all others by
/// id; without rejected ones.
std::vector<std::int64_t> IteratedRace::State::preferred() const {
  std::vector<std::int64_t> ids;
  std::set<std::int64_t> seen;
  const auto add_once = [&](std::int64_t id) {
    if (candidate(id).takes_part && seen.insert(id).second) ids.push_back(id);
  };
  for (auto ended = ended_.rbegin(); ended != ended_.rend(); ++ended) {
    for (const Elite& elite : *ended)
      add_once(elite.configuration);
  }
  for (std::int64_t id = 1; id <= static_cast<std::int64_t>(candidates.size()); ++id)
    add_once(id);
  return ids;
}

/// irace facts, 14 (irace 4): the budget that remains after the last iteration would be lost. It is
/// spent on a race among the elites of all iterations and, if there is room, other configurations.
bool IteratedRace::State::begin_postselection() {
  if (!scenario.postselection || !scenario.elitist || time) return false;
  const std::int64_t left = remaining();
  if (left / std::max(scenario.block_size, scenario.each_test) <= 1)
    return false;  // irace facts, 14
  // Rules 14.1 and 14.2 differ in whether new pairs can be had: the list of a deterministic run
  // does not grow.
  instances_.extend_to(pairs_seen_ + schedule_.pairs_between_tests());
  const bool asks = instances_.size() - pairs_seen_ >= schedule_.pairs_between_tests();
  const std::vector<std::int64_t> ids = preferred();
  std::vector<irace::PostselectionCandidate> all;
  all.reserve(ids.size());
  // A candidate is run on the pairs that it misses before any new pair, so these runs are part of
  // what it needs.
  for (const std::int64_t id : ids) {
    SWARMSMITH_ASSERT(static_cast<std::int64_t>(candidate(id).results.size()) <= pairs_seen_,
                      "a candidate has one result on a pair");
    all.push_back({id, pairs_seen_ - static_cast<std::int64_t>(candidate(id).results.size())});
  }
  const auto chosen =
      irace::choose_for_postselection(all, left, asks ? schedule_.pairs_between_tests() : 0);
  // A single candidate needs no race. R's irace may end with an error here (irace facts, 25.3).
  if (chosen.size() < 2) return false;
  std::vector<std::int64_t> contestants;
  contestants.reserve(chosen.size());
  for (const std::size_t i : chosen)
    contestants.push_back(ids[i]);
  // The race is logged as a further iteration (irace facts, 14).
  ++iteration;
  iterations = std::max(iterations, iteration);
  events.emplace_back(
      IterationStarted{.iteration = iteration,
                       .n_iterations = iterations,
                       .remaining = left,
                       .budget = left,
                       .n_configurations = static_cast<std::int64_t>(contestants.size()),
                       .new_pairs = 0,
                       .elites = contestants,
                       .soft_restart = false,
                       .postselection = true,
                       .model_digest = models_.digest()});
  // irace facts, 14: no new pairs first, one survivor, no limit of tests without a drop.
  irace::RaceSettings settings = common_settings(left);
  settings.first_test = pairs_seen_;  // tests only after all past pairs
  settings.min_survival = 1;
  settings.elitist_limit = 0;
  order_pairs(settings);
  start_race(std::move(settings), contestants);
  return true;
}

/// irace ends without elites in this case; here a design that had elites keeps the next best ones.
void IteratedRace::State::fall_back() {
  for (auto ended = ended_.rbegin(); ended != ended_.rend() && elites.empty(); ++ended) {
    std::copy_if(ended->begin(), ended->end(), std::back_inserter(elites),
                 [&](const Elite& elite) { return candidate(elite.configuration).takes_part; });
    // They may have been run on more pairs since then; their order stays that of this iteration.
    for (Elite& elite : elites)
      elite = candidate(elite.configuration).as_elite(elite.configuration, elite.rank);
  }
  // All elites of all iterations were rejected: the best of the others that were tried remain.
  if (!elites.empty()) return;
  std::vector<std::int64_t> ids;
  for (std::int64_t id = 1; id <= static_cast<std::int64_t>(candidates.size()); ++id) {
    if (candidate(id).takes_part && !candidate(id).results.empty()) ids.push_back(id);
  }
  elites = ranked(ids);
  std::stable_sort(elites.begin(), elites.end(),
                   [](const Elite& a, const Elite& b) { return a.rank < b.rank; });
  const auto most = static_cast<std::size_t>(schedule_.min_survival());
  if (elites.size() > most) elites.resize(most);
}

}  // namespace swarmsmith
