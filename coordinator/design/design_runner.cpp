#include "coordinator/design/design_runner.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <utility>

#include "base/assert.h"
#include "base/overloaded.h"
#include "base/plain_text.h"
#include "programs/cost.h"

namespace swarmsmith {

Expected<DesignRunner> DesignRunner::start(DesignPlan plan, StoredDesign stored) {
  if (plan.only_test) return DesignRunner(std::move(plan), std::move(stored), nullptr);
  auto search = start_search(plan.space, plan.scenario, plan.search, plan.initial, plan.repair,
                             plan.neighbourhood);
  if (!search) return Unexpected(search.error());
  return DesignRunner(std::move(plan), std::move(stored), std::move(*search));
}

DesignRunner::DesignRunner(DesignPlan plan, StoredDesign stored, std::unique_ptr<Search> search)
    : plan_(std::move(plan)),
      search_(std::move(search)),
      commands_(std::exchange(plan_.commands, {})),
      scores_(std::move(stored)),
      tests_(plan_),
      recorder_(plan_.row.id, plan_.source, scores_.unasked().step_digests) {}

Expected<void> DesignRunner::advance(std::vector<Task>& tasks, std::vector<Row>& rows) {
  const auto gone_on = go_on(tasks);
  recorder_.move_rows_to(rows);
  if (!gone_on) return gone_on;
  // Calls of a targetEvaluator are made one at a time (irace facts, 18.4), so `go_on` only queues
  // them.
  if (auto call = calls_.next()) tasks.push_back(std::move(*call));
  return {};
}

Expected<void> DesignRunner::go_on(std::vector<Task>& tasks) {
  if (state() == DesignState::Waiting) {
    if (auto begun = begin(tasks); !begun) return begun;
  }
  for (;;) {
    if (state() == DesignState::Racing) {
      if (auto raced = go_on_racing(tasks); !raced) return raced;
    }
    if (fault_) return Unexpected(*fault_);
    if (state() != DesignState::Finished) {
      if (state() != DesignState::Testing) return {};
      const bool tested = finish_tests(tasks);
      if (fault_) return Unexpected(*fault_);
      if (!tested) return {};
      recorder_.set_state(DesignState::Finished);
      recorder_.record_state();
    }
    // Only after the tests: an extension continues from the end of the race and its tests
    // (docs/irace.md, "More budget, and an early end").
    const auto extended = extend(tasks);
    if (!extended) return Unexpected(extended.error());
    if (!*extended) return {};
  }
}

Expected<void> DesignRunner::begin(std::vector<Task>& tasks) {
  if (plan_.only_test) {
    test_the_given(tasks);
    return {};
  }
  recorder_.set_state(DesignState::Racing);
  recorder_.record_state();  // the first step may take long, and people look at the store
  if (auto taken = take_events(); !taken) return taken;
  want_batch(tasks);
  return {};
}

Expected<void> DesignRunner::go_on_racing(std::vector<Task>& tasks) {
  for (;;) {
    // Before the batch is looked at: a cancel does not wait for its outcomes.
    if (is_cancelled()) {
      cancel(tasks);
      return {};
    }
    if (!batch_.is_complete()) return {};
    if (fault_) return Unexpected(*fault_);
    SWARMSMITH_ASSERT(search_, "only a search races");
    if (search_->finished()) return finish_race(tasks);
    // The loop goes on without a worker as long as all scores are known: this is the replay.
    if (auto told = tell_race(); !told) return told;
    want_batch(tasks);
    ahead_.end_step(search_->alive());
  }
}

Expected<void> DesignRunner::finish_race(std::vector<Task>& tasks) {
  const bool goes_on = commands_.next(CommandKind::Extend, recorder_.steps()) != nullptr;
  // The store has further steps, but this race is over: it is another race.
  if (recorder_.is_replaying() && !goes_on) return Unexpected(recorder_.other_step());
  if (search_->failure()) {
    recorder_.set_state(DesignState::Stopped);
    recorder_.set_reason(to_string(*search_->failure()));
    recorder_.record_state();
    return {};
  }
  recorder_.set_state(DesignState::Testing);
  recorder_.record_state();
  want_tests(tasks);
  return {};
}

bool DesignRunner::finish_tests(std::vector<Task>& tasks) {
  if (!batch_.is_complete()) return false;
  if (!plan_.scenario.target_evaluator) return true;
  // The targetEvaluator is asked about the tests when all of them have run, as in a task of the
  // race.
  if (!calls_.are_tests_begun()) want_test_calls(tasks);
  return batch_.is_complete();
}

Expected<void> DesignRunner::command(const CommandRow& command, std::vector<Row>& rows) {
  if (auto checked = check_command(plan_, commands_.all(), command); !checked) return checked;
  const std::string name = to_string(id());
  if (state() == DesignState::Stopped)
    return bad_input("it is stopped: " + recorder_.design().reason, name);
  if (command.kind == CommandKind::Cancel) {
    if (state() == DesignState::Finished) return bad_input("it is finished", name);
    if (state() == DesignState::Testing) {
      return bad_input("its race is over; only the tests of its elites are left", name);
    }
  } else if (state() == DesignState::Finished) {
    SWARMSMITH_ASSERT(search_, "a design without a search takes no commands");
    // Refused now, when the operator sees it. During the race the remaining budget is not known
    // yet.
    const auto least = search_->least_extension();
    if (!least) return Unexpected(least.error());
    if (command.budget < *least) {
      return bad_input(
          fmt::format(
              "{} too few {}; at least {} are needed",
              counted(command.budget, "more experiment is", "more experiments are"),
              kind_of(plan_.search) == SearchKind::Irace ? "for another iteration" : "to continue",
              *least),
          name);
    }
  }
  commands_.add(command);
  rows.emplace_back(commands_.all().back());
  return {};
}

/// Not during the first estimate of max_time, because there is no step yet after which the cancel
/// could be recorded. A new cancel waits until the stored part of the race has been replayed, and
/// until the calls of a targetEvaluator have led to the step for which they were made: calls that
/// were made count.
bool DesignRunner::is_cancelled() const {
  const CommandRow* command = commands_.next(CommandKind::Cancel, recorder_.steps());
  if (command == nullptr || recorder_.design().iteration == 0) return false;
  return command->step || (!batch_.is_complete() && !recorder_.is_replaying() &&
                           !batch_.experiments().front().is_evaluation);
}

/// The runs after the last step depend on how fast the workers were, so they do not count.
void DesignRunner::cancel(std::vector<Task>& tasks) {
  std::set<EvaluationKey> unused = scores_.discard_race();
  for (const StoredScore& score : given_)
    unused.insert(score.key);
  for (const StoredScore& score : batch_.scores()) {
    if (score.key.candidate) unused.insert(score.key);
  }
  for (const EvaluationKey& key : unused) {
    if (key.purpose == Purpose::Race) recorder_.record_unused(key);
  }
  // Tasks that were not handed out yet are deleted; the others are released.
  std::erase_if(tasks, [&](const Task& task) {
    if (design_of(task.key.candidate) != id()) return false;
    const bool was_awaited = batch_.let_go(task.key);
    const bool was_ahead = ahead_.remove(task.key).has_value();
    return was_awaited || was_ahead;
  });
  for (const Experiment& experiment : batch_.let_go())
    ahead_.add(key_of(Purpose::Race, experiment), experiment.bound);
  ahead_.drop_all();
  const CommandRow* command = commands_.next(CommandKind::Cancel, recorder_.steps());
  recorder_.record_command(commands_.act(*command, recorder_.steps()));
  recorder_.set_state(DesignState::Stopped);
  recorder_.set_reason("cancelled");
  recorder_.record_state();
}

Expected<bool> DesignRunner::extend(std::vector<Task>& tasks) {
  for (bool extended = false; !extended;) {
    const CommandRow* next = commands_.next(CommandKind::Extend, recorder_.steps());
    if (next == nullptr) return false;
    if (!search_) {
      recorder_.record_warning("the design has no search to extend");
      return false;
    }
    const auto done = search_->extend(next->budget);
    extended = done.has_value();
    if (!extended) recorder_.record_warning("it cannot be extended: " + to_string(done.error()));
    // A refused command is over, too: else those after it would wait for ever.
    recorder_.record_command(commands_.act(*next, recorder_.steps()));
  }
  recorder_.set_state(DesignState::Racing);
  recorder_.set_reason("");
  calls_.go_on();
  if (auto taken = take_events(); !taken) return Unexpected(taken.error());
  recorder_.record_state();
  want_batch(tasks);
  return true;
}

void DesignRunner::want_batch(std::vector<Task>& tasks) {
  const auto wanted = search_->wanted();
  batch_ = Batch({wanted.begin(), wanted.end()});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Experiment experiment = wanted[i];
    const Purpose purpose = experiment.is_evaluation ? Purpose::Evaluator : Purpose::Race;
    if (experiment.is_evaluation) {
      experiment.pair = calls_.pair_in_race(experiment.task);
    } else {
      // A pair's instance and seed stay those of its first use.
      pairs_.try_emplace(experiment.pair, experiment);
    }
    recorder_.record_pair(purpose, experiment);
    want(i, key_of(purpose, experiment), experiment, tasks);
  }
}

