#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
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

/// Thrown when an open store cannot be read: the file is damaged in its middle or is being changed
/// by another program, or the disk fails.
class StoreFailure : public std::runtime_error {
 public:
  StoreFailure(const std::string& message, std::string file)
      : std::runtime_error(message), file_(std::move(file)) {}
  const std::string& file() const { return file_; }  ///< empty when unknown

 private:
  std::string file_;
};

/// The state of a writer, reported from its own thread.
struct WriterNews {
  std::uint64_t committed = 0;  ///< every batch up to this ticket is on disk
  std::string trouble;  ///< why commits are being retried (disk full, ...); empty when they succeed
  /// The file was deleted, renamed or replaced: nothing more is written. `trouble` says where the
  /// committed rows are now.
  bool is_lost = false;
};

struct StoreOptions {
  /// Pause before a failed commit is retried.
  std::chrono::milliseconds retry{1000};
  /// Minimum time between two commits, unless a thread waits in flush(). Rows that arrive meanwhile
  /// share one transaction, since a commit costs the kernel as much as a hundred rows.
  std::chrono::milliseconds gather{60};
  /// How long to wait for another process that is writing the store. A command to a stopped
  /// campaign writes it for a moment.
  std::chrono::milliseconds patience{0};
};

/// A store's record of the workers that gave its scores.
struct StoredTrust {
  std::map<std::int64_t, std::string> principals;  ///< by worker
  std::vector<Quarantine> quarantined;
  std::set<EvaluationKey> audited;  ///< evaluated again, with the same bits
  bool distrusted = false;          ///< its scores are wrong, or may be wrong
};

/// The result of a design's best candidate in the campaign's own tests, as far as they are done.
struct TestedDesign {
  CandidateId winner;
  double mean = 0;
  std::int64_t runs = 0;
};

/// The one writer of a store: an SQLite file in WAL mode, synchronous=FULL, with its own thread,
/// which commits all queued rows as one transaction (group commit). It holds the lock of the file,
/// whatever name the file is opened by, so there is never a second writer. A row that exists
/// already is ignored, or replaced if its type holds totals rather than increments, so appending a
/// row twice does no harm.
class Store {
 public:
  /// Creates the store when the file does not exist, else opens and migrates it. Errors: Conflict
  /// (another process holds it: its pid and host; or it belongs to another campaign: the keys that
  /// differ), Corrupt (not an SQLite file, truncated, damaged), Newer (schema of a later version),
  /// BadInput (a network file system, missing folder, not writable, a second name of the file),
  /// Unavailable (the disk cannot be written).
  static Expected<std::unique_ptr<Store>> open(const std::filesystem::path& named,
                                               const CampaignRow& campaign,
                                               const std::vector<DesignRow>& designs,
                                               const StoreOptions& options = {});
  /// Commits the queue, moves the write-ahead log into the file and releases the lock. If the disk
  /// still cannot be written, the queue is lost; it was never acknowledged.
  virtual ~Store() = default;

  /// Queues the rows as one unit: after a crash either all or none of them are stored. Returns
  /// their ticket; tickets count from 1. Never waits for the disk. The queue has no limit, so the
  /// caller must stop making rows while commits fail. Tickets commit in order. Throws
  /// std::invalid_argument, and queues nothing, when a number is NaN or infinite. An existing
  /// evaluation stays unchanged, with its first score; -0 is stored as 0.
  virtual std::uint64_t append(std::vector<Row> rows) = 0;

  /// `on_news` is called from the writer's thread after each commit, when commits begin to fail
  /// (disk full: the writer retries every second until there is room), and when they succeed again;
  /// always before flush() returns. A lost file is noticed with each commit and once a second, and
  /// reported as the last news. `on_news` must not call the store.
  virtual void set_listener(std::function<void(const WriterNews&)> on_news) = 0;

  /// Waits until all rows appended so far are on disk. Unavailable when the last commit failed: the
  /// rows are still queued, and the writer goes on trying. Conflict when the file is lost, with the
  /// reason and the place of the remaining rows.
  virtual Expected<void> flush() = 0;

