#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "coordinator/campaign/campaign_rows.h"
#include "irace_core/search/stage.h"
#include "storage/rows.h"

namespace swarmsmith {

/// How far one design is.
struct DesignProgress {
  DesignRow design;
  DesignState state = DesignState::Waiting;
  std::int64_t iteration = 0;
  std::int64_t iterations = 0;  ///< as planned when the iteration began
  std::int64_t configurations = 0;
  std::int64_t alive = 0;
  std::int64_t used = 0;
  std::int64_t in_step = 0;  ///< evaluations since the race's last step, which counts them as used
  CandidateId best;
  double best_mean = 0;
  bool paused = false;  ///< by a person

  /// None for an iterated race; the others are told of by SearchPoint.
  std::optional<SearchOptions> search{};
  bool is_final = false;         ///< the iteration is the final stage
  std::int64_t extensions = 0;   ///< that have acted: each follows a final stage
  std::int64_t wanted = 0;       ///< runs of the iteration
  std::int64_t used_before = 0;  ///< by the iterations before it
  std::int64_t step = 0;
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

  bool shows_costs() const { return costs_; }
  /// By id.
  const std::map<DesignId, DesignProgress>& by_design() const { return designs_; }
  const DesignProgress& design(DesignId id) const { return designs_.at(id); }
  std::int64_t designs() const { return static_cast<std::int64_t>(designs_.size()); }
  /// Designs that need nothing more.
  std::int64_t finished() const;
  /// Designs that are neither finished nor stopped, and that a person has paused.
  std::int64_t paused() const;
  /// Nothing is left to be done.
  bool is_over() const;
  /// Of `budget`, with what a step has evaluated so far; a design whose race is over counts with
  /// all of its own.
  std::int64_t used() const;
  /// With what was given to designs later.
  std::int64_t budget() const;
  /// The first design that is not over, else the last one: what the status line tells about.
  const DesignProgress* current() const;

 private:
  void add(DesignProgress& progress, const Row& row);
  static void add_state(DesignProgress& progress, const DesignStateRow& row);
  void add_command(DesignProgress& progress, const CommandRow& row);

  std::map<DesignId, DesignProgress> designs_;
  bool costs_;
  std::set<std::int64_t> extensions_;  ///< numbers of those that have acted
};

}  // namespace swarmsmith
