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

/// Limits on a campaign's designs in memory; one with 100,000 experiments takes about 40 MB.
struct OpenDesigns {
  /// This many designs race at the same time, whatever the number of workers: with a single one,
  /// slots would idle at each of its barriers (docs/decisions/0008).
  std::size_t at_least = 4;
  /// At most this many designs race at the same time, if slots would idle otherwise.
  std::size_t at_most = 64;
  /// The latest finished designs are kept, so that they can get more budget without a restart: at
  /// most `finished` of them, with at most `finished_experiments` experiments together, but always
  /// the last one.
  std::size_t finished = 8;
  std::int64_t finished_experiments = 100'000;
};

/// All designs of a campaign as one source of work: opens as many of them, in order, as are needed
/// to keep the slots busy, and passes outcomes and commands to their designs. A pure state machine.
class CampaignRunner final : public WorkSource {
 public:
  /// The largest number of pairs for which a design is asked to look ahead of its race.
  static constexpr std::int64_t kMostPairsAhead = 64;

  /// `stored` contains the stored scores and steps of unfinished designs; `finished` the designs
  /// that need nothing more (see `ended_designs`); `commands` all commands in the store. A plan is
  /// started when its design is opened; the first error stops the campaign, see `error`.
  CampaignRunner(std::vector<DesignPlan> plans, std::map<DesignId, StoredDesign> stored,
                 const std::vector<DesignId>& finished,
                 const std::vector<CommandRow>& commands = {}, OpenDesigns most = {});

  std::vector<Task> take_tasks() override;
  /// First opens designs, up to one for every six slots. Then asks all racing designs to look ahead
  /// by one pair, starting with the design that is nearest to a barrier. Then it opens designs up
  /// to the limit, and finally looks ahead by more pairs.
  std::vector<Task> take_more(std::size_t count, std::size_t slots) override;
  std::vector<EvaluationKey> take_dropped() override;
  std::vector<DesignId> take_ended() override { return std::exchange(ended_, {}); }
  std::vector<PassedCandidates> take_passed() override { return std::exchange(passed_, {}); }
  Expected<void> carry_out(const CommandRow& command) override;
  std::optional<Task> task_of(const EvaluationKey& key) const override;
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override;
  bool finished() const override;

  /// A plan that cannot be run, or a store that contradicts the replay.
  std::optional<Error> error() const override { return error_; }
  std::vector<DesignId> unfinished() const override;

 private:
  /// A design that has not been opened yet.
  struct Waiting {
    DesignPlan plan;
    StoredDesign stored;
  };
  /// A task that was still out when its design ended.
  struct Late {
    double bound;
    std::string source;
  };

  /// Opens designs while there are fewer tasks than `count` and fewer open designs than `limit`.
  void open_more(std::size_t count, std::size_t limit, std::vector<Task>& tasks);
  /// Adds look-ahead tasks until there are `count` tasks.
  void look_ahead(std::size_t count, std::int64_t pairs, std::vector<Task>& tasks);
  void open_designs();
  /// Opens the waiting design and removes it from the list.
  void open(std::map<DesignId, Waiting>::iterator next);
  void advance(DesignRunner& design);
  /// The design is over: keeps it for a while, or only its tasks that may still have outcomes.
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
  std::map<DesignId, DesignRunner> kept_;  ///< finished designs
  std::vector<DesignId> kept_order_;       ///< in the order in which they were put away
  std::map<EvaluationKey, Late> late_;
  std::vector<Task> tasks_;
  std::vector<EvaluationKey> dropped_;  ///< of designs that were put away
  std::vector<DesignId> ended_;
  std::vector<PassedCandidates> passed_;
  std::vector<Row> rows_;
  std::optional<Error> error_;
  bool state_recorded_ = false;
};

/// Whether a command asks for more budget that no design has been given yet.
bool waits_for_extension(const std::vector<CommandRow>& commands);

/// The designs that need nothing more: finished designs without a pending extension. A cancelled
/// design is not included; it is replayed up to its end, which costs little.
std::vector<DesignId> ended_designs(const std::vector<DesignStateRow>& states,
                                    const std::vector<CommandRow>& commands);

/// A store's scores and steps, sorted by design; without the designs in `finished`, and without
/// scores that no race asked for (audits, later scorings).
std::map<DesignId, StoredDesign> by_design(const std::vector<StoredScore>& scores,
                                           const std::vector<StoredStep>& steps,
                                           const std::vector<DesignId>& finished);

/// The commands for one design that its race carries out, in the form that a plan takes.
std::vector<CommandRow> commands_to(DesignId design, const std::vector<CommandRow>& commands);

}  // namespace swarmsmith
