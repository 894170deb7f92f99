#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "storage/internal/sqlite.h"
#include "storage/store.h"

namespace swarmsmith {

/// Whether this user cannot make files in the folder of `path`.
bool cannot_make_files(const std::filesystem::path& path);

/// A connection that only reads; it works also where no file can be made beside the store. Corrupt
/// when the file is not a database or is cut off. Throws SqliteError.
Expected<sqlite::Connection> connect_for_reading(const std::filesystem::path& path);

/// Shows one state of the store to several statements; a reader's transaction only ever reads.
class ReadTransaction {
 public:
  explicit ReadTransaction(sqlite::Connection& connection) : connection_(connection) {
    connection_.execute("BEGIN");
  }
  ReadTransaction(const ReadTransaction&) = delete;
  ReadTransaction& operator=(const ReadTransaction&) = delete;
  ~ReadTransaction() { sqlite3_exec(connection_.handle(), "ROLLBACK", nullptr, nullptr, nullptr); }

 private:
  sqlite::Connection& connection_;
};

/// The digest of one campaign, with the ids that it has when it is alone in a store. Within a
/// ReadTransaction.
std::string digest_of_campaign(const sqlite::Connection& connection,
                               const StoredCampaign& campaign);
/// StoreReader::digest of the whole store. Within a ReadTransaction.
std::string digest_of_store(const sqlite::Connection& connection);

/// Reports once, after two seconds, that a store is being checked (set_check_listener), as long as
/// this object exists.
class LongCheck {
 public:
  LongCheck(sqlite::Connection& connection, const std::filesystem::path& path);
  LongCheck(const LongCheck&) = delete;
  LongCheck& operator=(const LongCheck&) = delete;
  ~LongCheck();

 private:
  using SteadyClock = std::chrono::steady_clock;
  void look();

  sqlite::Connection& connection_;
  std::filesystem::path path_;
  SteadyClock::time_point until_;
  bool is_told_ = false;
};

/// A sentence when the texts of candidates cannot be made from their codes, or are longer than a
/// store's texts can be; else empty.
std::string lost_texts(const sqlite::Connection& connection);

/// The faults that SQLite's integrity check and foreign keys find, and rows that are not the
/// committed ones (RowSums): one sentence per fault.
std::vector<std::string> faults_of(const sqlite::Connection& connection);

/// "this store has schema 3; `swarmsmith backup old.db new.db` makes a copy with schema 4".
std::string older_schema_text(std::int64_t schema, const std::string& name);

}  // namespace swarmsmith