void DesignRunner::test_the_given(std::vector<Task>& tasks) {
  std::vector<std::int64_t> numbers;
  for (const Configuration& configuration : plan_.initial) {
    numbers.push_back(static_cast<std::int64_t>(numbers.size()) + 1);
    if (auto added = add_candidate({.id = numbers.back(), .configuration = configuration});
        !added && !fault_)
      fault_ = added.error();
  }
  // A baseline machine represents its method, as the winner of a race does.
  if (!plan_.row.flavour.empty()) recorder_.set_best(numbers.front());
  tests_.test_all(std::move(numbers));
  recorder_.set_state(DesignState::Testing);
  recorder_.record_state();
  want_tests(tasks);
}

void DesignRunner::want_tests(std::vector<Task>& tasks) {
  batch_ = Batch(tests_.begin());
  for (std::size_t i = 0; i < batch_.experiments().size(); ++i) {
    const Experiment& run = batch_.experiments()[i];
    const Purpose purpose = tests_.purpose_of(run.pair);
    recorder_.record_pair(purpose, run);
    want(i, key_of(purpose, run), run, tasks);
  }
}

/// The numbers of these calls follow those of the race's calls.
void DesignRunner::want_test_calls(std::vector<Task>& tasks) {
  std::vector<Experiment> calls = tests_.calls();
  for (Experiment& call : calls)
    call.pair = call.task = calls_.pair_in_tests(call.pair);
  calls_.begin_tests(tests_.count());
  batch_ = Batch(std::move(calls));
  for (std::size_t i = 0; i < batch_.experiments().size(); ++i) {
    const Experiment& call = batch_.experiments()[i];
    recorder_.record_pair(Purpose::Evaluator, call);
    want(i, key_of(Purpose::Evaluator, call), call, tasks);
  }
}

