#include <unistd.h>

#include <fmt/format.h>

#include "base/hash.h"
#include "storage/answer.h"
#include "storage/internal/file_checks.h"
#include "storage/internal/query.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "storage/store.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

class SqliteReader final : public StoreReader {
 public:
  explicit SqliteReader(Connection connection) : connection_(std::move(connection)) {}

  CampaignRow campaign() override { return read_campaign(connection_); }
  std::vector<DesignRow> designs() override { return read_designs(connection_); }
  std::vector<StoredScore> scores() override { return read_scores(connection_); }
  std::vector<CommandRow> commands() override { return read_commands(connection_); }
  bool finished() override { return is_finished(connection_); }

  std::string digest() override;
  void each_answer_row(const std::function<void(const Row&)>& on_row) override;
  std::vector<std::string> integrity() override;
  Expected<QueryEnd> query(const std::string& sql, const QueryLimits& limits,
                           const std::function<void(const std::vector<std::string>&)>& on_columns,
                           const std::function<void(const std::vector<Cell>&)>& on_row) override {
    return run_query(connection_, sql, limits, on_columns, on_row);
  }

 private:
  Connection connection_;
};

/// One state of the store for several statements; a reader's transaction only ever reads.
class Snapshot {
 public:
  explicit Snapshot(Connection& connection) : connection_(connection) {
    connection_.execute("BEGIN");
  }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;
  ~Snapshot() { sqlite3_exec(connection_.handle(), "ROLLBACK", nullptr, nullptr, nullptr); }

 private:
  Connection& connection_;
};

void SqliteReader::each_answer_row(const std::function<void(const Row&)>& on_row) {
  const Snapshot snapshot(connection_);
  read_answer(connection_, on_row);
}

std::string SqliteReader::digest() {
  const Snapshot snapshot(connection_);
  Digest digest;
  digest.add(read_campaign(connection_).digest);
  for (const DesignRow& row : read_designs(connection_)) {
    digest.add(row.id.value);
    digest.add(row.mission);
    digest.add(row.method);
    digest.add(row.repetition);
    digest.add(row.seed);
    digest.add(row.budget);
  }
  read_answer(connection_, [&](const Row& row) { add_answer(digest, row); });
  return digest.hex();
}

std::vector<std::string> SqliteReader::integrity() {
  std::vector<std::string> faults;
  try {
    Statement check(connection_, "PRAGMA integrity_check");
    while (check.step()) {
      if (check.text(0) != "ok") faults.push_back(check.text(0));
    }
    Statement foreign(connection_,
                      "SELECT \"table\", parent, count(*) FROM pragma_foreign_key_check"
                      " GROUP BY \"table\", parent");
    while (foreign.step()) {
      faults.push_back(fmt::format("rows of {} name rows of {} that do not exist: {}",
                                   foreign.text(0), foreign.text(1), foreign.integer(2)));
    }
    if (const std::int64_t lost = candidates_without_phrases(connection_); lost > 0)
      faults.push_back(fmt::format("candidates name phrases that do not exist: {}", lost));
  } catch (const sqlite::SqliteError& error) {
    faults.emplace_back(error.what());
  }
  return faults;
}

bool cannot_make_files(const fs::path& path) {
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  return ::access(folder.c_str(), W_OK) != 0;
}

/// A file: URI in which every byte that could mean something else is written as %XX.
std::string immutable_uri(const fs::path& path) {
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '/' || c == '.' || c == '-' || c == '_';
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri + "?immutable=1";
}

/// A store in WAL mode needs a -shm file beside it. Where none can be made and no log waits, nobody
/// can be writing, and the file may be read as it is.
Connection connect(const fs::path& path) {
  const bool still = cannot_make_files(path) && !has_pending_log(path);
  Connection connection =
      still ? Connection(immutable_uri(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI)
            : Connection(path.string(), SQLITE_OPEN_READONLY);
  configure_reader(connection);
  return connection;
}

Unexpected refused(const sqlite::SqliteError& error, const fs::path& path) {
  const int code = error.primary_code();
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    return unexpected(ErrorKind::Corrupt, fmt::format("the store is damaged: {}", error.what()),
                      path.string());
  }
  if (cannot_make_files(path)) {
    return unexpected(ErrorKind::Unavailable,
                      "the folder is read-only and the store was not closed properly, so that "
                      "SQLite would have to make files beside it; copy the store together with its "
                      "-wal file to a folder of your own and read it there",
                      path.string());
  }
  return unexpected(ErrorKind::Unavailable, fmt::format("cannot be read: {}", error.what()),
                    path.string());
}

}  // namespace

std::vector<Row> StoreReader::answer_rows() {
  std::vector<Row> rows;
  each_answer_row([&](const Row& row) { rows.push_back(row); });
  return rows;
}

Expected<std::unique_ptr<StoreReader>> StoreReader::open(const fs::path& path) {
  std::error_code trouble;
  if (!fs::exists(path, trouble) && !trouble) {
    return unexpected(ErrorKind::NotFound, "there is no such store", path.string());
  }
  if (auto sound = check_database_file(path); !sound) return Unexpected(sound.error());
  try {
    Connection connection = connect(path);
    if (is_blank(connection)) {
      return unexpected(ErrorKind::NotFound, "the file is empty: no campaign has begun in it",
                        path.string());
    }
    if (auto ours = check_identity(connection, path); !ours) return Unexpected(ours.error());
    return std::make_unique<SqliteReader>(std::move(connection));
  } catch (const sqlite::SqliteError& error) {
    return refused(error, path);
  }
}

}  // namespace swarmsmith
