#include "storage/internal/group_writer.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/assert.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/schema_check.h"

namespace swarmsmith {
namespace {

/// A group of this many batches is committed without waiting for more.
constexpr std::size_t kLargeGroup = 1024;

/// How often the writer checks, while it has no work, whether the file is still the store's.
constexpr std::chrono::seconds kLookAtFile{1};

/// Errors of constraints and types: the same rows would fail every time, since they conflict with
/// existing rows. All other errors come from the disk and may pass.
bool is_for_ever(const sqlite::SqliteError& error) {
  const int code = error.primary_code();
  return code == SQLITE_CONSTRAINT || code == SQLITE_MISMATCH || code == SQLITE_ERROR;
}

constexpr const char* kWayOut =
    "nothing more was written; restore the store from a backup, or let `swarmsmith recover` make a "
    "new one from what can be read, and check it with `swarmsmith verify --sample 1000000`";

}  // namespace

GroupWriter::GroupWriter(Writer writer, const StoreOptions& options)
    : writer_(std::move(writer)),
      rows_(writer_.connection),
      retry_(options.retry),
      gather_(options.gather),
      data_version_(writer_.connection, "PRAGMA data_version"),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

GroupWriter::~GroupWriter() {
  thread_.request_stop();
  thread_.join();
  give_up(writer_);
}

std::uint64_t GroupWriter::append(std::vector<Row> rows) {
  for (const Row& row : rows)
    require_finite(row);
  std::uint64_t ticket = 0;
  bool wake = false;
  {
    const std::lock_guard guard(mutex_);
    ticket = ++last_ticket_;
    queue_.push_back({ticket, std::move(rows)});
    wake = queue_.size() == 1 || queue_.size() == kLargeGroup;
  }
  if (wake) work_.notify_one();
  return ticket;
}

void GroupWriter::set_listener(std::function<void(const WriterNews&)> on_news) {
  const std::lock_guard guard(listener_mutex_);
  listener_ = std::move(on_news);
}

Expected<void> GroupWriter::flush() {
  std::unique_lock guard(mutex_);
  const std::uint64_t wanted = last_ticket_;
  awaited_ = std::max(awaited_, wanted);
  work_.notify_one();
  committed_changed_.wait(guard, [&] { return committed_ >= wanted || lost_ || refused_; });
  if (lost_) return Unexpected(*lost_);
  if (committed_ < wanted) return Unexpected(*refused_);
  return {};
}

std::vector<StoredScore> GroupWriter::scores() {
  const std::lock_guard guard(connection_mutex_);
  return read_scores(writer_.connection, first_campaign(writer_.connection));
}

std::vector<StoredStep> GroupWriter::steps() {
  const std::lock_guard guard(connection_mutex_);
  return read_steps(writer_.connection, first_campaign(writer_.connection));
}

std::vector<DesignStateRow> GroupWriter::design_states() {
  const std::lock_guard guard(connection_mutex_);
  return read_design_states(writer_.connection);
}

std::vector<TestedDesign> GroupWriter::tested_designs() {
  const std::lock_guard guard(connection_mutex_);
  return read_tested_designs(writer_.connection);
}

std::vector<CommandRow> GroupWriter::commands() {
  const std::lock_guard guard(connection_mutex_);
  return read_commands(writer_.connection);
}

std::int64_t GroupWriter::next_worker() {
  const std::lock_guard guard(connection_mutex_);
  return read_next_worker(writer_.connection);
}

bool GroupWriter::finished() {
  const std::lock_guard guard(connection_mutex_);
  return is_finished(writer_.connection);
}

StoredTrust GroupWriter::trust() {
  const std::lock_guard guard(connection_mutex_);
  return read_trust(writer_.connection);
}

std::string GroupWriter::keep_secret(const std::string& fresh) {
  const std::lock_guard guard(connection_mutex_);
  return swarmsmith::keep_secret(writer_.connection, fresh);
}

void GroupWriter::run(const std::stop_token& stop) {
  std::vector<Batch> group;
  std::string trouble;
  while (take_group(stop, group)) {
    const std::string before = trouble;
    if (group.empty()) {
      look_for_changes();
    } else {
      trouble = commit(group);
    }
    if (!changed_.empty()) return leave(committed_);
    const bool done = !group.empty() && trouble.empty();
    const std::uint64_t ticket = done ? group.back().ticket : committed_;
    // After the commit: what was committed to a file that has lost its name is in the saved copy.
    if (const std::string fate = writer_.file.fate(); !fate.empty()) return lose(fate, ticket);
    if (done) {
      group.clear();
      tell({.committed = ticket});
      const std::lock_guard guard(mutex_);
      committed_ = ticket;
      refused_.reset();
      committed_changed_.notify_all();
    }
    if (trouble.empty()) continue;
    if (trouble != before) {
      tell({.committed = ticket,
            .trouble = fmt::format("{}; nothing is lost, trying again every {} ms", trouble,
                                   retry_.count())});
    }
    if (stop.stop_requested()) return;
    std::unique_lock guard(mutex_);
    refused_ = Error{ErrorKind::Unavailable, trouble, writer_.file.path().string()};
    committed_changed_.notify_all();
    work_.wait_for(guard, stop, retry_, [] { return false; });
  }
}

bool GroupWriter::take_group(const std::stop_token& stop, std::vector<Batch>& group) {
  if (!group.empty()) return true;
  std::unique_lock guard(mutex_);
  work_.wait_for(guard, stop, kLookAtFile, [this] { return !queue_.empty(); });
  if (queue_.empty()) return !stop.stop_requested();
  work_.wait_until(guard, stop, next_commit_,
                   [this] { return awaited_ > committed_ || queue_.size() >= kLargeGroup; });
  std::swap(group, queue_);
  next_commit_ = std::chrono::steady_clock::now() + gather_;
  return true;
}

void GroupWriter::lose(const std::string& fate, std::uint64_t ticket) {
  const std::unique_lock file(connection_mutex_);
  const Lost lost = save_lost(writer_, fate);
  {
    const std::lock_guard guard(mutex_);
    // Rows that are in no file any more count as never stored.
    if (lost.saved) committed_ = ticket;
    lost_ = lost.error;
    committed_changed_.notify_all();
  }
  tell({.committed = committed_, .trouble = lost.error.message, .is_lost = true});
}

void GroupWriter::leave(std::uint64_t ticket) {
  const std::unique_lock file(connection_mutex_);
  writer_.is_lost = true;
  writer_.lock.set_suspect(true);
  const Error error{ErrorKind::Conflict, changed_ + "; " + kWayOut, writer_.file.path().string()};
  {
    const std::lock_guard guard(mutex_);
    lost_ = error;
    committed_changed_.notify_all();
  }
  tell({.committed = ticket, .trouble = error.message, .is_lost = true});
}

std::string GroupWriter::changes_of_others() {
  data_version_.reset();
  data_version_.step();
  const std::int64_t version = data_version_.integer(0);
  data_version_.reset();
  if (version == writer_.data_version) return {};
  // Another client may only have moved the log into the file.
  constexpr const char* kChanged = "was changed by another program while the campaign ran";
  const auto objects = foreign_objects(writer_.connection, schema_of(writer_.connection));
  if (!objects.empty())
    return fmt::format("the store's schema {}: {}", kChanged, listed_objects(objects));
  if (rows_.sums()) {
    const std::string rows = rows_.sums()->differences(RowSums::found(writer_.connection));
    if (!rows.empty()) return fmt::format("the store {}: {}", kChanged, rows);
  }
  writer_.data_version = version;
  return {};
}

void GroupWriter::look_for_changes() {
  const std::lock_guard guard(connection_mutex_);
  try {
    changed_ = changes_of_others();
  } catch (
      const sqlite::SqliteError&) {  // the store is busy for a moment: the next call tries again
    data_version_.reset();
  }
}

std::string GroupWriter::commit(const std::vector<Batch>& group) {
  const std::lock_guard guard(connection_mutex_);
  try {
    sqlite::Transaction transaction(writer_.connection);
    changed_ = changes_of_others();
    if (!changed_.empty()) return {};
    for (const Batch& batch : group) {
      for (const Row& row : batch.rows)
        rows_.write(row);
    }
    rows_.write_sums();
    transaction.commit();
    rows_.committed();
    return {};
  } catch (const sqlite::SqliteError& error) {
    rows_.forget();
    data_version_.reset();
    SWARMSMITH_ASSERT(error.primary_code() != SQLITE_MISUSE, error.what());
    if (is_for_ever(error)) {
      changed_ = fmt::format(
          "the store's rows are not those that its campaign wrote, so no more are written: {}",
          error.what());
      return {};
    }
    return fmt::format("the store cannot be written: {}", error.what());
  }
}

void GroupWriter::tell(const WriterNews& news) {
  const std::lock_guard guard(listener_mutex_);
  if (listener_) listener_(news);
}

}  // namespace swarmsmith
