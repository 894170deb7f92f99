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

/// Thrown when an open store cannot be read: the file is damaged in its middle or was changed under
/// us, or the disk fails.
class StoreFailure : public std::runtime_error {
 public:
  StoreFailure(const std::string& message, std::string file)
      : std::runtime_error(message), file_(std::move(file)) {}
  const std::string& file() const { return file_; }  ///< empty when not known

 private:
  std::string file_;
};

/// The state of a writer, reported from its own thread.
struct WriterNews {
  std::uint64_t committed = 0;  ///< every batch up to this ticket is on disk
  std::string trouble;          ///< why commits are being retried (disk full, ...); empty when well
  /// The file was deleted, renamed or replaced: nothing more is written. `trouble` says where the
  /// committed rows are now.
  bool is_lost = false;
};

struct StoreOptions {
  /// Pause before a failed commit is retried.
  std::chrono::milliseconds retry{1000};
  /// The least time from one commit to the next, unless a thread waits in flush(): rows that arrive
  /// meanwhile share one transaction, and a commit costs the kernel as much as a hundred rows.
  std::chrono::milliseconds gather{60};
  /// How long to wait for another process that writes the store, as a command to a stopped campaign
  /// does for a moment.
  std::chrono::milliseconds patience{0};
};

/// A store's record of the workers that gave its scores.
struct StoredTrust {
  std::map<std::int64_t, std::string> principals;  ///< by worker
  std::vector<Quarantine> quarantined;
  std::set<EvaluationKey> audited;  ///< made again, with the same bits
  bool distrusted = false;          ///< its scores are wrong, or may be
};

/// How the best of a design did in the campaign's own tests, as far as they are done.
struct TestedDesign {
  CandidateId winner;
  double mean = 0;
  std::int64_t runs = 0;
};

/// The one writer of a store: an SQLite file in WAL mode, synchronous=FULL, with its own thread,
/// which commits all queued rows as one transaction (group commit). Holds the lock of the file
/// under any name while it lives, so there is never a second writer. Existing rows are ignored, or
/// replaced if the row has absolute values: appending twice does no harm.
class Store {
 public:
  /// Makes the store when the file does not exist, else opens and migrates it. Errors: Conflict
  /// (another process holds it: its pid and host; or another campaign's: the keys that differ),
  /// Corrupt (no SQLite file, truncated, damaged), Newer (schema of a later version), BadInput (a
  /// network file system, no such folder, not writable, a second name), Unavailable (the disk
  /// refuses).
  static Expected<std::unique_ptr<Store>> open(const std::filesystem::path& named,
                                               const CampaignRow& campaign,
                                               const std::vector<DesignRow>& designs,
                                               const StoreOptions& options = {});
  /// Commits the queue (if the disk still refuses, the queue is lost; it was never acknowledged),
  /// folds the write-ahead log into the file and releases the lock.
  virtual ~Store() = default;

  /// Queues the rows as one unit: a crash keeps all of them or none. Returns their ticket, counted
  /// up from 1. Never blocks on the disk; the queue has no limit, so the caller must stop making
  /// rows while there is trouble. Tickets commit in order. Throws std::invalid_argument when a
  /// number is NaN or infinite, and queues nothing then. An existing evaluation stays unchanged,
  /// with its first score; -0 is stored as 0.
  virtual std::uint64_t append(std::vector<Row> rows) = 0;

  /// `on_news` is called from the writer's thread after each commit and whenever commits begin to
  /// fail (disk full: it retries every second until there is room) or work again; before flush()
  /// returns. A lost file is noticed with each commit and once a second, and reported as the last
  /// news. It must not call the store.
  virtual void set_listener(std::function<void(const WriterNews&)> on_news) = 0;

  /// Waits until everything appended so far is on disk. Conflict when the file is lost, with the
  /// reason and the place of the remaining rows.
  virtual Expected<void> flush() = 0;

  /// All stored evaluations, for replay; read before the first append.
  virtual std::vector<StoredScore> scores() = 0;
  virtual std::vector<StoredStep> steps() = 0;
  /// How far each design of the campaign is, in the order of their ids. Merged or imported designs
  /// are not included.
  virtual std::vector<DesignStateRow> design_states() = 0;
  /// Of the same designs those with tests, but for those with a targetEvaluator.
  virtual std::vector<TestedDesign> tested_designs() { return {}; }
  /// People's commands to the campaign, by number.
  virtual std::vector<CommandRow> commands() = 0;
  /// The number for the next worker, after all earlier ones.
  virtual std::int64_t next_worker() = 0;
  /// Whether the campaign's row says that it is finished.
  virtual bool finished() = 0;
  virtual StoredTrust trust() { return {}; }
  /// A secret with the campaign's lifetime: `fresh`, unless the store has one. It is deleted when
  /// the campaign is finished.
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
  /// unchanged; a query for something it lacks fails with the way to a newer one.
  static Expected<std::unique_ptr<StoreReader>> open(const std::filesystem::path& named);
  virtual ~StoreReader() = default;

