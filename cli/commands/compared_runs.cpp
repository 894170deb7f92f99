#include "cli/commands/compared_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/text/json.h"

namespace swarmsmith::cli {
namespace {

/// Runs in memory at a time.
constexpr std::size_t kBatch = 64;

/// A sentence if the run differs from the stored one; else nothing.
std::optional<std::string> objection(const StoredRun& run, const Again& again) {
  if (again.end == Again::End::Scored) {
    if (run.outcome && same_bits(*run.outcome, again.result)) return std::nullopt;
    return difference_text(run, again.result);
  }
  if (run.rejected) return std::nullopt;
  const std::string stored =
      run.outcome ? values_text(run.outcome->score, run.outcome->state_digest) : "no score";
  return name_of(run) +
         (again.end == Again::End::Killed ? ": the replay kills its process"
                                          : ": the replay gives no score") +
         "; the store holds " + stored + run.given_by();
}

}  // namespace

std::string name_of(const StoredRun& run) {
  return run.id.empty() ? run.candidate + ", seed " + std::to_string(run.seed) : run.id;
}

std::string values_text(double score, std::uint64_t digest) {
  return fmt::format("score {}, state digest {:016x}", json_number(score), digest);
}

std::string difference_text(const StoredRun& run, const Measured& result) {
  std::string text = name_of(run) + ": the replay gives " +
                     values_text(result.score, result.state_digest) + "; the store holds ";
  text += run.outcome ? values_text(run.outcome->score, run.outcome->state_digest) : "a rejection";
  text += run.given_by();
  const std::string older =
      other_engine(run.engine_version, engine_version_of(run.mission, run.profile));
  if (!older.empty()) text += "; " + older;
  return text;
}

Expected<std::vector<Difference>> compare_again(StoredRuns& runs, std::span<const std::string> ids,
                                                Counter& counter) {
  const EvaluateRun evaluate = [](const StoredRun& run) { return simulate(run.setup()); };
  std::vector<Difference> different;
  const auto of = static_cast<std::int64_t>(ids.size());
  for (std::size_t begin = 0; begin < ids.size(); begin += kBatch) {
    counter.tell(static_cast<std::int64_t>(begin), of);
    std::vector<StoredRun> batch;
    for (const std::string& id : ids.subspan(begin, std::min(kBatch, ids.size() - begin))) {
      auto run = runs.evaluation(*parse_thing_id(id));
      if (run) {
        batch.push_back(std::move(*run));
      } else {
        different.push_back({id, "cannot be evaluated again: " + to_string(run.error())});
      }
    }
    const auto again = evaluate_apart(batch, evaluate);
    if (!again) return Unexpected(again.error());
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (auto sentence = objection(batch[i], (*again)[i]))
        different.push_back({batch[i].id, std::move(*sentence)});
    }
  }
  counter.tell(of, of);
  return different;
}

}  // namespace swarmsmith::cli
