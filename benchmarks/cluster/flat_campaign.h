#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/design/work_source.h"

namespace swarmsmith::bench {

/// Independent tasks without a barrier, with some ten thousand requested at a time, so that only
/// leases, messages and rows cost time. There are a hundred evaluations for each candidate and
/// 100,000 for each design; designs end one after the other.
class FlatCampaign final : public WorkSource {
 public:
  static constexpr std::int64_t kPerDesign = 100'000;

  explicit FlatCampaign(std::int64_t total, std::int64_t window = 10'000)
      : total_(total), window_(window), left_(static_cast<std::size_t>(designs()), kPerDesign) {}

  std::vector<Task> take_tasks() override;
  void tell(const Outcome& outcome) override;
  std::vector<DesignId> take_ended() override { return std::exchange(ended_, {}); }
  std::vector<Row> take_rows() override { return std::exchange(rows_, {}); }
  bool finished() const override { return told_ == total_; }

  std::int64_t told() const { return told_; }
  /// Number of designs that the store must know.
  int designs() const { return static_cast<int>((total_ + kPerDesign - 1) / kPerDesign); }

 private:
  std::int64_t total_;
  std::int64_t window_;
  std::int64_t asked_ = 0;
  std::int64_t told_ = 0;
  std::vector<std::int64_t> left_;  ///< by design
  std::vector<DesignId> ended_;
  std::vector<Row> rows_;
};

}  // namespace swarmsmith::bench