  /// The campaigns by number; for a reader from `alone` only its own.
  virtual std::vector<StoredCampaign> campaigns() = 0;
  /// One campaign of the store as if it were alone in it, with the ids of its own store. Queries
  /// and the integrity check still see the whole store. An unknown number throws
  /// std::invalid_argument. Independent of this object's lifetime.
  virtual std::unique_ptr<StoreReader> alone(std::int64_t campaign) = 0;
  /// The first campaign: the only one, unless others were merged or imported.
  CampaignRow campaign() { return campaigns().front().row; }
  /// The campaign that has the design; NotFound when none does.
  Expected<StoredCampaign> campaign_of(DesignId design);
  /// Version of the tables and views that the file has.
  virtual std::int64_t schema() = 0;
  virtual std::vector<DesignRow> designs() = 0;
  virtual std::vector<StoredScore> scores() = 0;
  virtual std::vector<CommandRow> commands() = 0;
  /// Texts of profiles, by name, under which candidates were evaluated outside of campaigns; those
  /// of programs before this had it are missing.
  virtual std::map<std::string, std::string> kept_profiles() = 0;
  /// The real runs by id; for a reader from `alone` those of its candidates, with its ids. None
  /// before schema 5.
  virtual std::vector<RealRunHead> real_runs() = 0;
  /// A real run as it was written, with its latest scoring; NotFound lists the existing runs.
  virtual Expected<RealRunRows> real_run(RealRunId id) = 0;
  /// One hash over every table that is part of the answer (answer.h), row by row in key order:
  /// equal for two stores of one campaign, whatever their history. For several campaigns a hash
  /// over their single digests, independent of their order.
  virtual std::string digest() = 0;
  /// The rows that the digest covers, in its order: states of designs, iterations, candidates,
  /// pairs, evaluations, steps, eliminations, elites, totals, commands that acted.
  virtual void each_answer_row(const std::function<void(const Row&)>& on_row) = 0;
  std::vector<Row> answer_rows();
  /// Whether the rows of all campaigns say that they are finished.
  virtual bool finished() = 0;
  /// SQLite's own integrity check and foreign keys: one sentence per fault, none when clean.
  virtual std::vector<std::string> integrity() = 0;

  /// Calls `on_row` with the cells of each row of a read-only statement (texts; null as nullopt),
  /// after `on_columns` with the names. Stops at the limits of rows, seconds and bytes, and then
  /// sets `truncated`. A statement that would write, attach or change a setting, more than one
  /// statement, what does not parse, a value over 25 MB, a row over 50 MB, or a need of more
  /// memory, is BadInput with the reason.
  struct QueryLimits {
    std::int64_t rows = 1'000'000;
    double seconds = 60;
    /// Bytes of all cells, as they are.
    std::int64_t bytes = std::int64_t{128} << 20U;
    /// Memory of SQLite for the statement: sorting, grouping, computed values. The limit applies to
    /// the whole process, so nothing else may write meanwhile.
    std::int64_t memory = std::int64_t{256} << 20U;
    /// A user typed the statement: errors say what is wrong with it and repeat it, and its sorts
    /// stay in memory. Errors of our own statements are about the store and name its file, and
    /// their large sorts go to temporary files beside it.
    bool typed = false;
    /// Views that a user has added to the file can be read: for statements of a person's own.
    bool views_of_file = false;
  };
  struct Cell {
    enum class Type { Null, Integer, Real, Text } type = Type::Null;
    std::string text;  ///< shortest form that reads back to the same value

    bool is_null() const { return type == Type::Null; }
    /// Of an integer or a real; 0 of anything else.
    std::int64_t integer() const { return number<std::int64_t>(); }
    double real() const { return number<double>(); }
    /// None for null.
    std::optional<double> maybe_real() const {
      return is_null() ? std::nullopt : std::optional(real());
    }
    /// CandidateId, say; of null the empty one.
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
  /// Gives back the memory in which SQLite keeps pages for the next statement.
  virtual void rest() {}
  virtual Expected<QueryEnd> query(
      const std::string& sql, const QueryLimits& limits,
      const std::function<void(const std::vector<std::string>&)>& on_columns,
      const std::function<void(const std::vector<Cell>&)>& on_row) = 0;
};

/// The file that a name leads to: follows symbolic links, also to a file that does not exist yet.
/// Log, lock and the coordinator's file lie beside it.
std::filesystem::path real_store(const std::filesystem::path& named);

/// Whether a process writes the store now, by its lock file: false without one, and when it names
/// an ended process of this host. A process of another host is assumed to run.
bool has_writer(const std::filesystem::path& named);

/// In this process, says in a sentence when a store takes longer than two seconds to be checked as
/// a whole, before it is written. Called by the thread that opens it.
void set_check_listener(std::function<void(const std::string&)> on_long_check);

/// Whether a file begins like an SQLite file; false when it cannot be read. Reads it through
/// SQLite, as all code must that may be reading a store (decision 18).
bool is_database(const std::filesystem::path& path);

/// A text as a literal of SQL, in quotes.
std::string sql_text(std::string_view text);

}  // namespace swarmsmith
