#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// "SwSm": marks a SQLite file as one of ours (PRAGMA application_id).
inline constexpr std::int64_t kApplicationId = 0x5377536d;
/// Version of tables and views (PRAGMA user_version). A change of either is a new version;
/// modules more in flavour_name are not.
inline constexpr std::int64_t kSchemaVersion = 14;
/// The version that changed tables of before last: what came later are other views of the same
/// tables, indexes, and tables of their own.
inline constexpr std::int64_t kTablesVersion = 6;

/// The step from one version to the next; runs in a transaction of its own. Views need no step:
/// they are made anew.
struct Migration {
  std::int64_t to = 0;
  std::function<void(sqlite::Connection&)> apply;
};

/// Every step there is, from version 1 on, in order.
std::span<const Migration> migrations();

/// Settings of the connection that writes: WAL, synchronous=FULL, foreign keys. Page size and
/// journal mode are kept in the file.
void configure_writer(sqlite::Connection& connection);
void configure_reader(sqlite::Connection& connection);
/// Gives our views to a reader's connection, until its temp_store changes: they are read in place
/// of those of the file, whatever text those have; some in the words of lent_views.sql. Nothing for
/// a store that lacks more than the newest views, of a schema before kTablesVersion.
void lend_views(sqlite::Connection& connection);
/// Whether lend_views gives them.
bool has_our_views(const sqlite::Connection& connection);

/// Makes tables and views in an empty database; the caller holds a transaction.
void create_schema(sqlite::Connection& connection);

/// BadInput when two of the campaigns' own flavours have one name: to be called where a campaign
/// has been added.
Expected<void> check_flavours(const sqlite::Connection& connection);

/// Gives the store's views the names of all modules, of this program and of the campaigns' own
/// flavours: to be called where one has been added. The caller holds a transaction.
void know_flavours(sqlite::Connection& connection);

/// Writes into a new store on which host it was made, and by which SQLite.
void write_maker(sqlite::Connection& connection);

/// The row of a store's only campaign.
void write_campaign(sqlite::Connection& connection, const CampaignRow& campaign);
/// A campaign's designs, after so many others; those that are there stay.
void write_designs(sqlite::Connection& connection, const std::vector<DesignRow>& designs,
                   std::int64_t campaign = 1, std::int64_t designs_before = 0);

/// A database without a table or an owner: new, or left by a crash at its birth.
bool is_blank(const sqlite::Connection& connection);

/// Corrupt when the database belongs to another program, Newer when a later version made it.
Expected<void> check_identity(const sqlite::Connection& connection,
                              const std::filesystem::path& path);

/// Brings the store to the newest version of `steps`, after a copy `<path>.before-v<version>`.
/// Each step is one transaction: a crash leaves a store of the version before. In a store that is
/// up to date, the names of modules become those of this program, where it knows others.
void migrate(sqlite::Connection& connection, const std::filesystem::path& path,
             std::span<const Migration> steps);

/// The same without a copy: of a file that is one.
void upgrade(sqlite::Connection& connection, std::span<const Migration> steps);

/// Makes the tables of an earlier schema in an empty database, with neither views nor version; the
/// caller holds a transaction.
void create_tables(sqlite::Connection& connection, std::int64_t schema);
/// Marks a database with the tables of a schema as a store of it. The newest one's views are made;
/// an earlier one gets its views when it is upgraded.
void finish_schema(sqlite::Connection& connection, std::int64_t schema);

}  // namespace swarmsmith
