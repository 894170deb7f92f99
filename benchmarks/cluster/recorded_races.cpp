#include "benchmarks/cluster/recorded_races.h"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <span>
#include <sstream>

#include "base/rng.h"
#include "storage/rows.h"

namespace swarmsmith::bench {

Expected<std::vector<RecordedRace>> read_races(const std::filesystem::path& file) {
  std::ifstream lines(file);
  std::string line;
  std::vector<RecordedRace> races;
  std::getline(lines, line);  // the head
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

RecordedRaces::RecordedRaces(const std::vector<RecordedRace>& races, int designs, int open_at_once)
    : open_at_once_(static_cast<std::size_t>(open_at_once)) {
  for (int i = 0; i < designs; ++i) {
    designs_.push_back({.race = &races[static_cast<std::size_t>(i) % races.size()]});
    for (const RecordedTest& test : *designs_.back().race)
      total_ += test.evaluated;
  }
  open();
}

void RecordedRaces::open() {
  while (opened_ < designs_.size() && opened_ - ended_ < open_at_once_)
    go_on(opened_++);
}

void RecordedRaces::go_on(std::size_t number) {
  Design& design = designs_[number];
  while (design.awaited == 0) {
    if (design.next_test == design.race->size()) {
      ++ended_;
      return;
    }
    const RecordedTest& test = (*design.race)[design.next_test++];
    if (test.iteration != design.iteration) begin_iteration(number, test);
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

/// On as many pairs as the evaluations need; elites, who live longest, have been on older ones.
void RecordedRaces::want(std::size_t number, const RecordedTest& test) {
  constexpr std::size_t kMachineBytes = 160;
  Design& design = designs_[number];
  const DesignId id{static_cast<std::int64_t>(number) + 1};
  const std::int64_t pairs = (test.evaluated + test.alive - 1) / test.alive;
  for (std::int64_t p = 0; p < pairs; ++p) {
    const std::int64_t width = test.evaluated / pairs + (p < test.evaluated % pairs ? 1 : 0);
    std::vector<std::int64_t> who(design.by_rank.begin() + (test.alive - width),
                                  design.by_rank.begin() + test.alive);
    std::ranges::sort(who);
    const std::int64_t pair = ++design.pairs;
    for (const std::int64_t candidate : who) {
      tasks_.push_back({.key = {candidate_id(id, candidate + 1), Purpose::Race, pair},
                        .seed = static_cast<std::int64_t>(number) << 40U | candidate << 20U | pair,
                        .machine = std::string(kMachineBytes, 'x')});
    }
  }
  design.awaited = test.evaluated;
}

void RecordedRaces::tell(const Outcome& outcome) {
  ++told_;
  rows_.emplace_back(EvaluationRow{.key = outcome.key,
                                   .iteration = 1,
                                   .status = outcome.status,
                                   .score = outcome.score,
                                   .state_digest = outcome.state_digest,
                                   .source = "recorded",
                                   .wall_us = outcome.wall_us,
                                   .worker = outcome.worker,
                                   .attempt = outcome.attempt});
  const auto number = static_cast<std::size_t>(design_of(outcome.key.candidate).value - 1);
  if (--designs_[number].awaited > 0) return;
  go_on(number);
  open();
}

}  // namespace swarmsmith::bench