  /// All stored evaluations, for replay; read before the first append.
  virtual std::vector<StoredScore> scores() = 0;
  virtual std::vector<StoredStep> steps() = 0;
  /// The progress of each design of the campaign, in the order of their ids. Merged or imported
  /// designs are not included.
  virtual std::vector<DesignStateRow> design_states() = 0;
  /// Those of these designs that have tests, without those that have a targetEvaluator.
  virtual std::vector<TestedDesign> tested_designs() { return {}; }
  /// Users' commands to the campaign, by number.
  virtual std::vector<CommandRow> commands() = 0;
  /// The number for the next worker, after all earlier ones.
  virtual std::int64_t next_worker() = 0;
  /// Whether the campaign's row says that it is finished.
  virtual bool finished() = 0;
  virtual StoredTrust trust() { return {}; }
  /// A secret that is kept as long as the campaign is unfinished: the one in the store, or `fresh`
  /// if it has none. It is deleted when the campaign is finished.
  virtual std::string keep_secret(const std::string& fresh) { return fresh; }
};

/// A campaign of a store. Most stores have one; a store has several after a merge, or when results
/// were imported into it.
struct StoredCampaign {
  std::int64_t id = 1;  ///< its number in the store
  CampaignRow row;
  std::string state;                ///< as in CampaignStateRow; "imported": it has no races
  std::int64_t designs_before = 0;  ///< the ids of its designs come after this number
  std::int64_t designs = 0;         ///< number of its designs
};

/// Read-only access to a store, for any process, also while a campaign runs. Not thread-safe. Each
/// call sees the store as it is at that moment. Members throw std::runtime_error when the disk
/// fails.
class StoreReader {
 public:
  /// Errors: NotFound, Corrupt, Newer, BadInput (a second name of the file), Unavailable (SQLite
  /// cannot make its -shm file in the folder, and there is a pending log). A store of an older
  /// schema is read unchanged; if a query needs something that it lacks, the error says how to make
  /// a store of a newer schema.
  static Expected<std::unique_ptr<StoreReader>> open(const std::filesystem::path& named);
  /// A reader without a store; only its `query` works, with the values in the statement itself.
  static std::unique_ptr<StoreReader> of_no_store();
  virtual ~StoreReader() = default;

  /// The campaigns by number; a reader from `alone` has only its own.
  virtual std::vector<StoredCampaign> campaigns() = 0;
  /// One campaign of the store as if it were alone in it, with the ids that it would have then.
  /// Queries and the integrity check still see the whole store. An unknown number throws
  /// std::invalid_argument. The result does not depend on this object's lifetime.
  virtual std::unique_ptr<StoreReader> alone(std::int64_t campaign) = 0;
  /// The first campaign; it is the only one unless others were merged or imported.
  CampaignRow campaign() { return campaigns().front().row; }
  /// The campaign that has the design; NotFound when none does.
  Expected<StoredCampaign> campaign_of(DesignId design);
  /// Version of the tables and views that the file has.
  virtual std::int64_t schema() = 0;
  virtual std::vector<DesignRow> designs() = 0;
  virtual std::vector<StoredScore> scores() = 0;
  virtual std::vector<CommandRow> commands() = 0;
  /// Texts of the profiles, by name, under which candidates were evaluated outside of campaigns.
  /// Profiles that an earlier version of the program used are missing.
  virtual std::map<std::string, std::string> kept_profiles() = 0;
  /// The real runs by id; a reader from `alone` has the runs of its candidates, with its own ids.
  /// Empty before schema 5.
  virtual std::vector<RealRunHead> real_runs() = 0;
  /// A real run as it was written, with its latest scoring; NotFound lists the existing runs.
  virtual Expected<RealRunRows> real_run(RealRunId id) = 0;
  /// One hash over every table that is part of the answer (answer.h), row by row in key order:
  /// equal for two stores of one campaign, whatever their history. For several campaigns, a hash
  /// over the digests of the campaigns that does not depend on their order.
  virtual std::string digest() = 0;
  /// The rows that the digest covers, in its order: states of designs, iterations, candidates,
  /// pairs, evaluations, steps, eliminations, elites, totals, commands that took effect.
  virtual void each_answer_row(const std::function<void(const Row&)>& on_row) = 0;
  std::vector<Row> answer_rows();
  /// Whether the rows of all campaigns say that they are finished.
  virtual bool finished() = 0;
  /// SQLite's integrity check and foreign keys: one sentence per fault, empty when there is none.
  virtual std::vector<std::string> integrity() = 0;

