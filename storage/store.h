#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "storage/real_runs.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Thrown where a store that was opened cannot be read after all: the file is damaged in its middle
/// or was changed under us, or the disk fails.
class StoreFailure : public std::runtime_error {
 public:
  StoreFailure(const std::string& message, std::string file)
      : std::runtime_error(message), file_(std::move(file)) {}
  const std::string& file() const { return file_; }  ///< empty when not known

 private:
  std::string file_;
};

/// What a writer tells about itself, from its own thread.
struct WriterNews {
  std::uint64_t committed = 0;  ///< every batch up to this ticket is on disk
  std::string trouble;          ///< why commits are being retried (disk full, ...); empty when well
  /// The file was deleted, renamed or replaced: nothing is written any more. `trouble` says where
  /// what was committed is now.
  bool is_lost = false;
};

struct StoreOptions {
  /// How long to wait before a failed commit is tried again.
  std::chrono::milliseconds retry{1000};
  /// The least time from one commit to the next, unless somebody waits in flush(): what comes in
  /// meanwhile shares one transaction, and a commit costs the kernel as much as a hundred rows.
  std::chrono::milliseconds gather{60};
  /// How long to wait for another process that is writing the store: a command to a campaign at
  /// rest does so for a moment.
  std::chrono::milliseconds patience{0};
};

/// What a store knows of those who gave it its scores.
struct StoredTrust {
  std::map<std::int64_t, std::string> principals;  ///< by worker
  std::vector<std::string> quarantined;            ///< principals
  std::set<EvaluationKey> audited;                 ///< made again, with the same bits
  bool distrusted = false;                         ///< its scores are wrong, or may be
};

/// The one writer of a store: a SQLite file in WAL mode, synchronous=FULL, with a thread of its own
/// that takes whatever has queued up as one transaction (group commit). Holds the lock of the file,
/// whatever it is called, while it lives, so that there is never a second one. Rows that are
/// already there are ignored, or replaced where the row says that it holds absolute values:
/// appending twice does no harm.
class Store {
 public:
  /// Makes the store when the file does not exist, else opens and migrates it. Errors: Conflict
  /// (another process holds it: its pid and host; or another campaign's: the keys that differ),
  /// Corrupt (no SQLite file, truncated, damaged), Newer (schema of a later version), BadInput (a
  /// network file system, no such folder, not writable, a second name), Unavailable (the disk
  /// refuses).
  static Expected<std::unique_ptr<Store>> open(const std::filesystem::path& path,
                                               const CampaignRow& campaign,
                                               const std::vector<DesignRow>& designs,
                                               const StoreOptions& options = {});
  /// Commits what is queued (if the disk still refuses, it is lost: nobody was told that it was
  /// stored), folds the write-ahead log into the file and gives up the lock.
  virtual ~Store() = default;

  /// Queues the rows as one unit: a crash keeps all of them or none. Returns their ticket, counted
  /// up from 1. Never blocks on the disk; the queue has no bound, so the caller must stop making
  /// rows while there is trouble. Tickets commit in order. Throws std::invalid_argument when a
  /// number is NaN or infinite, and queues nothing then. An evaluation that is already there stays
  /// as it is, with its first score; -0 is stored as 0.
  virtual std::uint64_t append(std::vector<Row> rows) = 0;

  /// `on_news` is called from the writer's thread after each commit and whenever commits begin to
  /// fail (disk full: it retries every second until there is room) or work again; before flush()
  /// returns. When the file is lost, which is looked at with each commit and once a second, for the
  /// last time. It must not call the store.
  virtual void set_listener(std::function<void(const WriterNews&)> on_news) = 0;

  /// Waits until everything appended so far is on disk. Conflict when the file is lost, with what
  /// happened and where the rest is.
  virtual Expected<void> flush() = 0;

  /// Every evaluation that is stored, for replay; read before the first append.
  virtual std::vector<StoredScore> scores() = 0;
  virtual std::vector<StoredStep> steps() = 0;
  /// How far each design of the campaign is, in the order of their ids. What was merged or imported
  /// into the store is no part of it.
  virtual std::vector<DesignStateRow> design_states() = 0;
  /// What people asked of the campaign, by number.
  virtual std::vector<CommandRow> commands() = 0;
  /// The number for the next worker that comes, after all that ever came.
  virtual std::int64_t next_worker() = 0;
  /// Whether the campaign's row says that it is finished.
  virtual bool finished() = 0;
  virtual StoredTrust trust() { return {}; }
  /// A secret that lasts as long as the campaign does: `fresh`, unless the store has one. It goes
  /// when the campaign is finished.
  virtual std::string keep_secret(const std::string& fresh) { return fresh; }
};

/// A campaign of a store. Most stores have one; merged ones, and ones into which results were
/// imported, have several.
struct StoredCampaign {
  std::int64_t id = 1;  ///< its number in the store
  CampaignRow row;
  std::string state;                ///< as CampaignStateRow; "imported": there is no race to play
  std::int64_t designs_before = 0;  ///< its designs have the ids after that
  std::int64_t designs = 0;         ///< how many
};

