#pragma once

#include <utility>
#include <vector>

#include "coordinator/design/work_source.h"

namespace swarmsmith {

/// Independent evaluations, all wanted at once; their outcomes become rows, and that is all.
class FlatCampaign final : public WorkSource {
 public:
  explicit FlatCampaign(std::vector<Task> tasks) : left_(tasks.size()), tasks_(std::move(tasks)) {}

  std::vector<Task> take_tasks() override { return std::exchange(tasks_, {}); }
  void tell(const Outcome& outcome) override {
    --left_;
    EvaluationRow row;
    row.key = outcome.key;
    row.status = outcome.status;
    row.measured = outcome.measured;
    rows_.emplace_back(std::move(row));
  }
  std::vector<Row> take_rows() override { return std::exchange(rows_, {}); }
  bool finished() const override { return left_ == 0; }

 private:
  std::size_t left_;
  std::vector<Task> tasks_;
  std::vector<Row> rows_;
};

}  // namespace swarmsmith
