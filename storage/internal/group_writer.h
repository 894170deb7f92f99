#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "storage/internal/open_writer.h"
#include "storage/internal/row_writer.h"
#include "storage/internal/sqlite.h"
#include "storage/store.h"

namespace swarmsmith {

/// The Store that Store::open returns: a queue of batches, and a thread that commits everything in
/// the queue as one transaction. The busier it is, the larger its transactions, so that more rows
/// share the cost of an fsync.
class GroupWriter final : public Store {
 public:
  GroupWriter(Writer writer, const StoreOptions& options);
  ~GroupWriter() override;

  std::uint64_t append(std::vector<Row> rows) override;
  void set_listener(std::function<void(const WriterNews&)> on_news) override;
  Expected<void> flush() override;
  std::vector<StoredScore> scores() override;
  std::vector<StoredStep> steps() override;
  std::vector<DesignStateRow> design_states() override;
  std::vector<TestedDesign> tested_designs() override;
  std::vector<CommandRow> commands() override;
  std::int64_t next_worker() override;
  bool finished() override;
  StoredTrust trust() override;
  std::string keep_secret(const std::string& fresh) override;

 private:
  struct Batch {
    std::uint64_t ticket = 0;
    std::vector<Row> rows;
  };

  void run(const std::stop_token& stop);
  /// Fills an empty `group` from the queue; waits some time for batches. False when there will be
  /// no more.
  bool take_group(const std::stop_token& stop, std::vector<Batch>& group);
  /// The reason why the group could not be committed; empty when it is on disk. Writes nothing when
  /// other programs have changed the store, see `changed_`.
  std::string commit(const std::vector<Batch>& group);
  /// The changes that another connection has made, since the last call, to rows that the campaign
  /// relies on.
  std::string changes_of_others();
  /// Calls changes_of_others while there is nothing to write.
  void look_for_changes();
  /// The store has lost its file; batches up to `ticket` are in it.
  void lose(const std::string& fate, std::uint64_t ticket);
  /// Other programs have changed the store: the file stays where it is, and is not written any
  /// more.
  void leave(std::uint64_t ticket);
  void tell(const WriterNews& news);

  std::mutex connection_mutex_;  ///< held by the writer's thread, and by callers that read
  Writer writer_;
  RowWriter rows_;
  std::chrono::milliseconds retry_;
  std::chrono::milliseconds gather_;
  std::chrono::steady_clock::time_point next_commit_{};  ///< used by the writer's thread only
  sqlite::Statement data_version_;
  std::string
      changed_;  ///< why the store is not written any more; used by the writer's thread only

  std::mutex mutex_;  ///< guards the next eight
  std::condition_variable_any work_;
  std::condition_variable committed_changed_;
  std::vector<Batch> queue_;
  std::uint64_t last_ticket_ = 0;
  std::uint64_t committed_ = 0;
  std::uint64_t awaited_ = 0;     ///< a thread waits in flush() for this ticket
  std::optional<Error> refused_;  ///< why the last commit failed; none after one that succeeded
  std::optional<Error> lost_;     ///< set when the file is lost; nothing is written any more

  std::mutex listener_mutex_;
  std::function<void(const WriterNews&)> listener_;

  std::jthread thread_;
};

}  // namespace swarmsmith