void DesignRunner::want(std::size_t position, const EvaluationKey& key,
                        const Experiment& experiment, std::vector<Task>& tasks) {
  const StoredScore* stored = scores_.stored(key);
  // The race would have bounded this run differently, so the stored race is another one.
  if (stored != nullptr && stored->bound != experiment.bound && !fault_)
    fault_ = recorder_.other_step();
  // Keys have a limited number of digits for the pair.
  if (key.pair >= kPairsPerCandidate && !fault_) fault_ = beyond("pairs", kPairsPerCandidate - 1);
  // A known score is never evaluated again. This is the replay, and the use of what was computed
  // ahead.
  if (const auto score = scores_.take(key)) {
    batch_.put(position, *score);
    if (key.purpose == Purpose::Race) recorder_.record_use(*score);
    return;
  }
  batch_.await(position, key);
  // It may be with a worker already, as look-ahead: then the pool promotes it.
  if (key.purpose == Purpose::Race) ahead_.want(key);
  Task task = task_of(key, experiment);
  if (experiment.is_evaluation) {
    task.alive = state() == DesignState::Testing ? tests_.tested() : search_->alive();
    return calls_.add(std::move(task));
  }
  tasks.push_back(std::move(task));
}

EvaluationKey DesignRunner::key_of(Purpose purpose, const Experiment& experiment) const {
  return {recorder_.candidate(experiment.configuration), purpose, experiment.pair};
}

