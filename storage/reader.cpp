#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "storage/internal/closed_file.h"
#include "storage/internal/file_checks.h"
#include "storage/internal/query.h"
#include "storage/internal/reading.h"
#include "storage/internal/real_run_reader.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/schema.h"
#include "storage/internal/schema_check.h"
#include "storage/internal/sqlite.h"
#include "storage/store.h"
#include "storage/whole.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

Unexpected no_such_run(RealRunId id, const std::vector<RealRunHead>& known) {
  if (known.empty()) return unexpected(ErrorKind::NotFound, "the store has no real runs");
  return unexpected(
      ErrorKind::NotFound,
      fmt::format("the store has no real run {}; it has {} from {} to {}", to_string(id),
                  known.size(), to_string(known.front().id), to_string(known.back().id)));
}

/// The changed rows of a file that is not as its last writer closed it; empty if there are none.
/// Within a ReadTransaction.
std::string changes_since_closed(const Connection& connection) {
  return is_as_closed(connection) ? "" : changed_rows(connection);
}

class SqliteReader final : public StoreReader {
 public:
  explicit SqliteReader(std::shared_ptr<Connection> connection,
                        std::optional<std::int64_t> only = std::nullopt,
                        std::shared_ptr<bool> is_whole = std::make_shared<bool>(false))
      : connection_(std::move(connection)), only_(only), is_whole_(std::move(is_whole)) {}

  std::vector<StoredCampaign> campaigns() override;
  std::unique_ptr<StoreReader> alone(std::int64_t campaign) override;
  std::int64_t schema() override { return schema_of(*connection_); }
  std::vector<DesignRow> designs() override { return read_designs(*connection_, part()); }
  std::vector<StoredScore> scores() override { return read_scores(*connection_, part()); }
  std::map<std::string, std::string> kept_profiles() override {
    return read_kept_profiles(*connection_);
  }
  std::vector<CommandRow> commands() override { return read_commands(*connection_, part()); }
  std::vector<RealRunHead> real_runs() override;
  Expected<RealRunRows> real_run(RealRunId id) override;
  bool finished() override {
    return std::ranges::all_of(campaigns(), [](const StoredCampaign& each) {
      return each.state == "finished" || each.state == "imported";
    });
  }

  std::string digest() override;
  void each_answer_row(const std::function<void(const Row&)>& on_row) override;
  std::vector<std::string> integrity() override;
  void rest() override { sqlite3_db_release_memory(connection_->handle()); }
  Expected<QueryEnd> query(const std::string& sql, const QueryLimits& limits,
                           const std::function<void(const std::vector<std::string>&)>& on_columns,
                           const std::function<void(const std::vector<Cell>&)>& on_row) override;

 private:
  /// The designs that this reader reads.
  Part part();
  /// Shows this program's views, or, for a store of an early schema, the views in the file.
  void show_views() {
    lend_views(*connection_);
    connection_->allow_views(!has_our_views(*connection_));
  }

  std::shared_ptr<Connection> connection_;
  std::optional<std::int64_t> only_;  ///< the campaign to read; none: all
  std::shared_ptr<bool> is_whole_;    ///< the store's rows were found to be in a committed state
};

std::vector<StoredCampaign> SqliteReader::campaigns() {
  std::vector<StoredCampaign> campaigns = read_campaigns(*connection_);
  if (only_) std::erase_if(campaigns, [&](const auto& each) { return each.id != *only_; });
  return campaigns;
}

std::unique_ptr<StoreReader> SqliteReader::alone(std::int64_t campaign) {
  const auto known = read_campaigns(*connection_);
  if (std::ranges::find(known, campaign, &StoredCampaign::id) == known.end()) {
    throw std::invalid_argument(fmt::format("the store has no campaign {}", campaign));
  }
  return std::make_unique<SqliteReader>(connection_, campaign, is_whole_);
}

Part SqliteReader::part() {
  if (!only_) return {};
  const StoredCampaign campaign = campaigns().front();
  return {.designs_before = campaign.designs_before, .designs = campaign.designs};
}

void SqliteReader::each_answer_row(const std::function<void(const Row&)>& on_row) {
  const ReadTransaction snapshot(*connection_);
  read_answer(*connection_, part(), on_row);
}

std::vector<RealRunHead> SqliteReader::real_runs() {
  show_views();
  return read_real_runs(*connection_, part());
}

Expected<RealRunRows> SqliteReader::real_run(RealRunId id) {
  show_views();
  const ReadTransaction snapshot(*connection_);
  const std::vector<RealRunHead> known = read_real_runs(*connection_, part());
  const auto head = std::ranges::find(known, id, &RealRunHead::id);
  auto rows = head == known.end() ? std::nullopt : read_real_run(*connection_, id);
  if (!rows) return no_such_run(id, known);
  rows->candidate = head->candidate;
  return std::move(*rows);
}

