#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "proto/key.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith::cluster {

/// What a store does with rows, in memory: the first evaluation stays, absolute values are
/// replaced, what is there already is ignored. Stricter than a store, which cannot know better.
class SimulatedDisk {
 public:
  /// Takes the rows as one unit. What is wrong with them, as a sentence; empty when nothing is.
  std::string commit(const std::vector<Row>& rows);

  bool holds(PackedKey evaluation) const;
  /// As `Store` has them.
  std::vector<StoredScore> scores() const;
  std::vector<StoredStep> steps() const;
  std::vector<DesignStateRow> design_states() const;
  std::vector<CommandRow> commands() const;
  std::int64_t next_worker() const;
  bool finished() const;
  StoredTrust trust() const;

  /// Rows that are part of the answer, a line each.
  std::vector<std::string> answer() const;

 private:
  /// Kind of row, then its key.
  using RowKey = std::tuple<std::size_t, std::int64_t, std::int64_t, std::int64_t>;

  static RowKey key_of(const Row& row);
  std::string put(const Row& row);
  std::string missing_reference(const Row& row) const;
  bool has_candidate(CandidateId id) const;
  template <class Kind>
  std::vector<Kind> rows_of() const;

  std::map<RowKey, Row> rows_;
};

}  // namespace swarmsmith::cluster