/// A read-only look at a store, for any process, also while a campaign runs. One thread. Each call
/// sees the store as it is at that moment. Members throw std::runtime_error when the disk fails.
class StoreReader {
 public:
  /// Errors: NotFound, Corrupt, Newer, BadInput (a second name), Unavailable (a folder in which
  /// SQLite cannot make its -shm file, while a log waits there). A store of an older schema is read
  /// as it is; a query that names what it lacks is told how to come to a newer one.
  static Expected<std::unique_ptr<StoreReader>> open(const std::filesystem::path& path);
  virtual ~StoreReader() = default;

  /// The campaigns by number; only the one that is looked at, of a reader that `alone` gave.
  virtual std::vector<StoredCampaign> campaigns() = 0;
  /// One campaign of the store as if it were alone in it, with the ids that it has in a store of
  /// its own. Queries and the integrity check see the whole store all the same. A number that the
  /// store lacks is a std::invalid_argument. Lives on its own.
  virtual std::unique_ptr<StoreReader> alone(std::int64_t campaign) = 0;
  /// The first campaign: the only one, where nothing was merged or imported.
  CampaignRow campaign() { return campaigns().front().row; }
  /// The campaign that has the design; NotFound when none does.
  Expected<StoredCampaign> campaign_of(DesignId design);
  /// Version of the tables and views that the file has.
  virtual std::int64_t schema() = 0;
  virtual std::vector<DesignRow> designs() = 0;
  virtual std::vector<StoredScore> scores() = 0;
  virtual std::vector<CommandRow> commands() = 0;
  /// The real runs by id; of a campaign that is looked at alone those of its candidates, which
  /// have the ids that they have there. None before schema 5.
  virtual std::vector<RealRunHead> real_runs() = 0;
  /// A real run as it was written, with its latest scoring; NotFound with the runs that there are.
  virtual Expected<RealRunRows> real_run(RealRunId id) = 0;
  /// One hash over every table that is part of the answer (answer.h), row by row in key order:
  /// equal for two stores of one campaign, however they came about. Of several campaigns a hash
  /// over the digests that they have alone, in whatever order they came together.
  virtual std::string digest() = 0;
  /// The rows that the digest covers, in its order: states of designs, iterations, candidates,
  /// pairs, evaluations, steps, eliminations, elites, totals, commands that acted.
  virtual void each_answer_row(const std::function<void(const Row&)>& on_row) = 0;
  std::vector<Row> answer_rows();
  /// Whether the rows of all campaigns say that they are finished.
  virtual bool finished() = 0;
  /// SQLite's own integrity check and foreign keys: a sentence a fault, none when clean.
  virtual std::vector<std::string> integrity() = 0;

  /// Calls `on_row` with the cells of each row of a read-only statement (texts; null as nullopt),
  /// after `on_columns` with the names. Stops after so many rows, seconds or bytes, and says so by
  /// `truncated`. A statement that would write, attach or change a setting, more than one
  /// statement, what does not parse, a value over 32 MB, a row over 64 MB, or a need of more
  /// memory, is BadInput with the reason.
  struct QueryLimits {
    std::int64_t rows = 1'000'000;
    double seconds = 60;
    /// Of all cells that are given, held as they are.
    std::int64_t bytes = std::int64_t{128} << 20U;
    /// What SQLite may take for the statement, in this process: sorting, grouping, values that it
    /// makes. Its limit is the process's, so that nothing else may write meanwhile.
    std::int64_t memory = std::int64_t{256} << 20U;
    /// Large sorts go to temporary files: for statements of our own.
    bool spill = false;
  };
  struct Cell {
    enum class Type { Null, Integer, Real, Text } type = Type::Null;
    std::string text;  ///< shortest form that reads back to the same value
  };
  struct QueryEnd {
    std::int64_t rows = 0;
    bool truncated = false;
  };
  virtual Expected<QueryEnd> query(
      const std::string& sql, const QueryLimits& limits,
      const std::function<void(const std::vector<std::string>&)>& on_columns,
      const std::function<void(const std::vector<Cell>&)>& on_row) = 0;
};

/// The file that a name leads to: symbolic links are followed, also to where nothing is yet. Log,
/// lock and the coordinator's file lie beside it.
std::filesystem::path real_store(const std::filesystem::path& named);

/// Whether somebody writes the store now, as far as its lock file tells: false without one, and
/// when it names a process of this host that is gone. A process of another host is believed.
bool has_writer(const std::filesystem::path& named);

/// Whether a file begins as SQLite's do; false when it cannot be read. Looks at it through SQLite,
/// as everybody must who may be looking at a store (decision 18).
bool is_database(const std::filesystem::path& path);

/// A text as a literal of SQL, in quotes.
std::string sql_text(std::string_view text);

}  // namespace swarmsmith
