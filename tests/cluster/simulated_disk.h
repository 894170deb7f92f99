#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "proto/key.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith::cluster {

/// What a store does with rows, in memory: the first evaluation stays, absolute values are
/// replaced, what is there already is ignored. Stricter than a store, which cannot know better.
///
/// Below it is a file as SQLite and the kernel have it: commits stand in a log, and the last client
/// that closes the file folds the log into it and takes the log away. Who has the file open is
/// known by locks, and a process loses its own when it closes any descriptor of the file.
class SimulatedDisk {
 public:
  /// The coordinator opens the store. After a crash it looks at the whole file; with
  /// `closes_beside` by a descriptor of its own, which it closes while SQLite has the file open.
  void open(bool closes_beside);
  /// The coordinator dies. What the next one finds is what the file's name leads to.
  void crash();
  /// An ordinary client opens the store, reads and closes it.
  void visit();

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
  /// What the file's name leads to, when that is not what the coordinator sees: it writes a log
  /// that was taken away.
  std::optional<std::map<RowKey, Row>> named_;
  bool is_open_ = false;    ///< by the coordinator
  bool is_locked_ = false;  ///< so that others know of it
  bool is_unclean_ = false;
};

}  // namespace swarmsmith::cluster
