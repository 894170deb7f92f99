#include "coordinator/design/verify_real_runs.h"

#include <fmt/format.h>

#include "coordinator/results/filmed_run.h"

namespace swarmsmith {
namespace {

/// What is wrong with a run that has a score; empty when nothing is.
std::string complaint_about(StoreReader& store, const RealRunHead& head) {
  const auto rows = store.real_run(head.id);
  if (!rows) return to_string(rows.error());
  const auto run = filmed_run(*rows);
  if (!run) return run.error().message;
  const double again = score_again(*run);
  if (again == *head.score) return {};
  return fmt::format("its cycles score {}, but the store has {}", again, *head.score);
}

}  // namespace

std::int64_t verify_real_runs(StoreReader& store, std::vector<std::string>& complaints) {
  std::int64_t scored = 0;
  for (const RealRunHead& head : store.real_runs()) {
    if (!head.score) continue;
    ++scored;
    const std::string complaint = complaint_about(store, head);
    if (!complaint.empty())
      complaints.push_back(fmt::format("real run {}: {}", to_string(head.id), complaint));
  }
  return scored;
}

}  // namespace swarmsmith