std::string SqliteReader::digest() {
  const ReadTransaction snapshot(*connection_);
  if (!*is_whole_) {
    const std::string changed = changes_since_closed(*connection_);
    if (!changed.empty()) connection_->fail(SQLITE_CORRUPT, changed);
    *is_whole_ = true;
  }
  const std::vector<StoredCampaign> all = campaigns();
  return all.size() == 1 ? digest_of_campaign(*connection_, all.front())
                         : digest_of_store(*connection_);
}

Expected<StoreReader::QueryEnd> SqliteReader::query(
    const std::string& sql, const QueryLimits& limits,
    const std::function<void(const std::vector<std::string>&)>& on_columns,
    const std::function<void(const std::vector<Cell>&)>& on_row) {
  auto end = run_query(*connection_, sql, limits, on_columns, on_row);
  const std::int64_t schema = schema_of(*connection_);
  if (end || connection_->file().empty() || schema >= kSchemaVersion ||
      !end.error().message.starts_with("no such "))
    return end;
  Error error = end.error();
  const std::string file = sqlite3_db_filename(connection_->handle(), "main");
  const std::string lacks = limits.typed ? " (" + error.message + ")" : "";
  error.message = older_schema_text(schema, fs::path(file).filename().string()) + lacks;
  error.where = file;
  return Unexpected(error);
}

std::vector<std::string> SqliteReader::integrity() {
  const ReadTransaction snapshot(*connection_);
  return faults_of(*connection_);
}

Unexpected refused(const sqlite::SqliteError& error, const fs::path& path) {
  const int code = error.primary_code();
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    return unexpected(ErrorKind::Corrupt, damaged_text(error.what()), path.string());
  }
  if (code == SQLITE_TOOBIG) {
    return unexpected(ErrorKind::Corrupt,
                      fmt::format("a text in it has more than {} MB; no store has such texts",
                                  sqlite::kMostValueBytes >> 20U),
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

Expected<StoredCampaign> StoreReader::campaign_of(DesignId design) {
  for (StoredCampaign& campaign : campaigns()) {
    const std::int64_t number = design.value - campaign.designs_before;
    if (number >= 1 && number <= campaign.designs) return std::move(campaign);
  }
  return unexpected(ErrorKind::NotFound, "the store has no design " + to_string(design));
}

std::vector<Row> StoreReader::answer_rows() {
  std::vector<Row> rows;
  each_answer_row([&](const Row& row) { rows.push_back(row); });
  return rows;
}

Expected<std::unique_ptr<StoreReader>> StoreReader::open(const fs::path& named) {
  const fs::path path = real_store(named);
  std::error_code trouble;
  if (!fs::exists(path, trouble) && !trouble) {
    return unexpected(ErrorKind::NotFound, "there is no such store", path.string());
  }
  try {
    auto connection = connect_for_reading(path);
    if (!connection) return Unexpected(connection.error());
    if (is_blank(*connection)) {
      return unexpected(ErrorKind::NotFound, "the file is empty: no campaign has begun in it",
                        path.string());
    }
    if (auto ours = check_identity(*connection, path); !ours) return Unexpected(ours.error());
    if (auto tables = check_tables(*connection, path); !tables) return Unexpected(tables.error());
    if (auto texts = check_lengths(*connection, path); !texts) return Unexpected(texts.error());
    return std::make_unique<SqliteReader>(std::make_shared<Connection>(std::move(*connection)));
  } catch (const sqlite::SqliteError& error) {
    return refused(error, path);
  }
}

std::unique_ptr<StoreReader> StoreReader::of_no_store() {
  return std::make_unique<SqliteReader>(
      std::make_shared<Connection>(":memory:", SQLITE_OPEN_READWRITE));
}

Expected<void> check_rows(const fs::path& store) {
  const fs::path path = real_store(store);
  try {
    auto connection = connect_for_reading(path);
    if (!connection || is_blank(*connection) || !check_identity(*connection, path) ||
        !check_tables(*connection, path)) {
      return {};
    }
    const ReadTransaction snapshot(*connection);
    if (is_as_closed(*connection)) return {};
    std::string fault = changed_rows(*connection);
    if (fault.empty()) fault = lost_texts(*connection);
    if (fault.empty()) return {};
    return unexpected(ErrorKind::Corrupt, damaged_text(fault), path.string());
  } catch (const sqlite::SqliteError& error) {
    return refused(error, path);
  }
}

fs::path real_store(const fs::path& named) {
  constexpr int kMostLinks = 40;  // the kernel's limit
  fs::path path = named;
  std::error_code trouble;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, trouble)); ++i) {
    const fs::path target = fs::read_symlink(path, trouble);
    if (trouble) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

bool is_database(const fs::path& path) {
  std::error_code trouble;
  if (!fs::is_regular_file(path, trouble)) return false;
  try {
    return has_database_header(Connection(path.string(), SQLITE_OPEN_READONLY));
  } catch (const sqlite::SqliteError&) {
    return false;
  }
}

std::string sql_text(std::string_view text) {
  std::string literal = "'";
  for (const char letter : text) {
    if (letter == '\'') literal += letter;
    literal += letter;
  }
  return literal + "'";
}

}  // namespace swarmsmith
