#include "storage/store.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"
#include "storage/internal/group_writer.h"
#include "storage/internal/open_writer.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

/// The leaves in which two JSON objects differ, in the order of the second.
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
  // Imported designs may be beside those of a campaign, and do not matter here.
  const auto run_here = std::ranges::count_if(
      all, [](const StoredCampaign& each) { return each.state != "imported"; });
  if (run_here > 1) {
    return unexpected(ErrorKind::Conflict,
                      fmt::format("the store holds {} campaigns and is read-only (merged); name "
                                  "the campaign's own store, or a new one",
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
  write_empty_store(connection);
  write_campaign(connection, campaign);
  write_designs(connection, designs);
  keep_sums(connection);
  transaction.commit();
}

/// Changes the store only after it has found that it belongs to the campaign.
Expected<void> prepare(Connection& connection, const fs::path& path, const CampaignRow& campaign,
                       const std::vector<DesignRow>& designs) {
  if (is_blank(connection)) {
    write_birth(connection, campaign, designs);
    return {};
  }
  migrate(connection, path, migrations());
  if (auto same = check_campaign(connection, path, campaign); !same) return same;
  name_flavours(connection, designs);
  keep_sums(connection);
  return {};
}

}  // namespace

Expected<std::unique_ptr<Store>> Store::open(const fs::path& named, const CampaignRow& campaign,
                                             const std::vector<DesignRow>& designs,
                                             const StoreOptions& options) {
  const fs::path path = real_store(named);
  if (auto folder = check_folder(path); !folder) return Unexpected(folder.error());
  try {
    auto writer = open_writer(path, options.patience);
    if (!writer) return Unexpected(writer.error());
    if (auto ready = prepare(writer->connection, path, campaign, designs); !ready) {
      return Unexpected(ready.error());
    }
    writer->lock.set_suspect(false);
    return std::make_unique<GroupWriter>(std::move(*writer), options);
  } catch (const sqlite::SqliteError& error) {
    return not_writable(error, path);
  }
}

}  // namespace swarmsmith