std::optional<Task> DesignRunner::task_of(const EvaluationKey& key) const {
  const std::int64_t number = number_of(key.candidate);
  if (number > recorder_.n_candidates()) return std::nullopt;
  if (is_of_tests(key.purpose) && key.pair > 0 && key.pair <= tests_.pairs() &&
      key.purpose == tests_.purpose_of(key.pair))
    return task_of(key, tests_.run(number, key.pair));
  const auto pair = pairs_.find(key.pair);
  if (key.purpose != Purpose::Race || pair == pairs_.end()) return std::nullopt;
  Experiment experiment = pair->second;
  experiment.configuration = number;
  return task_of(key, experiment);
}

Task DesignRunner::task_of(const EvaluationKey& key, const Experiment& experiment) const {
  const bool is_transfer = key.purpose == Purpose::Transfer;
  return {{.mission = plan_.mission,
           .method = plan_.method,
           .profile = is_transfer ? static_cast<std::uint32_t>(tests_.profile_of(key.pair)) : 0,
           .instance = experiment.instance,
           .seed = experiment.seed,
           .machine = call_of(experiment.configuration),
           .bound = experiment.bound},
          key};
}

/// The last race and the tests may use candidates of any iteration.
std::string DesignRunner::call_of(std::int64_t number) const {
  const auto known = call_texts_.find(number);
  SWARMSMITH_ASSERT(known != call_texts_.end() || search_,
                    "the text of a design without a search is stored");
  return known != call_texts_.end() ? known->second
                                    : plan_.describe(search_->configuration(number)).call;
}

void DesignRunner::tell(const Outcome& outcome, std::vector<Row>& rows) {
  if (outcome.key.purpose == Purpose::Race) {
    // The race does not wait for it. It is stored without an iteration, until the race asks for it.
    if (const auto bound = ahead_.remove(outcome.key)) {
      scores_.keep(score_of(outcome, *bound));
      rows.emplace_back(evaluation_row(outcome, 0, *bound, plan_.source));
      return;
    }
  }
  const StoredScore score = batch_.answer(outcome);
  if (is_of_tests(outcome.key.purpose)) scores_.keep(score);
  if (outcome.key.purpose == Purpose::Evaluator) calls_.finish();
  const bool is_raced = outcome.key.purpose == Purpose::Race;
  const bool is_transfer = outcome.key.purpose == Purpose::Transfer;
  rows.emplace_back(
      evaluation_row(outcome, is_raced ? recorder_.counted_iteration() : 0, score.bound,
                     is_transfer ? tests_.source_of(outcome.key.pair) : plan_.source));
}

void DesignRunner::look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks,
                              std::vector<Row>& rows) {
  // Tests are all wanted at once, so there is nothing ahead of them.
  if (state() != DesignState::Racing) return;
  if (pairs > ahead_.pairs_expected()) ahead_.expect(search_->ahead(pairs), pairs);
  while (count > 0) {
    const Experiment* experiment = ahead_.next();
    if (experiment == nullptr) break;
    pairs_.try_emplace(experiment->pair, *experiment);
    recorder_.record_pair(Purpose::Race, *experiment);
    const EvaluationKey key = key_of(Purpose::Race, *experiment);
    // A dropped task may still be running on a worker, so it is not handed out again.
    if (scores_.contains(key) || ahead_.contains(key)) continue;
    ahead_.add(key, experiment->bound);
    tasks.push_back(task_of(key, *experiment));
    tasks.back().ahead = true;
    --count;
  }
  recorder_.move_rows_to(rows);
}

Expected<void> DesignRunner::tell_race() {
  // A targetEvaluator's runs are all used, and the step comes after it has given their scores.
  if (!plan_.scenario.target_evaluator)
    given_.insert(given_.end(), batch_.scores().begin(), batch_.scores().end());
  search_->tell(batch_.measurements());
  return take_events();
}

