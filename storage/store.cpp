#include "storage/store.h"

#include <utility>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"
#include "storage/internal/group_writer.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

/// The leaves of two JSON objects that differ, in the order of the second.
constexpr char kDifferingKeys[] = R"(
WITH here AS (SELECT id, fullkey, coalesce(atom, value) AS text FROM json_tree(?1)
              WHERE id > 0 AND (type NOT IN ('object', 'array') OR value IN ('{}', '[]'))),
     wanted AS (SELECT id, fullkey, coalesce(atom, value) AS text FROM json_tree(?2)
                WHERE id > 0 AND (type NOT IN ('object', 'array') OR value IN ('{}', '[]')))
SELECT coalesce(here.fullkey, wanted.fullkey),
       iif(here.fullkey IS NULL, 'nothing', coalesce(here.text, 'null')),
       iif(wanted.fullkey IS NULL, 'nothing', coalesce(wanted.text, 'null'))
FROM here FULL JOIN wanted ON wanted.fullkey = here.fullkey
WHERE here.text IS NOT wanted.text OR here.fullkey IS NULL OR wanted.fullkey IS NULL
ORDER BY wanted.id IS NULL, wanted.id, here.id)";

/// "budget is 1000 in the store and 2000 in the campaign; ..."
std::string differing_keys(const Connection& connection, const std::string& here,
                           const std::string& wanted) {
  constexpr int kMost = 10;
  std::string text;
  int found = 0;
  try {
    Statement row(connection, kDifferingKeys);
    row.bind(here, wanted);
    while (row.step()) {
      if (++found > kMost) continue;
      std::string key = row.text(0);
      if (key.starts_with("$.")) key.erase(0, 2);
      text += fmt::format("; {} is {} in the store and {} in the campaign", key, row.text(1),
                          row.text(2));
    }
  } catch (const sqlite::SqliteError&) {
    return "; what decides it cannot be compared (no JSON object)";
  }
  if (found > kMost) text += fmt::format("; and {} more", found - kMost);
  return text;
}

Expected<void> check_campaign(const Connection& connection, const fs::path& path,
                              const CampaignRow& wanted) {
  const std::vector<StoredCampaign> all = read_campaigns(connection);
  if (all.size() > 1) {
    return unexpected(
        ErrorKind::Conflict,
        fmt::format("the store holds {} campaigns: it was merged or imported into, and is there to "
                    "be read; name the campaign's own store, or a new one",
                    all.size()),
        path.string());
  }
  const CampaignRow& here = all.front().row;
  if (here.digest == wanted.digest) return {};
  return unexpected(
      ErrorKind::Conflict,
      fmt::format("the store holds another campaign ({}, digest {}; wanted {}, digest {}){}; name "
                  "another store, or run the campaign that made this one",
                  here.name, here.digest, wanted.name, wanted.digest,
                  differing_keys(connection, here.deciding, wanted.deciding)),
      path.string());
}

void write_birth(Connection& connection, const CampaignRow& campaign,
                 const std::vector<DesignRow>& designs) {
  sqlite::Transaction transaction(connection);
  create_schema(connection);
  write_maker(connection);
  write_campaign(connection, campaign);
  write_designs(connection, designs);
  transaction.commit();
}

/// A store of a schema before 4 does not say in which flavour its machines are written.
void name_flavours(Connection& connection, const std::vector<DesignRow>& designs) {
  sqlite::Transaction transaction(connection);
  Statement design(connection, "UPDATE design SET flavour = ?2 WHERE id = ?1 AND flavour = ''");
  for (const DesignRow& row : designs)
    if (!row.flavour.empty()) design.run(row.id.value, row.flavour);
  transaction.commit();
}

/// Folds in the log that a crash has left and looks at every page.
Expected<void> recover(Connection& connection, const fs::path& path) {
  connection.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  if (auto sound = check_database_file(path); !sound) return sound;
  const std::string fault = sqlite::text_of(connection, "PRAGMA quick_check(1)");
  if (fault == "ok") return {};
  return unexpected(ErrorKind::Corrupt, damaged_text(fault + ", and it was not closed properly"),
                    path.string());
}

/// Checks first and changes nothing until it is sure that the file is ours.
Expected<Connection> prepare(const fs::path& path, bool unclean, const CampaignRow& campaign,
                             const std::vector<DesignRow>& designs) {
  Connection connection(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (sqlite3_db_readonly(connection.handle(), "main") != 0) {
    return bad_input("the store may not be written by this user", path.string());
  }
  // A reader may be the first to open a store whose coordinator was killed: it then recovers the
  // log, and holds the file for that moment.
  sqlite3_busy_timeout(connection.handle(), 5000);
  const bool blank = is_blank(connection);
  if (!blank) {
    if (auto ours = check_identity(connection, path); !ours) return Unexpected(ours.error());
  }
  configure_writer(connection);
  if (sqlite::text_of(connection, "PRAGMA journal_mode") != "wal") {
    return bad_input("the file system cannot hold a write-ahead log; put the store on a local disk",
                     path.string());
  }
  if (blank) {
    write_birth(connection, campaign, designs);
    return connection;
  }
  if (unclean) {
    if (auto sound = recover(connection, path); !sound) return Unexpected(sound.error());
  }
  migrate(connection, path, migrations());
  if (auto same = check_campaign(connection, path, campaign); !same) {
    return Unexpected(same.error());
  }
  name_flavours(connection, designs);
  return connection;
}

Unexpected refused(const sqlite::SqliteError& error, const fs::path& path) {
  const int code = error.primary_code();
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    return unexpected(ErrorKind::Corrupt, damaged_text(error.what()), path.string());
  }
  return unexpected(ErrorKind::Unavailable,
                    fmt::format("the store cannot be opened for writing: {}", error.what()),
                    path.string());
}

}  // namespace

Expected<std::unique_ptr<Store>> Store::open(const fs::path& path, const CampaignRow& campaign,
                                             const std::vector<DesignRow>& designs,
                                             const StoreOptions& options) {
  if (auto folder = check_folder(path); !folder) return Unexpected(folder.error());
  auto lock = LockFile::acquire(path, options.patience);
  if (!lock) return Unexpected(lock.error());
  const bool exists = fs::exists(path);
  const bool unclean = exists && (lock->left_behind() || has_pending_log(path));
  lock->set_suspect(unclean);
  if (exists) {
    if (auto sound = check_database_file(path); !sound) return Unexpected(sound.error());
  }
  try {
    auto connection = prepare(path, unclean, campaign, designs);
    if (!connection) return Unexpected(connection.error());
    lock->set_suspect(false);
    return std::make_unique<GroupWriter>(std::move(*lock), std::move(*connection), options);
  } catch (const sqlite::SqliteError& error) {
    return refused(error, path);
  }
}

}  // namespace swarmsmith
