#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/design_runner.h"
#include "coordinator/design/work_source.h"

namespace swarmsmith {

/// How many designs a campaign holds in memory; one of 100,000 experiments takes some 40 MB.
struct OpenDesigns {
  /// Race at the same time whatever the workers: one alone leaves slots idle at each of its
  /// barriers (docs/decisions/0008).
  std::size_t at_least = 4;
  /// Race at the same time when slots would idle otherwise.
  std::size_t at_most = 64;
  /// Finished ones, the latest, that can be given more budget without a restart: so many at most,
  /// and so many that their races are no longer together than this, but always the last one.
  std::size_t finished = 8;
  std::int64_t finished_experiments = 100'000;
};

/// All designs of a campaign as one source of work: opens them in order, as many as it takes to
/// keep the slots busy, and passes outcomes and commands on to theirs. A pure state machine.
class CampaignRunner final : public WorkSource {
 public:
  /// How many pairs ahead of its race a design is asked for at most.
  static constexpr std::int64_t kMostPairsAhead = 64;

  /// `stored` holds what is known of unfinished designs; `finished` those that need nothing more
  /// (see `ended_designs`); `commands` all that the store has. Plans are started when they are
  /// opened; the first error stops everything, see `error`.
  CampaignRunner(std::vector<DesignPlan> plans, std::map<DesignId, StoredDesign> stored,
                 const std::vector<DesignId>& finished,
                 const std::vector<CommandRow>& commands = {}, OpenDesigns most = {});

  std::vector<Task> take_tasks() override;
  /// Designs are opened up to one for six slots. Then all that race are looked ahead in by one
  /// pair, first the design that is the nearest to a barrier; then any designs are opened, up to
  /// the limit; then come further pairs.
  std::vector<Task> take_more(std::size_t count, std::size_t slots) override;
  std::vector<EvaluationKey> take_dropped() override;
  std::vector<DesignId> take_ended() override { return std::exchange(ended_, {}); }
  std::vector<PassedCandidates> take_passed() override { return std::exchange(passed_, {}); }
  Expected<void> carry_out(const CommandRow& command) override;
  std::optional<Task> task_of(const EvaluationKey& key) const override;
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override;
  bool finished() const override;

  /// A plan that does not fit, a store that disagrees.
  std::optional<Error> error() const override { return error_; }
  std::vector<DesignId> unfinished() const override;

 private:
  /// A design before its turn.
  struct Waiting {
    DesignPlan plan;
    StoredDesign stored;
  };
  /// A task that was given when its design ended.
  struct Late {
    double bound;
    std::string source;
  };

  /// While there are fewer tasks than `count` and fewer open designs than `limit`.
  void open_more(std::size_t count, std::size_t limit, std::vector<Task>& tasks);
  /// Adds tasks up to `count`.
  void look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks);
  void open_designs();
  /// Starts the design that waits, or the next one.
  void open(std::map<DesignId, Waiting>::iterator next);
  void advance(DesignRunner& design);
  /// The design is over: keeps it for a while, or what may still come of it.
  void put_away(DesignId id);
  bool keeps_too_many() const;
  void forget(const DesignRunner& ended);
  Expected<void> command_waiting(std::map<DesignId, Waiting>::iterator found,
                                 const CommandRow& command);
  Error no_such_design(DesignId id) const;

  OpenDesigns most_;
  std::vector<DesignId> all_;
  std::map<DesignId, Waiting> waiting_;
  std::map<DesignId, DesignRunner> open_;
  std::map<DesignId, DesignRunner> kept_;  ///< finished
  std::vector<DesignId> kept_order_;       ///< of `kept_`, the earliest first
  std::map<EvaluationKey, Late> late_;
  std::vector<Task> tasks_;
  std::vector<EvaluationKey> dropped_;  ///< of designs that were put away
  std::vector<DesignId> ended_;
  std::vector<PassedCandidates> passed_;
  std::vector<Row> rows_;
  std::optional<Error> error_;
  bool state_recorded_ = false;
};

/// Whether somebody asked for more budget that no design was given yet.
bool waits_for_extension(const std::vector<CommandRow>& commands);

/// The designs that need nothing more: finished ones that no extension waits for. A cancelled one
/// is played again up to its end, which costs little.
std::vector<DesignId> ended_designs(const std::vector<DesignStateRow>& states,
                                    const std::vector<CommandRow>& commands);

/// A store's scores and steps, sorted by design, without the designs in `finished` and without
/// scores that no race asked for (audits, later scorings).
std::map<DesignId, StoredDesign> by_design(const std::vector<StoredScore>& scores,
                                           const std::vector<StoredStep>& steps,
                                           const std::vector<DesignId>& finished);

/// The commands to one design that its race obeys, as a plan takes them.
std::vector<CommandRow> commands_to(DesignId design, const std::vector<CommandRow>& commands);

}  // namespace swarmsmith