Expected<void> DesignRunner::take_events() {
  bool is_reported = search_->finished();
  for (const RaceEvent& event : search_->take_events()) {
    auto taken = std::visit(Overloaded{[&](const ConfigurationSampled& sampled) -> Expected<void> {
                                         return add_candidate(sampled);
                                       },
                                       [&](const IterationStarted& started) -> Expected<void> {
                                         recorder_.record_iteration(started);
                                         return {};
                                       },
                                       [&](const RaceStep& step) {
                                         is_reported = true;
                                         count_used(step.evaluated);
                                         return recorder_.record_step(step);
                                       },
                                       [&](const IterationEnded& ended) -> Expected<void> {
                                         end_iteration(ended);
                                         return {};
                                       },
                                       [&](const TimeEstimated& estimated) -> Expected<void> {
                                         is_reported = true;
                                         if (!estimated.evaluated.empty())
                                           count_used(estimated.evaluated);
                                         recorder_.record_estimate(estimated);
                                         return {};
                                       },
                                       [&](const RaceWarning& warning) -> Expected<void> {
                                         recorder_.record_warning(warning.text);
                                         return {};
                                       },
                                       [&](const RaceFinished& finished) -> Expected<void> {
                                         recorder_.set_reason(finished.reason);
                                         return {};
                                       }},
                            event);
    if (!taken) return taken;
  }
  // With capping, a step may take several batches, and only at its end is a score known to be
  // unused.
  if (!is_reported) return {};
  for (const StoredScore& score : std::exchange(given_, {}))
    leave_unused(score);
  return {};
}

Expected<void> DesignRunner::add_candidate(const ConfigurationSampled& sampled) {
  // Ids of candidates have a limited number of digits within a design.
  if (sampled.id > kCandidatesPerDesign)
    return Unexpected(beyond("candidates", kCandidatesPerDesign));
  CandidateText text = plan_.describe(sampled.configuration);
  call_texts_[sampled.id] = text.call;
  recorder_.record_candidate(sampled, std::move(text));
  return {};
}

/// The error if the budget was enough for more than a store can number.
Error DesignRunner::beyond(const std::string& what, std::int64_t most) const {
  return {ErrorKind::BadInput,
          fmt::format("the design needs more than {} {}, the most that it can have: give a smaller "
                      "budget",
                      most, what),
          to_string(id())};
}

/// The race's data is kept only for the elites, so that memory does not grow with the budget.
void DesignRunner::end_iteration(const IterationEnded& ended) {
  recorder_.record_end(ended);
  std::vector<std::int64_t> elites;
  for (const Elite& elite : ended.elites)
    elites.push_back(elite.configuration);
  passed_ =
      PassedCandidates{.design = id(), .before = recorder_.candidate(recorder_.n_candidates() + 1)};
  const std::set<std::int64_t> kept(elites.begin(), elites.end());
  for (const std::int64_t number : kept)
    passed_->kept.push_back(recorder_.candidate(number));
  std::erase_if(call_texts_, [&](const auto& known) { return !kept.contains(known.first); });
  tests_.add_elites(std::move(elites));
}

void DesignRunner::count_used(const std::vector<std::pair<std::int64_t, std::int64_t>>& used) {
  if (plan_.scenario.target_evaluator) return count_judged();
  for (const auto& [configuration, pair] : used) {
    const EvaluationKey key{recorder_.candidate(configuration), Purpose::Race, pair};
    // A race reports the runs that it used in the order in which it asked for them. With capping it
    // may have asked for runs that it does not use.
    while (!given_.empty() && given_.front().key != key) {
      leave_unused(given_.front());
      given_.pop_front();
    }
    SWARMSMITH_ASSERT(!given_.empty(), "a race uses what it asked for, in that order");
    const StoredScore score = given_.front();
    given_.pop_front();
    if (score.status == EvaluationStatus::Ok)
      recorder_.record_run(configuration, to_score(to_cost(score.measured.score)));
  }
}

/// Records costs that replace those of earlier evaluator calls.
void DesignRunner::count_judged() {
  SWARMSMITH_ASSERT(batch_.scores().size() == batch_.experiments().size(), "each call has a word");
  for (std::size_t i = 0; i < batch_.experiments().size(); ++i) {
    const Experiment& experiment = batch_.experiments()[i];
    const StoredScore& score = batch_.scores()[i];
    if (!experiment.is_evaluation || score.status != EvaluationStatus::Ok) continue;
    recorder_.record_judged(experiment.configuration, experiment.pair,
                            to_score(to_cost(score.measured.score)));
  }
}

/// The race may want the score again in a later iteration.
void DesignRunner::leave_unused(const StoredScore& score) {
  recorder_.record_unused(score.key);
  scores_.keep(score);
}

}  // namespace swarmsmith
