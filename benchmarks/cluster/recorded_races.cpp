#include "benchmarks/cluster/recorded_races.h"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <span>
#include <sstream>

#include "base/rng.h"
#include "storage/rows.h"

namespace swarmsmith::bench {
namespace {

std::int64_t pairs_of(const RecordedTest& test) {
  return (test.evaluated + test.alive - 1) / test.alive;
}

}  // namespace

Expected<std::vector<RecordedRace>> read_races(const std::filesystem::path& file) {
  std::ifstream lines(file);
  std::string line;
  std::vector<RecordedRace> races;
  std::getline(lines, line);  // the header line
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::vector<std::string> all;
    while (std::getline(cells, cell, ','))
      all.push_back(cell);
    if (all.size() != 7) return bad_input("no line of recorded races", line);
    const auto number = [&](std::size_t i) { return std::stoll(all[i]); };
    races.resize(static_cast<std::size_t>(number(0)));
    const RecordedTest test{number(2), number(3), number(4), number(5)};
    races.back().insert(races.back().end(), static_cast<std::size_t>(number(6)), test);
  }
  if (races.empty()) return unexpected(ErrorKind::NotFound, "no recorded races", file.string());
  return races;
}

RecordedRaces::RecordedRaces(const std::vector<RecordedRace>& races, int designs, std::size_t ahead)
    : ahead_(ahead) {
  for (int i = 0; i < designs; ++i) {
    Design design{.race = &races[static_cast<std::size_t>(i) % races.size()]};
    std::int64_t pair = 1;
    for (const RecordedTest& test : *design.race) {
      total_ += test.evaluated;
      design.first_pair.push_back(pair);
      pair += pairs_of(test);
    }
    designs_.push_back(std::move(design));
  }
  for (std::size_t i = 0; i < designs_.size(); ++i)
    go_on(i);
}

void RecordedRaces::go_on(std::size_t number) {
  Design& design = designs_[number];
  while (design.awaited == 0) {
    if (design.next_test > 0) {
      ++tests_;
      drop(design, (*design.race)[design.next_test - 1]);
    }
    if (design.next_test == design.race->size()) {
      ++ended_;
      return;
    }
    const std::size_t test = design.next_test++;
    design.offered = std::max(design.offered, design.next_test);
    if ((*design.race)[test].iteration != design.iteration) {
      begin_iteration(number, (*design.race)[test]);
    }
    want(number, test);
  }
}

void RecordedRaces::begin_iteration(std::size_t number, const RecordedTest& test) {
  Design& design = designs_[number];
  design.iteration = test.iteration;
  design.first_candidate = design.candidates;
  design.candidates += test.alive;
  design.by_rank.resize(static_cast<std::size_t>(test.alive));
  std::iota(design.by_rank.begin(), design.by_rank.end(), design.first_candidate);
  Rng(number)
      .split("survivors", static_cast<std::uint64_t>(test.iteration))
      .shuffle(std::span(design.by_rank));
  const DesignId id{static_cast<std::int64_t>(number) + 1};
  for (std::int64_t i = design.first_candidate; i < design.candidates; ++i) {
    rows_.emplace_back(CandidateRow{
        .id = candidate_id(id, i + 1), .iteration = 1, .parameters = "{}", .modules = "{}"});
  }
}

/// The tasks for a test: the evaluations are on as many pairs as they need. Elites, which stay
/// alive longest, have already been evaluated on older pairs.
std::vector<Task> RecordedRaces::tasks_of(std::size_t number, std::size_t test,
                                          std::int64_t alive) const {
  constexpr std::size_t kMachineBytes = 160;
  const Design& design = designs_[number];
  const DesignId id{static_cast<std::int64_t>(number) + 1};
  const RecordedTest& of = (*design.race)[test];
  const std::int64_t pairs = pairs_of(of);
  std::vector<Task> tasks;
  for (std::int64_t p = 0; p < pairs; ++p) {
    const std::int64_t width = of.evaluated / pairs + (p < of.evaluated % pairs ? 1 : 0);
    std::vector<std::int64_t> who(design.by_rank.begin() + (of.alive - width),
                                  design.by_rank.begin() + alive);
    std::ranges::sort(who);
    const std::int64_t pair = design.first_pair[test] + p;
    for (const std::int64_t candidate : who) {
      tasks.push_back({{.seed = static_cast<std::int64_t>(number) << 40U | candidate << 20U | pair,
                        .machine = std::string(kMachineBytes, 'x')},
                       {candidate_id(id, candidate + 1), Purpose::Race, pair}});
    }
  }
  return tasks;
}

void RecordedRaces::want(std::size_t number, std::size_t test) {
  Design& design = designs_[number];
  for (Task& task : tasks_of(number, test, (*design.race)[test].alive)) {
    const auto known = design.ahead.find(task.key);
    if (known != design.ahead.end() && known->second == Ahead::Done) {
      design.ahead.erase(known);
      continue;
    }
    if (known != design.ahead.end()) known->second = Ahead::Wanted;
    ++design.awaited;
    tasks_.push_back(std::move(task));
  }
}

/// Drops the evaluations that were requested ahead for candidates that the test eliminates.
void RecordedRaces::drop(Design& design, const RecordedTest& test) {
  for (std::int64_t rank = test.kept; rank < test.alive; ++rank) {
    const DesignId id{&design - designs_.data() + 1};
    const std::int64_t candidate = design.by_rank[static_cast<std::size_t>(rank)];
    const EvaluationKey first{candidate_id(id, candidate + 1), Purpose::Race, 0};
    for (auto at = design.ahead.lower_bound(first);
         at != design.ahead.end() && at->first.candidate == first.candidate; ++at) {
      if (at->second != Ahead::Asked) continue;
      at->second = Ahead::Dropped;
      dropped_.push_back(at->first);
    }
  }
}

std::vector<Task> RecordedRaces::take_more(std::size_t count, std::size_t /*slots*/) {
  std::vector<Task> more;
  for (std::size_t number = 0; number < designs_.size(); ++number) {
    Design& design = designs_[number];
    if (design.awaited == 0) continue;
    const RecordedTest& now = (*design.race)[design.next_test - 1];
    while (more.size() < count && design.offered < design.race->size() &&
           design.offered < design.next_test + ahead_ &&
           (*design.race)[design.offered].iteration == design.iteration) {
      for (Task& task : tasks_of(number, design.offered, now.alive)) {
        design.ahead.emplace(task.key, Ahead::Asked);
        task.ahead = true;
        more.push_back(std::move(task));
      }
      ++design.offered;
    }
  }
  return more;
}

void RecordedRaces::tell(const Outcome& outcome) {
  ++told_;
  rows_.emplace_back(EvaluationRow{.key = outcome.key,
                                   .iteration = 1,
                                   .status = outcome.status,
                                   .measured = outcome.measured,
                                   .source = "recorded",
                                   .worker = outcome.worker,
                                   .attempt = outcome.attempt});
  const auto number = static_cast<std::size_t>(design_of(outcome.key.candidate).value - 1);
  Design& design = designs_[number];
  if (const auto known = design.ahead.find(outcome.key); known != design.ahead.end()) {
    if (known->second == Ahead::Asked) {
      known->second = Ahead::Done;
      return;
    }
    const bool wanted = known->second == Ahead::Wanted;
    design.ahead.erase(known);
    if (!wanted) return;
  }
  if (--design.awaited == 0) go_on(number);
}

}  // namespace swarmsmith::bench
