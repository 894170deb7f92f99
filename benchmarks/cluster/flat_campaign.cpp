#include "benchmarks/cluster/flat_campaign.h"

#include "storage/rows.h"

namespace swarmsmith::bench {
namespace {

constexpr std::int64_t kPerCandidate = 100;
/// The usual length of a machine's text.
constexpr std::size_t kMachineBytes = 160;

}  // namespace

std::vector<Task> FlatCampaign::take_tasks() {
  std::vector<Task> tasks;
  while (asked_ < total_ && asked_ - told_ < window_) {
    const std::int64_t i = asked_++;
    const DesignId design{i / kPerDesign + 1};
    const CandidateId candidate = candidate_id(design, i % kPerDesign / kPerCandidate + 1);
    if (i % kPerCandidate == 0) {
      rows_.emplace_back(std::in_place_type<CandidateRow>);
      auto& row = std::get<CandidateRow>(rows_.back());
      row.id = candidate;
      row.iteration = 1;
      row.parameters = "{}";
      row.modules = "{}";
    }
    tasks.push_back({{.seed = i, .machine = std::string(kMachineBytes, 'x')},
                     {candidate, Purpose::Race, i % kPerCandidate + 1}});
  }
  return tasks;
}

void FlatCampaign::tell(const Outcome& outcome) {
  ++told_;
  const DesignId design = design_of(outcome.key.candidate);
  if (--left_[static_cast<std::size_t>(design.value - 1)] == 0) ended_.push_back(design);
  rows_.emplace_back(EvaluationRow{.key = outcome.key,
                                   .iteration = 1,
                                   .status = outcome.status,
                                   .measured = outcome.measured,
                                   .source = "rvr",
                                   .worker = outcome.worker,
                                   .attempt = outcome.attempt});
}

}  // namespace swarmsmith::bench
