#include "storage/merge.h"

#include <array>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "storage/internal/copying.h"
#include "storage/internal/new_file.h"
#include "storage/internal/reading.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/row_writer.h"
#include "storage/internal/schema.h"
#include "storage/renumber.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::SqliteError;
using sqlite::Statement;

/// What is added to the ids, and to the numbers of campaigns and real runs.
struct Move : Shift {
  std::int64_t campaigns = 0;
  std::int64_t real_runs = 0;
};

/// Tables whose rows are copied column by column. Candidates are read and written as rows, sources
/// are matched by name, and calibrations are copied once for all stores. Only the profiles of
/// `meta` are copied: its other rows are about the file itself.
constexpr std::array kCopied{
    "campaign",   "design",         "pair",        "iteration",   "candidate_totals",
    "evaluation", "race_step",      "elimination", "elite",       "worker",
    "conflict",   "failure",        "attempt",     "event",       "command",
    "real_run",   "real_video",     "real_robot",  "real_sample", "real_reference",
    "real_patch", "real_cycle",     "real_issue",  "real_score",  "real_override",
    "real_log",   "real_log_cycle", "real_check"};

/// The SQL expression for an event's text in the new store: the ids in {"evaluation":"c80 on pair
/// 6","worker":1}, {"evaluation":"e8000006s"} and {"design":"d3"} are shifted, so that they name
/// the same things as before.
std::string moved_event(const Move& move) {
  return fmt::format(
      "iif(json_valid(text), json_replace(text, "
      "'$.design', 'd' || (CAST(substr(text ->> '$.design', 2) AS INTEGER) + {}), "
      "'$.evaluation', substr(text ->> '$.evaluation', 1, 1) || "
      "(CAST(substr(text ->> '$.evaluation', 2) AS INTEGER) + "
      "iif(text ->> '$.evaluation' LIKE 'e%', {}, {})) || "
      "ltrim(substr(text ->> '$.evaluation', 2), '0123456789'), "
      "'$.worker', iif(text ->> '$.worker' = 0, 0, (text ->> '$.worker') + {})), text)",
      move.designs, move.designs * kCandidatesPerDesign * kPairsPerCandidate,
      move.designs * kCandidatesPerDesign, move.workers);
}

/// The SQL expression for a column in the new store, from the source's row.
std::string moved(std::string_view table, const std::string& column, const Move& move) {
  const auto plus = [&](std::int64_t by) { return fmt::format("{} + {}", column, by); };
  const auto worker = [&] {
    return fmt::format("iif({0} = 0, 0, {0} + {1})", column, move.workers);
  };
  if (column == "id") {
    if (table == "campaign") return plus(move.campaigns);
    if (table == "design") return plus(move.designs);
    if (table == "real_run") return plus(move.real_runs);
    return plus(move.workers);  // of the table worker
  }
  if (column == "design" || column == "designs_before") return plus(move.designs);
  if (column == "candidate" || column == "best") return plus(move.designs * kCandidatesPerDesign);
  if (column == "campaign") return plus(move.campaigns);
  if (column == "worker" || column == "other_worker") return worker();
  if (column == "number" && table == "command") return plus(move.commands);
  if (column == "run") return plus(move.real_runs);
  if (column == "text" && table == "event") return moved_event(move);
  if (column == "seq") return "NULL";
  if (column == "source" && table == "evaluation") {
    return "(SELECT m.id FROM main.source AS m JOIN other.source AS s ON s.name = m.name"
           " WHERE s.id = t.source)";
  }
  // `row_check` among them: it covers the candidate's number in its design, and none of the numbers
  // that change here.
  return column;
}

void copy_table(Connection& connection, const std::string& table, const Move& move) {
  std::string columns;
  std::string values;
  Statement column(connection, "SELECT name FROM pragma_table_info(?) ORDER BY cid");
  column.bind(table);
  while (column.step()) {
    const std::string name = column.text(0);
    columns += (columns.empty() ? "" : ", ") + name;
    values += (values.empty() ? "" : ", ") + moved(table, name, move);
  }
  const std::string order = columns.find("seq") == 0 ? " ORDER BY seq" : "";
  connection.execute(fmt::format("INSERT INTO main.{} ({}) SELECT {} FROM other.{} AS t{}", table,
                                 columns, values, table, order));
}

std::int64_t largest(const Connection& connection, const char* column, const char* table) {
  return sqlite::integer_of(connection,
                            fmt::format("SELECT coalesce(max({}), 0) FROM {}", column, table));
}

/// A real run that an earlier store has is refused: its score would count twice.
Expected<void> check_new_runs(const Connection& connection, const fs::path& store) {
  Statement twice(connection,
                  "SELECT o.id, m.id FROM other.real_run AS o JOIN main.real_run AS m USING (key)");
  if (!twice.step()) return {};
  return unexpected(
      ErrorKind::Conflict,
      fmt::format("its real run {} is the same as {} of the stores before it; a real run is merged "
                  "once: leave one of the stores out",
                  to_string(RealRunId{twice.integer(0)}), to_string(RealRunId{twice.integer(1)})),
      store.string());
}

/// Warns of a film that is in several stores with other starts: it may show several runs, or one
/// run that was scored twice.
void warn_of_same_films(const Connection& connection, const fs::path& store, std::int64_t shift,
                        std::vector<std::string>& warnings) {
  Statement same(connection,
                 "SELECT o.run, m.run, min(m.file) FROM other.real_video AS o"
                 " JOIN main.real_video AS m ON m.sha256 = o.sha256 AND m.run <= ?"
                 " GROUP BY o.run, m.run ORDER BY o.run, m.run");
  same.bind(shift);
  while (same.step()) {
    const RealRunId own{same.integer(0) + shift};
    const RealRunId earlier{same.integer(1)};
    warnings.push_back(fmt::format(
        "{}: its real run r{} (now {}) is of the film of {}, {}, with another start; if they are "
        "one run, `swarmsmith track override {} --verdict invalid --who NAME --reason TEXT` leaves "
        "one out "
        "of the statistics",
        store.string(), same.integer(0), to_string(own), to_string(earlier), same.text(2),
        to_string(own)));
  }
}

