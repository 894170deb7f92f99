#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/design/work_source.h"
#include "coordinator/pool/task_key.h"
#include "tests/support/truth.h"

namespace swarmsmith::cluster {

struct CampaignShape {
  std::uint64_t seed = 1;
  int designs = 2;
  int candidates = 8;
  int steps = 9;
  bool failing = false;  ///< one evaluation of the first design fails
  bool killing = false;  ///< one evaluation of the last design kills
};

/// The outcome of a task, a pure function of the campaign and the task's key.
Truth truth_of(const CampaignShape& shape, const EvaluationKey& key);

/// Races in small: each step evaluates the candidates that are left on one pair, then the worst by
/// the sum of its scores so far is dropped, so that what is asked for next depends on every bit.
/// Rejected candidates are dropped at once.
class SyntheticCampaign final : public WorkSource {
 public:
  explicit SyntheticCampaign(const CampaignShape& shape);

  std::vector<Task> take_tasks() override;
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override;
  bool finished() const override;
  /// All of them, until the last one is over.
  std::vector<DesignId> unfinished() const override;

  /// Every step's survivors and every score that was used, as text with all bits.
  std::string dump() const;
  /// What was wrong with how it was used: told twice, or told what was never asked.
  const std::string& complaint() const { return complaint_; }

 private:
  struct Race {
    int step = 0;
    std::vector<std::int64_t> alive;  ///< numbers of candidates
    std::map<std::int64_t, double> sums;
    std::map<std::int64_t, std::optional<double>> scores;  ///< of this step; none: rejected
    std::string log;
  };

  EvaluationKey key_of(std::size_t design, std::int64_t candidate) const;
  /// The next step.
  void ask(std::size_t design);
  void put(std::size_t design, const EvaluationKey& key, EvaluationStatus status, double score);
  void decide(std::size_t design);

  CampaignShape shape_;
  std::vector<Race> races_;
  std::map<PackedKey, bool> asked_;  ///< whether it was told
  std::vector<Task> tasks_;
  std::vector<Row> rows_;
  std::string complaint_;
};

/// The dump of a campaign that nothing disturbed.
std::string undisturbed_dump(const CampaignShape& shape);

}  // namespace swarmsmith::cluster
