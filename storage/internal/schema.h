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

/// "SwSm": marks an SQLite file as a store (PRAGMA application_id).
inline constexpr std::int64_t kApplicationId = 0x5377536d;
/// Version of tables and views (PRAGMA user_version). Any change of either is a new version, but
/// new modules in flavour_name are not.
inline constexpr std::int64_t kSchemaVersion = 15;
/// The last version that gave an existing table a column that a view shows. Views are lent to
/// stores of this version and later ones.
inline constexpr std::int64_t kTablesVersion = 6;

/// The step from one version to the next; runs in its own transaction. Views need no step, since
/// they are created again.
struct Migration {
  std::int64_t to = 0;
  std::function<void(sqlite::Connection&)> apply;
};

/// All steps, from version 1 on, in order.
std::span<const Migration> migrations();

/// Sets up a connection that writes: WAL, synchronous=FULL, foreign keys. Page size and journal
/// mode are kept in the file.
void configure_writer(sqlite::Connection& connection);
void configure_reader(sqlite::Connection& connection);
/// Adds this program's views to a reader's connection, until its temp_store changes. They are used
/// instead of the views in the file, whatever text those have; some have the text in
/// lent_views.sql. Does nothing for a store of a schema before kTablesVersion, which lacks more
/// than the newest views.
void lend_views(sqlite::Connection& connection);
/// Whether lend_views adds them.
bool has_our_views(const sqlite::Connection& connection);

/// Creates tables and views in an empty database; the caller holds a transaction.
void create_schema(sqlite::Connection& connection);

/// BadInput when two campaigns define different flavours of one name. To be called after a campaign
/// has been added.
Expected<void> check_flavours(const sqlite::Connection& connection);

/// Puts the names of all modules, of this program and of the campaigns' own flavours, into the
/// store's views. To be called after a flavour has been added. The caller holds a transaction.
void know_flavours(sqlite::Connection& connection);

/// Writes the host and the SQLite version with which the store is made into it.
void write_maker(sqlite::Connection& connection);

/// The row of a store's only campaign.
void write_campaign(sqlite::Connection& connection, const CampaignRow& campaign);
/// Writes a campaign's designs, whose ids come after `designs_before`; existing designs stay
/// unchanged.
void write_designs(sqlite::Connection& connection, const std::vector<DesignRow>& designs,
                   std::int64_t campaign = 1, std::int64_t designs_before = 0);

/// A database without tables and without an application id: new, or left by a crash while it was
/// made.
bool is_blank(const sqlite::Connection& connection);

/// Corrupt when the database belongs to another program, Newer when a later version made it.
Expected<void> check_identity(const sqlite::Connection& connection,
                              const std::filesystem::path& path);

/// Brings the store to the newest version of `steps`, after making a copy
/// `<path>.before-v<version>`. Each step is one transaction: after a crash, the store has the
/// previous version. In a store of the newest version, the names of modules are updated if this
/// program has other ones.
void migrate(sqlite::Connection& connection, const std::filesystem::path& path,
             std::span<const Migration> steps);

/// The same without a copy, for a file that is already a copy.
void upgrade(sqlite::Connection& connection, std::span<const Migration> steps);

/// Creates the tables of an earlier schema in an empty database, without views and version; the
/// caller holds a transaction.
void create_tables(sqlite::Connection& connection, std::int64_t schema);
/// Marks a database that has the tables of a schema as a store of this schema. Views are made for
/// the newest schema; a store of an earlier one gets its views when it is upgraded.
void finish_schema(sqlite::Connection& connection, std::int64_t schema);

}  // namespace swarmsmith
