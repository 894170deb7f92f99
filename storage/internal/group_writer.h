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

/// The store behind Store::open: a queue of batches, and a thread that commits whatever has queued
/// up as one transaction. The busier it is, the larger its groups, so that the price of an fsync is
/// shared by more rows.
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
  /// Fills an empty `group` from the queue, waiting for work for a while; false when there will be
  /// none.
  bool take_group(const std::stop_token& stop, std::vector<Batch>& group);
  /// Why the group could not be committed; empty when it is on disk. Nothing is written when others
  /// have changed the store, see `changed_`.
  std::string commit(const std::vector<Batch>& group);
  /// What another connection has changed of what the campaign relies on, since the last look.
  std::string changes_of_others();
  /// The same, while there is nothing to be written.
  void look_for_changes();
  /// The file is not the store's any more; batches up to `ticket` are in it.
  void lose(const std::string& fate, std::uint64_t ticket);
  /// Others have changed it: it stays where it is, and is written no more.
  void leave(std::uint64_t ticket);
  void tell(const WriterNews& news);

  std::mutex connection_mutex_;  ///< the writer's thread, and callers that read
  Writer writer_;
  RowWriter rows_;
  std::chrono::milliseconds retry_;
  std::chrono::milliseconds gather_;
  std::chrono::steady_clock::time_point next_commit_{};  ///< of the writer's thread
  sqlite::Statement data_version_;
  std::string changed_;  ///< why the store is written no more; of the writer's thread

  std::mutex mutex_;  ///< guards the next seven
  std::condition_variable_any work_;
  std::condition_variable committed_changed_;
  std::vector<Batch> queue_;
  std::uint64_t last_ticket_ = 0;
  std::uint64_t committed_ = 0;
  std::uint64_t awaited_ = 0;  ///< a thread waits in flush() for this ticket
  std::optional<Error> lost_;  ///< the file; nothing is written any more

  std::mutex listener_mutex_;
  std::function<void(const WriterNews&)> listener_;

  std::jthread thread_;
};

}  // namespace swarmsmith
