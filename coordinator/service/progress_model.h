#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/campaign/campaign_rows.h"
#include "irace_core/search/stage.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith {

/// The progress of a design, as every output shows it, for a running campaign or from its store.
struct DesignStatus {
  DesignId id;
  std::string mission{};
  std::string method{};
  std::int64_t repetition = 0;
  DesignState state = DesignState::Waiting;
  std::int64_t used = 0;     ///< experiments, up to its race's last step
  std::int64_t in_step = 0;  ///< evaluated since the last step: the next step counts them as used
  std::int64_t budget = 0;   ///< includes later extensions
  std::int64_t iteration = 0;
  CandidateId best{};
  double best_mean = 0;  ///< in the race
  double test_mean = 0;  ///< mean of the winner's tests on fresh seeds, once the design is finished
  std::int64_t test_runs = 0;
  bool paused = false;   ///< its tasks are not leased until a person resumes it
  std::string reason{};  ///< why it ended
  /// The stage of its search in words for people, and the search's name
  /// (irace_core/search/stage.h); both are empty for an iterated race, and then not in the JSON.
  std::string stage{};
  std::string search{};

  /// The budget that its race may still use. A race that is over uses no more, even if its budget
  /// is not used up.
  std::int64_t left() const;
  /// How good the best candidate is: the mean of its tests if there are any, because the race's
  /// pairs are biased towards the candidate that they selected; before that, the mean in the race.
  bool is_tested() const { return state == DesignState::Finished && test_runs > 0; }
  double told_mean() const { return is_tested() ? test_mean : best_mean; }
};

/// Sums over the designs of one or several campaigns. They are computed only here.
struct CampaignTotals {
  std::int64_t designs = 0;
  std::int64_t finished = 0;
  std::int64_t stopped = 0;
  std::int64_t paused = 0;  ///< designs that are paused and not over
  std::int64_t used = 0;
  std::int64_t in_step = 0;
  std::int64_t budget = 0;
  std::int64_t left = 0;

  bool are_over() const { return finished + stopped == designs; }
  void add(const DesignStatus& design);
};
CampaignTotals totals_of(std::span<const DesignStatus> designs);

/// The progress of a design as its rows come in: besides its status, the stage of its search.
struct DesignProgress : DesignStatus {
  std::int64_t iterations = 0;  ///< as planned when the iteration began
  std::int64_t configurations = 0;
  std::int64_t alive = 0;
  /// None for an iterated race; SearchPoint describes the other searches.
  std::optional<SearchOptions> options{};
  bool is_final = false;         ///< whether the iteration is the final stage
  std::int64_t extensions = 0;   ///< extensions that have taken effect; each follows a final stage
  std::int64_t wanted = 0;       ///< runs of the iteration
  std::int64_t used_before = 0;  ///< runs used by the iterations before it
  std::int64_t step = 0;
  std::map<CandidateId, TestedDesign> tests{};
  bool has_evaluator = false;  ///< another program computes the scores of the tests
};

/// For the functions of irace_core/search/stage.h; only for designs with another search than irace.
SearchPoint point_of(const DesignProgress& progress);
/// The stage of the search; empty for an iterated race, and before the first iteration.
std::string stage_of(const DesignProgress& progress);
/// The state in words for people: a search without tests is not called a race.
std::string_view shown_state(const DesignProgress& progress, DesignState state);

/// The progress of a campaign, updated from its rows: first the states and commands in its store,
/// then all rows as they are written. Rows of designs that were not passed to the constructor are
/// ignored. Pure.
class ProgressModel {
 public:
  /// `costs`: programs evaluate, and people want to see the costs that they print.
  explicit ProgressModel(std::span<const DesignRow> designs, bool costs = false,
                         const Searches& searches = {});

  void add(const Row& row);
  /// Adds tests that were run before this process; their rows do not come again.
  void add(const TestedDesign& tested);
  /// The process ends: evaluations of unfinished steps count only when their steps are done.
  void drop_open_steps();

  bool shows_costs() const { return costs_; }
  /// Sorted by id.
  const std::map<DesignId, DesignProgress>& by_design() const { return designs_; }
  const DesignProgress& design(DesignId id) const { return designs_.at(id); }
  CampaignTotals totals() const;
  /// Sorted by id, each with its stage.
  std::vector<DesignStatus> designs() const;
  /// The first design that is not over, or else the last one; the status line shows it.
  const DesignProgress* current() const;

 private:
  void add(DesignProgress& progress, const Row& row);
  static void tell_tests(DesignProgress& progress);
  static void add_test(DesignProgress& progress, const EvaluationRow& row);
  static void add_state(DesignProgress& progress, const DesignStateRow& row);
  void add_command(DesignProgress& progress, const CommandRow& row);

  std::map<DesignId, DesignProgress> designs_;
  bool costs_;
  std::set<std::int64_t> extensions_;  ///< numbers of the commands that have taken effect
};

}  // namespace swarmsmith
