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

/// How far a design is, as every output says it: of a campaign that runs, or from its store.
struct DesignStatus {
  DesignId id;
  std::string mission{};
  std::string method{};
  std::int64_t repetition = 0;
  DesignState state = DesignState::Waiting;
  std::int64_t used = 0;     ///< experiments, as of its race's last step
  std::int64_t in_step = 0;  ///< evaluated since then: the next step counts them as used
  std::int64_t budget = 0;   ///< with what was given to it later
  std::int64_t iteration = 0;
  CandidateId best{};
  double best_mean = 0;  ///< in the race
  double test_mean = 0;  ///< of the winner's tests on fresh seeds, once the design is finished
  std::int64_t test_runs = 0;
  bool paused = false;   ///< nothing of it is leased until a person resumes it
  std::string reason{};  ///< why it ended
  /// Where its search is, as people read it, and the search's name (irace_core/search/stage.h);
  /// empty for an iterated race, and then not in the JSON.
  std::string stage{};
  std::string search{};

  /// What its race may still use. One that is over uses no more, whatever its budget has left.
  std::int64_t left() const;
  /// How good the best is: as its tests say, since the race's pairs chose it; before them the race.
  bool is_tested() const { return state == DesignState::Finished && test_runs > 0; }
  double told_mean() const { return is_tested() ? test_mean : best_mean; }
};

/// Sums over designs: of a campaign, or of several. The only place where they are made.
struct CampaignTotals {
  std::int64_t designs = 0;
  std::int64_t finished = 0;
  std::int64_t stopped = 0;
  std::int64_t paused = 0;  ///< that are not over
  std::int64_t used = 0;
  std::int64_t in_step = 0;
  std::int64_t budget = 0;
  std::int64_t left = 0;

  bool are_over() const { return finished + stopped == designs; }
  void add(const DesignStatus& design);
};
CampaignTotals totals_of(std::span<const DesignStatus> designs);

/// What is known of a design while its rows pass: besides its status, the point of its search.
struct DesignProgress : DesignStatus {
  std::int64_t iterations = 0;  ///< as planned when the iteration began
  std::int64_t configurations = 0;
  std::int64_t alive = 0;
  /// None for an iterated race; SearchPoint has the others.
  std::optional<SearchOptions> options{};
  bool is_final = false;         ///< the iteration is the final stage
  std::int64_t extensions = 0;   ///< that have acted: each follows a final stage
  std::int64_t wanted = 0;       ///< runs of the iteration
  std::int64_t used_before = 0;  ///< by the iterations before it
  std::int64_t step = 0;
  std::map<CandidateId, TestedDesign> tests{};
  bool has_evaluator = false;  ///< another program says what the tests' scores are
};

/// As the words of irace_core/search/stage.h take it; only of designs with a search of their own.
SearchPoint point_of(const DesignProgress& progress);
/// Where the search is; empty for an iterated race, and before the first iteration.
std::string stage_of(const DesignProgress& progress);
/// The state as people read it: nothing races where nothing is tested.
std::string_view shown_state(const DesignProgress& progress, DesignState state);

/// How far a campaign is, kept up from its rows: those that its store has, states and commands,
/// then all that are written. Rows of designs that it was not made with are left out. Pure.
class ProgressModel {
 public:
  /// With `costs` programs evaluate, and people want to see the costs that they print.
  explicit ProgressModel(std::span<const DesignRow> designs, bool costs = false,
                         const Searches& searches = {});

  void add(const Row& row);
  /// Tests from before this process: their rows do not come again.
  void add(const TestedDesign& tested);
  /// The process ends: what steps had begun counts when they are done.
  void drop_open_steps();

  bool shows_costs() const { return costs_; }
  /// By id.
  const std::map<DesignId, DesignProgress>& by_design() const { return designs_; }
  const DesignProgress& design(DesignId id) const { return designs_.at(id); }
  CampaignTotals totals() const;
  /// By id, each with its stage.
  std::vector<DesignStatus> designs() const;
  /// The first design that is not over, else the last one: what the status line tells about.
  const DesignProgress* current() const;

 private:
  void add(DesignProgress& progress, const Row& row);
  static void tell_tests(DesignProgress& progress);
  static void add_test(DesignProgress& progress, const EvaluationRow& row);
  static void add_state(DesignProgress& progress, const DesignStateRow& row);
  void add_command(DesignProgress& progress, const CommandRow& row);

  std::map<DesignId, DesignProgress> designs_;
  bool costs_;
  std::set<std::int64_t> extensions_;  ///< numbers of those that have acted
};

}  // namespace swarmsmith
