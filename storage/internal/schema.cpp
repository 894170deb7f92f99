#include "storage/internal/schema.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "storage/internal/row_sums.h"

#include "embedded/kLentViews.h"
#include "sim/control/flavour_file.h"
#include "storage/internal/machine_parts.h"
#include "storage/internal/schema_files.h"
#include "storage/internal/view_text.h"

namespace swarmsmith {
namespace {

void drop_views(sqlite::Connection& connection) {
  std::vector<std::string> names;
  sqlite::Statement view(connection, "SELECT name FROM sqlite_schema WHERE type = 'view'");
  while (view.step())
    names.push_back(view.text(0));
  for (const std::string& name : names)
    connection.execute("DROP VIEW \"" + name + "\"");
}

void set_version(sqlite::Connection& connection, std::int64_t version) {
  connection.execute(fmt::format("PRAGMA user_version = {}", version));
}

constexpr std::chrono::milliseconds kPatience{5000};

/// Sets WAL mode. SQLite does not wait for the lock here, since it reads before it writes. Another
/// connection may hold the write lock for a moment: for example, each client that removes the
/// journal of a coordinator that died while it made the store.
void use_write_ahead_log(sqlite::Connection& connection) {
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (true) {
    try {
      return connection.execute("PRAGMA journal_mode = WAL");
    } catch (const sqlite::SqliteError& error) {
      if (error.primary_code() != SQLITE_BUSY || std::chrono::steady_clock::now() > until) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
}

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

/// The flavours of the store's campaigns that are not built in.
std::vector<const Flavour*> own_flavours(const sqlite::Connection& connection) {
  std::vector<const Flavour*> flavours;
  sqlite::Statement file(connection, "SELECT file FROM campaign ORDER BY id");
  while (file.step()) {
    for (const Flavour* flavour : own_flavours_in(file.text(0)))
      flavours.push_back(flavour);
  }
  return flavours;
}

}  // namespace

static_assert(kSchemaFiles.front().version == 1 && kSchemaFiles.back().version <= kSchemaVersion);

Expected<void> check_flavours(const sqlite::Connection& connection) {
  std::map<std::string, const Flavour*> known;
  for (const Flavour* flavour : own_flavours(connection)) {
    if (*known.try_emplace(flavour->name, flavour).first->second == *flavour) continue;
    return bad_input(
        "two campaigns have different flavours of the name " + flavour->name +
        ", and a store identifies modules by it; give one of them another name, or keep "
        "them in stores of their own");
  }
  return {};
}

void know_flavours(sqlite::Connection& connection) {
  const std::string view = flavour_view(own_flavours(connection));
  const std::string known = sqlite::text_of(
      connection,
      "SELECT sql || ';' FROM sqlite_schema WHERE type = 'view' AND name = 'flavour_name'");
  if (without_blanks(known) == without_blanks(view)) return;
  connection.execute("DROP VIEW flavour_name; " + view);
}

std::span<const Migration> migrations() {
  static const std::vector<Migration> kMigrations = [] {
    std::vector<Migration> steps;
    for (std::int64_t version = 2; version <= kSchemaVersion; ++version) {
      const auto file = std::ranges::find(kSchemaFiles, version, &SchemaFile::version);
      // Versions without a file only change views.
      const std::string sql(file == kSchemaFiles.end() ? "" : file->sql);
      steps.push_back(
          {version, [sql](sqlite::Connection& connection) { connection.execute(sql); }});
    }
    return steps;
  }();
  return kMigrations;
}

void configure_writer(sqlite::Connection& connection) {
  sqlite3_busy_timeout(connection.handle(), static_cast<int>(kPatience.count()));
  // 1000 pages of 8 KiB: the log is moved into the store every 8 MB, so that a small disk is enough
  // for a campaign. It grows further only while a reader keeps an old state open.
  connection.execute(
      "PRAGMA page_size = 8192; PRAGMA synchronous = FULL;"
      "PRAGMA foreign_keys = ON; PRAGMA wal_autocheckpoint = 1000;"
      "PRAGMA journal_size_limit = 16777216; PRAGMA cache_size = -16384");
  use_write_ahead_log(connection);
}

void configure_reader(sqlite::Connection& connection) {
  sqlite3_busy_timeout(connection.handle(), static_cast<int>(kPatience.count()));
  connection.execute("PRAGMA query_only = ON; PRAGMA cache_size = -65536");
  add_machine_functions(connection);
}

bool has_our_views(const sqlite::Connection& connection) {
  return sqlite::integer_of(connection, "PRAGMA user_version") >= kTablesVersion;
}

void lend_views(sqlite::Connection& connection) {
  if (!has_our_views(connection)) return;
  if (sqlite::integer_of(connection, "SELECT count(*) FROM temp.sqlite_schema") > 0) return;
  constexpr std::string_view kCreate = "CREATE VIEW ";
  constexpr std::string_view kLend = "CREATE TEMP VIEW IF NOT EXISTS ";
  // If a name occurs twice, the first view is used.
  std::string views = kLentViews + our_views(own_flavours(connection));
  for (std::size_t at = 0; (at = views.find(kCreate, at)) != std::string::npos; at += kLend.size())
    views.replace(at, kCreate.size(), kLend);
  connection.execute("PRAGMA query_only = OFF; " + views + "; PRAGMA query_only = ON");
}

void create_tables(sqlite::Connection& connection, std::int64_t schema) {
  connection.execute(std::string(kSchemaFiles.front().sql));
  for (const Migration& step : migrations()) {
    if (step.to <= schema) step.apply(connection);
  }
}

void create_schema(sqlite::Connection& connection) {
  create_tables(connection, kSchemaVersion);
  finish_schema(connection, kSchemaVersion);
}

void finish_schema(sqlite::Connection& connection, std::int64_t schema) {
  if (schema == kSchemaVersion) connection.execute(our_views(own_flavours(connection)));
  connection.execute(fmt::format("PRAGMA application_id = {}", kApplicationId));
  set_version(connection, schema);
}

void write_maker(sqlite::Connection& connection) {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host = {"unknown"};
  sqlite::Statement meta(connection, "INSERT OR REPLACE INTO meta VALUES (?,?)");
  meta.run(std::string_view("host"), std::string_view(host.data()));
  meta.run(std::string_view("sqlite"), std::string_view(sqlite3_libversion()));
}

void write_campaign(sqlite::Connection& connection, const CampaignRow& campaign) {
  sqlite::Statement(
      connection,
      "INSERT INTO campaign (id, name, digest, deciding, file, seed) VALUES (1,?,?,?,?,?)")
      .run(campaign.name, campaign.digest, campaign.deciding, campaign.file, campaign.seed);
  know_flavours(connection);
}

void write_designs(sqlite::Connection& connection, const std::vector<DesignRow>& designs,
                   std::int64_t campaign, std::int64_t designs_before) {
  sqlite::Statement design(
      connection,
      "INSERT OR IGNORE INTO design (id, campaign, mission, method, flavour, repetition, seed,"
      " budget) VALUES (?,?,?,?,?,?,?,?)");
  for (const DesignRow& row : designs) {
    design.run(row.id.value + designs_before, campaign, row.mission, row.method, row.flavour,
               row.repetition, row.seed, row.budget);
  }
}

bool is_blank(const sqlite::Connection& connection) {
  return sqlite::integer_of(connection, "SELECT count(*) FROM sqlite_schema") == 0 &&
         sqlite::integer_of(connection, "PRAGMA application_id") == 0 &&
         sqlite::integer_of(connection, "PRAGMA user_version") == 0;
}

Expected<void> check_identity(const sqlite::Connection& connection,
                              const std::filesystem::path& path) {
  if (sqlite::integer_of(connection, "PRAGMA application_id") != kApplicationId) {
    return unexpected(
        ErrorKind::Corrupt,
        "this is an SQLite database of another program, not a store; name another path",
        path.string());
  }
  const std::int64_t version = sqlite::integer_of(connection, "PRAGMA user_version");
  if (version > kSchemaVersion) {
    return unexpected(ErrorKind::Newer,
                      fmt::format("the store has schema {}, and this program knows {} at most; use "
                                  "the version of swarmsmith that wrote it, or a later one",
                                  version, kSchemaVersion),
                      path.string());
  }
  return {};
}

void migrate(sqlite::Connection& connection, const std::filesystem::path& path,
             std::span<const Migration> steps) {
  const std::int64_t from = sqlite::integer_of(connection, "PRAGMA user_version");
  if (steps.empty() || steps.back().to <= from) {
    if (from != kSchemaVersion) return;
    sqlite::Transaction transaction(connection);
    know_flavours(connection);
    return transaction.commit();
  }
  // A copy with that name can only be from an earlier, interrupted attempt: the store has not
  // changed since then.
  const std::string copy = fmt::format("{}.before-v{}", path.string(), steps.back().to);
  std::error_code stays;  // if it could not be removed, SQLite reports that
  std::filesystem::remove(copy, stays);
  sqlite::Statement(connection, "VACUUM INTO ?").run(copy);
  upgrade(connection, steps);
}

void upgrade(sqlite::Connection& connection, std::span<const Migration> steps) {
  const std::int64_t from = sqlite::integer_of(connection, "PRAGMA user_version");
  for (const Migration& step : steps) {
    if (step.to <= from) continue;
    sqlite::Transaction transaction(connection);
    drop_views(connection);  // ALTER TABLE would fail on them
    step.apply(connection);
    connection.execute(our_views(own_flavours(connection)));
    set_version(connection, step.to);
    // The step may have added columns that the sums cover.
    if (RowSums::stored(connection)) RowSums::found(connection).write(connection);
    transaction.commit();
  }
}

}  // namespace swarmsmith
