#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/design/campaign_runner.h"
#include "coordinator/pool/task_key.h"
#include "tests/cluster/simulated_disk.h"
#include "tests/support/truth.h"

namespace swarmsmith::cluster {

struct CampaignShape {
  std::uint64_t seed = 1;
  int designs = 2;
  std::int64_t budget = 54;  ///< of each design; the least that three iterations need
  std::int64_t tests = 3;    ///< of each winner
  bool failing = false;      ///< a few evaluations fail
  bool killing = false;      ///< and a few kill
  bool hopeless = false;     ///< every evaluation of the last design fails
  /// A preset of docs/methods.md; empty: iterated races over three parameters.
  std::string preset{};
};

/// The presets, each with the least budget that lets it show what it does.
struct PresetBudget {
  std::string_view preset;
  std::int64_t budget = 0;
};
inline void PrintTo(const PresetBudget& preset, std::ostream* out) {
  *out << preset.preset;
}
inline constexpr std::array kPresetBudgets = {
    PresetBudget{"random", 54}, PresetBudget{"vanilla", 54}, PresetBudget{"evostick", 54},
    PresetBudget{"cma-es", 54}, PresetBudget{"icepop", 90},  PresetBudget{"maple", 90}};

/// The outcome of an evaluation: a pure function.
Truth truth_of(const CampaignShape& shape, const EvaluationInput& input);

/// The designs of the campaign: real races over three parameters, or the preset's real search in
/// its real space.
std::vector<DesignPlan> plans_of(const CampaignShape& shape);

/// The real searches behind the interface that the coordinator sees, watched: what is asked or told
/// twice is a complaint, as is any error.
class RacedCampaign final : public WorkSource {
 public:
  /// Goes on where the disk stands, as `swarmsmith run` does with a store.
  RacedCampaign(const CampaignShape& shape, const SimulatedDisk& disk);
  RacedCampaign(const CampaignShape& shape, std::map<DesignId, StoredDesign> stored,
                std::vector<DesignId> finished);

  std::vector<Task> take_tasks() override;
  std::vector<Task> take_more(std::size_t count, std::size_t slots) override;
  std::vector<EvaluationKey> take_dropped() override { return runner_.take_dropped(); }
  std::vector<DesignId> take_ended() override;
  std::vector<PassedCandidates> take_passed() override;
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override { return runner_.take_rows(); }
  bool finished() const override { return runner_.finished(); }
  std::vector<DesignId> unfinished() const override { return runner_.unfinished(); }

  /// What is asked for from now on is written there with its outcome.
  void watch(std::map<PackedKey, Truth>& truths) { truths_ = &truths; }

  std::string complaint() const;
  /// Of a design that is over, and was not reported: it need not be kept.
  bool is_void(PackedKey key) const;

 private:
  /// What is known of an evaluation that was asked for.
  struct Asked {
    bool ahead = false;  ///< it is not wanted yet
    bool told = false;
  };
  void note(const Task& task);

  CampaignShape shape_;
  CampaignRunner runner_;
  std::map<PackedKey, Asked> asked_;
  std::map<PackedKey, Truth>* truths_ = nullptr;
  std::set<DesignId> ended_;
  std::map<DesignId, PassedCandidates> passed_;  ///< the last of each
  std::string complaint_;
};

/// The disk after a campaign that nothing disturbed; empty when that failed.
SimulatedDisk undisturbed(const CampaignShape& shape);

}  // namespace swarmsmith::cluster