/// Copies the profiles. Warns when an earlier store has another profile of the same name.
void take_profiles(Connection& connection, const Connection& other, const fs::path& store,
                   std::vector<std::string>& warnings) {
  for (const auto& [name, text] : read_kept_profiles(other)) {
    if (keep_profile(connection, name, text)) continue;
    warnings.push_back(fmt::format(
        "{}: candidates were evaluated under a profile {} that differs from the one in the stores "
        "before it; tables and figures treat their scores as scores of one profile",
        store.string(), name));
  }
}

/// Copies one store into the new one; `copy` is its copy, of the newest schema.
Expected<void> take(Connection& connection, const fs::path& store, const fs::path& copy,
                    std::vector<std::string>& warnings) {
  const Move move{{.designs = largest(connection, "id", "design"),
                   .workers = largest(connection, "id", "worker"),
                   .commands = largest(connection, "number", "command")},
                  largest(connection, "id", "campaign"),
                  largest(connection, "id", "real_run")};
  Connection other(copy.string(), SQLITE_OPEN_READONLY);
  configure_reader(other);
  Statement(connection, "ATTACH ? AS other").run(copy.string());
  if (auto fresh = check_new_runs(connection, store); !fresh) return fresh;
  warn_of_same_films(connection, store, move.real_runs, warnings);
  {
    sqlite::Transaction transaction(connection);
    connection.execute("PRAGMA defer_foreign_keys = ON");
    RowWriter writer(connection);
    read_candidates(other, {}, [&](const Row& row) { writer.write(shifted(row, move)); });
    connection.execute(
        "INSERT OR IGNORE INTO main.source (name) SELECT name FROM other.source"
        " ORDER BY id");
    connection.execute("INSERT OR IGNORE INTO main.calibration SELECT * FROM other.calibration");
    for (const char* table : kCopied)
      copy_table(connection, table, move);
    take_profiles(connection, other, store, warnings);
    transaction.commit();
  }
  connection.execute("DETACH other");
  return {};
}

/// A campaign that an earlier store has is refused: its designs would be there twice.
Expected<void> check_new(const std::vector<StoredCampaign>& coming, const fs::path& store,
                         std::map<std::string, fs::path>& known) {
  for (const StoredCampaign& campaign : coming) {
    const auto [found, is_new] = known.emplace(campaign.row.digest, store);
    if (is_new) continue;
    return unexpected(ErrorKind::Conflict,
                      fmt::format("the campaign {} (digest {}) is in {}, too; a campaign is merged "
                                  "once: leave one of the two stores out",
                                  campaign.row.name, campaign.row.digest, found->second.string()),
                      store.string());
  }
  return {};
}

void warn_of_unfinished(const std::vector<StoredCampaign>& campaigns, const fs::path& store,
                        std::vector<std::string>& warnings) {
  for (const StoredCampaign& campaign : campaigns) {
    if (campaign.state == "finished" || campaign.state == "imported") continue;
    warnings.push_back(
        fmt::format("{}: the campaign {} is not finished ({}); its designs are taken "
                    "as they are now",
                    store.string(), campaign.row.name, campaign.state));
  }
}

}  // namespace

Expected<Merged> merge_stores(const std::vector<fs::path>& stores, const fs::path& into,
                              const OnStore& on_store) {
  auto file = NewFile::beside(into);
  if (!file) return Unexpected(file.error());
  Merged merged;
  std::map<std::string, fs::path> known;
  try {
    Connection connection(file->path().string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    configure_writer(connection);
    {
      sqlite::Transaction transaction(connection);
      create_schema(connection);
      write_maker(connection);
      transaction.commit();
    }
    for (std::size_t i = 0; i < stores.size(); ++i) {
      on_store(static_cast<std::int64_t>(i), static_cast<std::int64_t>(stores.size()));
      auto copy = NewFile::beside(fmt::format("{}.store-{}", file->path().string(), i + 1));
      if (!copy) return Unexpected(copy.error());
      if (auto copied = copy_store(stores[i], copy->path(), [](auto, auto) {}); !copied) {
        return Unexpected(copied.error());
      }
      const auto campaigns =
          read_campaigns(Connection(copy->path().string(), SQLITE_OPEN_READONLY));
      if (auto fresh = check_new(campaigns, stores[i], known); !fresh) {
        return Unexpected(fresh.error());
      }
      warn_of_unfinished(campaigns, stores[i], merged.warnings);
      if (auto taken = take(connection, stores[i], copy->path(), merged.warnings); !taken) {
        return Unexpected(taken.error());
      }
    }
    if (auto flavours = check_flavours(connection); !flavours) return Unexpected(flavours.error());
    sqlite::Transaction transaction(connection);
    know_flavours(connection);
    RowSums::found(connection).write(connection);
    transaction.commit();
    if (const auto faults = faults_of(connection); !faults.empty()) {
      return unexpected(ErrorKind::Corrupt, "what was merged is damaged: " + faults.front(),
                        into.string());
    }
    merged.campaigns = read_campaigns(connection);
    const ReadTransaction snapshot(connection);
    merged.digest = digest_of_store(connection);
  } catch (const SqliteError& error) {
    return copying_failed(error, into, into);
  }
  if (auto published = file->publish(); !published) return Unexpected(published.error());
  return merged;
}

}  // namespace swarmsmith