  /// Runs a read-only statement. Calls `on_columns` with the names of the columns, then `on_row`
  /// with the cells of each row (texts; null as nullopt). Stops at the limits of rows, seconds and
  /// bytes, and then sets `truncated`. BadInput with the reason when the statement would write,
  /// attach or change a setting, does not parse, needs more memory, or gives a value over 25 MB or
  /// a row over 50 MB; also for more than one statement.
  struct QueryLimits {
    std::int64_t rows = 1'000'000;
    double seconds = 60;
    /// Total bytes of all cells.
    std::int64_t bytes = std::int64_t{128} << 20U;
    /// Memory of SQLite for the statement: sorting, grouping, computed values. The limit applies to
    /// the whole process, so no other thread may write meanwhile.
    std::int64_t memory = std::int64_t{256} << 20U;
    /// Whether a user typed the statement. If so, errors say what is wrong with the statement and
    /// repeat it, and its sorts stay in memory. Otherwise errors are about the store and name its
    /// file, and large sorts go to temporary files beside it.
    bool typed = false;
    /// Whether views that a user added to the file can be read: for statements that a user wrote.
    bool views_of_file = false;
  };
  struct Cell {
    enum class Type { Null, Integer, Real, Text } type = Type::Null;
    std::string text;  ///< the shortest text that reads back to the same value

    bool is_null() const { return type == Type::Null; }
    /// The value of an integer or a real; 0 for other types.
    std::int64_t integer() const { return number<std::int64_t>(); }
    double real() const { return number<double>(); }
    /// Empty for null.
    std::optional<double> maybe_real() const {
      return is_null() ? std::nullopt : std::optional(real());
    }
    /// An id such as CandidateId; the empty id for null.
    template <class Id>
    Id id() const {
      return Id{integer()};
    }

   private:
    template <class Number>
    Number number() const {
      Number value{};
      std::from_chars(text.data(), text.data() + text.size(), value);
      return value;
    }
  };
  struct QueryEnd {
    std::int64_t rows = 0;
    bool truncated = false;
  };
  /// Frees the memory that SQLite uses to cache pages for the next statement.
  virtual void rest() {}
  virtual Expected<QueryEnd> query(
      const std::string& sql, const QueryLimits& limits,
      const std::function<void(const std::vector<std::string>&)>& on_columns,
      const std::function<void(const std::vector<Cell>&)>& on_row) = 0;
};

/// The file that a path leads to: follows symbolic links, also to a file that does not exist yet.
/// The log, the lock and the coordinator's file are beside it.
std::filesystem::path real_store(const std::filesystem::path& named);

/// Whether a process is writing the store, according to its lock file: false if there is none, or
/// if it names an ended process of this host. A process of another host is assumed to be running.
bool has_writer(const std::filesystem::path& named);

/// Sets a function for this process that gets a sentence when checking a whole store, before it is
/// written, takes longer than two seconds. The thread that opens the store calls it.
void set_check_listener(std::function<void(const std::string&)> on_long_check);

/// Whether a file begins like an SQLite file; false when it cannot be read. It is read through
/// SQLite, as every file that may be an open store must be (decision 18).
bool is_database(const std::filesystem::path& path);

/// A text as an SQL literal, in quotes.
std::string sql_text(std::string_view text);

}  // namespace swarmsmith
