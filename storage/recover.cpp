#include "storage/recover.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "storage/internal/copying.h"
#include "storage/internal/mend_real_runs.h"
#include "storage/internal/new_file.h"
#include "storage/internal/reading.h"
#include "storage/internal/real_run_writer.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/row_writer.h"
#include "storage/internal/salvage.h"
#include "storage/internal/schema.h"
#include "storage/renumber.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::SqliteError;
using sqlite::Statement;

/// Statements that remove rows with values that only damage can have caused, but that the types of
/// the columns allow.
std::vector<std::string> nonsense() {
  const std::string other_purpose = "purpose NOT IN " + numbers_in_sql(is_any);
  const std::string other_verdict = "verdict NOT IN " + verdicts_in_sql();
  return {
      "DELETE FROM design WHERE id < 1 OR state NOT IN " + numbers_in_sql(all_design_states()),
      "DELETE FROM candidate WHERE id < 1 OR iteration < 0",
      "DELETE FROM pair WHERE number < 1 OR " + other_purpose,
      "DELETE FROM evaluation WHERE pair < 1 OR " + other_purpose + " OR status NOT IN " +
          numbers_in_sql(all_statuses()) +
          fmt::format(" OR (status = {}) <> (score IS NOT NULL)",
                      static_cast<int>(EvaluationStatus::Ok)),
      "DELETE FROM race_step WHERE step < 1",
      "DELETE FROM real_run WHERE id < 1",
      "DELETE FROM real_score WHERE " + other_verdict,
      "DELETE FROM real_override WHERE " + other_verdict,
  };
}

/// Statements that remove rows that refer to a lost row. Each statement may make other rows such
/// orphans, so all are repeated until they remove nothing more.
constexpr std::array kOrphans{
    "DELETE FROM candidate WHERE (id - 1) / 1000000 + 1 NOT IN (SELECT id FROM design)",
    "DELETE FROM candidate WHERE parent IS NOT NULL AND parent NOT IN (SELECT id FROM candidate)",
    "DELETE FROM evaluation WHERE candidate NOT IN (SELECT id FROM candidate)"
    " OR source NOT IN (SELECT id FROM source)",
    "DELETE FROM candidate_totals WHERE candidate NOT IN (SELECT id FROM candidate)",
    "DELETE FROM elimination WHERE candidate NOT IN (SELECT id FROM candidate)",
    "DELETE FROM elite WHERE candidate NOT IN (SELECT id FROM candidate)"
    " OR design NOT IN (SELECT id FROM design)",
    "DELETE FROM iteration WHERE design NOT IN (SELECT id FROM design)",
    "DELETE FROM pair WHERE design NOT IN (SELECT id FROM design)",
    "DELETE FROM race_step WHERE design NOT IN (SELECT id FROM design)"
    " OR best IS NOT NULL AND best NOT IN (SELECT id FROM candidate)",
    "DELETE FROM command WHERE design IS NOT NULL AND design NOT IN (SELECT id FROM design)",
};

/// The ranges of ids of one campaign, with the names that the tables use.
struct Bounds {
  std::int64_t first_design, last_design, first_candidate, last_candidate;

  explicit Bounds(const StoredCampaign& campaign)
      : first_design(campaign.designs_before + 1),
        last_design(campaign.designs_before + campaign.designs),
        first_candidate(campaign.designs_before * kCandidatesPerDesign + 1),
        last_candidate(last_design * kCandidatesPerDesign) {}
};

/// A table that does not follow from scores alone, and whether a replay can repair its values.
struct Changed {
  RowSums::Table table;
  const char* name;
  bool is_derived_by_races = false;  ///< in campaigns whose races can be replayed
};
constexpr std::array kNotDerived{
    Changed{RowSums::Table::Candidate, "candidate", true},
    Changed{RowSums::Table::Phrase, "phrase", true},
    Changed{RowSums::Table::Pair, "pair", true},
    Changed{RowSums::Table::Source, "source"},
    Changed{RowSums::Table::Evaluation, "evaluation"},
    Changed{RowSums::Table::Campaign, "campaign"},
    Changed{RowSums::Table::Command, "command"},
    Changed{RowSums::Table::RealRun, "real_run"},
    Changed{RowSums::Table::RealScore, "real_score"},
    Changed{RowSums::Table::RealOverride, "real_override"},
};

Part part_of(const StoredCampaign& campaign) {
  return {.designs_before = campaign.designs_before, .designs = campaign.designs};
}

class SqliteRecovery final : public Recovery {
 public:
  SqliteRecovery(NewFile file, Connection connection, const PageFind& found, bool header)
      : file_(std::move(file)), connection_(std::move(connection)) {
    found_ = {.schema = found.schema,
              .header_is_damaged = header || found.schema_is_guessed,
              .pages = found.pages,
              .unplaced = found.unplaced,
              .tables = {}};
    for (const TableFind& table : found.tables)
      found_.tables.push_back(
          {table.name, table.rows, table.lost_pages, table.broken, table.tree_is_lost});
    // Before any row is removed: only tables with as many rows as were committed can show whether
    // values were changed.
    if (const auto written = RowSums::stored(connection_)) {
      const RowSums there = RowSums::found(connection_);
      for (const Changed table : kNotDerived)
        if (written->has_other_values(table.table, there)) changed_.push_back(table);
    }
    found_.changed_evaluations = remove_changed_evaluations(connection_);
    for (const std::string& statement : nonsense())
      remove(statement);
    // This must come before any row is written: new phrases may get the numbers of lost ones, and
    // derived candidates do not replace existing rows.
    for (const CandidateId lost : candidates_without_phrases(connection_))
      remove(fmt::format("DELETE FROM candidate WHERE id = {}", lost.value));
  }

  const Salvaged& found() const override { return found_; }

  std::vector<StoredCampaign> campaigns() override {
    if (sqlite::integer_of(connection_, "SELECT count(*) FROM campaign") == 0) return {};
    return read_campaigns(connection_);
  }

  Expected<Without> drop_words_of(const std::string& key) override;
  void put_campaign(const CampaignRow& campaign) override { write_campaign(connection_, campaign); }
  Expected<void> put_designs(const StoredCampaign& campaign,
                             const std::vector<DesignRow>& designs) override;

  std::vector<StoredScore> scores(const StoredCampaign& campaign) override {
    return read_scores(connection_, part_of(campaign));
  }
  std::vector<StoredStep> steps(const StoredCampaign& campaign) override {
    const Bounds bounds(campaign);
    std::vector<StoredStep> steps = read_steps(connection_);
    std::erase_if(steps, [&](const StoredStep& step) {
      return step.design.value < bounds.first_design || step.design.value > bounds.last_design;
    });
    for (StoredStep& step : steps)
      step.design.value -= campaign.designs_before;
    return steps;
  }
  std::vector<CommandRow> commands(const StoredCampaign& campaign) override {
    return read_commands(connection_, part_of(campaign));
  }

  std::int64_t replace_derived(const StoredCampaign& campaign, const DerivedRows& derived,
                               const std::string& source) override;
  Expected<End> finish() override;

 private:
  void remove(const std::string& statement) {
    connection_.execute(statement);
    orphans_ += connection_.changes();
  }
  std::int64_t remove_others(const StoredCampaign& campaign, const DerivedRows& derived,
                             const Shift& shift);
  std::int64_t keep_imports();
  std::string doubt();

  NewFile file_;
  Connection connection_;
  Salvaged found_;
  std::int64_t orphans_ = 0;
  bool is_trusted_again_ = false;  ///< the reason not to trust the store has been removed
  std::vector<Changed> changed_;   ///< tables with other values than the committed ones
  std::set<std::int64_t> derived_campaigns_;
};

Expected<Recovery::Without> SqliteRecovery::drop_words_of(const std::string& key) {
  const std::string theirs = "(SELECT id FROM worker WHERE client = ?1 OR principal = ?1)";
  const auto run = [&](const std::string& statement) {
    Statement(connection_, statement).run(key);
    return connection_.changes();
  };
  Without without;
  {
    Statement count(connection_, "SELECT count(*) FROM worker WHERE id IN " + theirs);
    count.bind(key);
    count.step();
    without.workers = count.integer(0);
  }
  if (without.workers == 0) {
    std::string known;
    Statement name(connection_,
                   "SELECT DISTINCT iif(client <> '', client, principal) FROM worker"
                   " WHERE principal <> '' AND principal NOT LIKE 'local %' ORDER BY 1 LIMIT 20");
    while (name.step())
      known += (known.empty() ? "" : ", ") + name.text(0);
    return unexpected(
        ErrorKind::NotFound,
        "no worker of this store has that key; " +
            (known.empty() ? "all of them were started by the coordinator itself"
                           : "the keys, and addresses of workers without one, are: " + known),
        key);
  }
  sqlite::Transaction transaction(connection_);
  // Attempts, failures and conflicts belong to the removed evaluations. When another worker repeats
  // the evaluation, that is a new one, and these rows are not about it.
  for (const char* table : {"attempt", "failure", "conflict"}) {
    run(fmt::format(
        "DELETE FROM {} WHERE (candidate, purpose, pair) IN (SELECT candidate, purpose,"
        " pair FROM evaluation WHERE worker IN {}) OR {} IN {}",
        table, theirs, std::string_view(table) == "conflict" ? "other_worker" : "worker", theirs));
  }
  // Evaluations whose worker has no row cannot be trusted either.
  without.evaluations = run("DELETE FROM evaluation WHERE worker IN " + theirs +
                            " OR worker <> 0 AND worker NOT IN (SELECT id FROM worker)");
  const std::string reason =
      fmt::format("`recover --without-key` removed {} that its {} gave",
                  counted(without.evaluations, "evaluation"), counted(without.workers, "worker"));
  // If the principal is only a key, it means the key at every address.
  run("UPDATE worker SET principal = ?1, state = 'quarantined' WHERE id IN " + theirs);
  const EventRow event =
      event_row("error", "workers in quarantine", {{"who", key}, {"reason", reason}});
  Statement(connection_, "INSERT INTO event (severity, kind, text) VALUES (?, ?, ?)")
      .run(event.severity, event.kind, event.text);
  transaction.commit();
  is_trusted_again_ = true;
  return without;
}

Expected<void> SqliteRecovery::put_designs(const StoredCampaign& campaign,
                                           const std::vector<DesignRow>& designs) {
  for (const DesignRow& stored : read_designs(connection_, part_of(campaign))) {
    const auto same = std::ranges::find_if(designs, [&](const DesignRow& design) {
      return design.id == stored.id && design.mission == stored.mission &&
             design.method == stored.method && design.repetition == stored.repetition &&
             design.seed == stored.seed;
    });
    if (same != designs.end()) continue;
    return unexpected(
        ErrorKind::Conflict,
        fmt::format("a design {} of {} and {}, repetition {}, seed {} was found, which the "
                    "campaign {} does not have; name the campaign's own file",
                    to_string(stored.id), stored.mission, stored.method, stored.repetition,
                    stored.seed, campaign.row.name));
  }
  write_designs(connection_, designs, campaign.id, campaign.designs_before);
  return {};
}

/// The derived rows are right: they replace candidates and pairs with other values. If the stored
/// candidates cannot be trusted, those that the races do not reach are removed with their scores;
/// the races make them again. After false results, the scores of every candidate whose row differs
/// from the derived one are removed, too: the false results may have changed the race, so that
/// another machine had this number.
std::int64_t SqliteRecovery::remove_others(const StoredCampaign& campaign,
                                           const DerivedRows& derived, const Shift& shift) {
  const Bounds bounds(campaign);
  const bool only_derived =
      is_trusted_again_ || std::ranges::any_of(changed_, &Changed::is_derived_by_races);
  connection_.execute(
      "CREATE TEMP TABLE derived_candidate (id INTEGER PRIMARY KEY, is_stored INTEGER);"
      "CREATE TEMP TABLE derived_pair (design, purpose, number, instance, seed,"
      " PRIMARY KEY (design, purpose, number))");
  std::unordered_map<std::int64_t, const CandidateRow*> candidates;
  {
    Statement pair(connection_, "INSERT OR IGNORE INTO derived_pair VALUES (?, ?, ?, ?, ?)");
    for (const Row& derived_row : derived.rows) {
      if (const auto* r = std::get_if<CandidateRow>(&derived_row)) {
        candidates.try_emplace(r->id.value, r);
      } else if (const auto* p = std::get_if<PairRow>(&derived_row)) {
        pair.run(p->design.value + shift.designs, static_cast<std::int64_t>(p->purpose), p->number,
                 p->instance, p->seed);
      }
    }
    Statement candidate(connection_, "INSERT OR REPLACE INTO derived_candidate VALUES (?, ?)");
    const std::int64_t before = shift.designs * kCandidatesPerDesign;
    for (const auto& [id, row] : candidates)
      candidate.run(id + before, false);
    read_candidates(connection_, part_of(campaign), [&](const Row& row) {
      const auto& stored = std::get<CandidateRow>(row);
      const auto known = candidates.find(stored.id.value);
      if (known != candidates.end() && *known->second == stored)
        candidate.run(stored.id.value + before, true);
    });
  }
  const auto run = [&](const std::string& statement, std::int64_t first, std::int64_t last) {
    Statement(connection_, statement).run(first, last);
    return connection_.changes();
  };
  const std::string of_replay = "purpose IN " + numbers_in_sql(is_of_replay);
  const std::string same = "(SELECT id FROM derived_candidate WHERE is_stored)";
  const std::string reached = "(SELECT id FROM derived_candidate)";
  std::int64_t taken = 0;
  if (only_derived) {
    // Where only the row of a candidate is wrong, its scores are still those of the right machine;
    // after false results this is not certain.
    taken = run(
        fmt::format("DELETE FROM evaluation WHERE candidate BETWEEN ? AND ? AND (candidate NOT IN"
                    " {} OR {} AND ((candidate - 1) / {} + 1, purpose, pair) NOT IN (SELECT design,"
                    " purpose, number FROM derived_pair))",
                    is_trusted_again_ ? same : reached, of_replay, kCandidatesPerDesign),
        bounds.first_candidate, bounds.last_candidate);
    for (const char* table : {"attempt", "failure", "conflict"}) {
      run(fmt::format("DELETE FROM {} WHERE candidate BETWEEN ? AND ? AND (candidate, purpose,"
                      " pair) NOT IN (SELECT candidate, purpose, pair FROM evaluation)",
                      table),
          bounds.first_candidate, bounds.last_candidate);
    }
  }
  run("DELETE FROM candidate WHERE id BETWEEN ? AND ? AND id NOT IN " + same +
          (only_derived ? "" : " AND id IN " + reached),
      bounds.first_candidate, bounds.last_candidate);
  run("DELETE FROM pair WHERE design BETWEEN ? AND ? AND " + of_replay +
          " AND (design, purpose, number, instance, seed) NOT IN (SELECT design, purpose, number,"
          " instance, seed FROM derived_pair)" +
          (only_derived ? ""
                        : " AND (design, purpose, number) IN (SELECT design, purpose, number FROM"
                          " derived_pair)"),
      bounds.first_design, bounds.last_design);
  connection_.execute("DROP TABLE derived_candidate; DROP TABLE derived_pair");
  return is_trusted_again_ ? taken : 0;
}

std::int64_t SqliteRecovery::replace_derived(const StoredCampaign& campaign,
                                             const DerivedRows& derived,
                                             const std::string& source) {
  const Bounds bounds(campaign);
  sqlite::Transaction transaction(connection_);
  const auto run = [&](const char* statement, std::int64_t first, std::int64_t last) {
    Statement(connection_, statement).run(first, last);
  };
  for (const char* table : {"iteration", "race_step", "elite"}) {
    run(fmt::format("DELETE FROM {} WHERE design BETWEEN ? AND ?", table).c_str(),
        bounds.first_design, bounds.last_design);
  }
  for (const char* table : {"candidate_totals", "elimination"}) {
    run(fmt::format("DELETE FROM {} WHERE candidate BETWEEN ? AND ?", table).c_str(),
        bounds.first_candidate, bounds.last_candidate);
  }
  run(("DELETE FROM pair WHERE purpose IN " + numbers_in_sql(always_counts) +
       " AND design BETWEEN ? AND ?")
          .c_str(),
      bounds.first_design, bounds.last_design);
  run("UPDATE design SET state = 0, used = 0, iteration = 0, best = NULL, best_mean = 0,"
      " reason = '' WHERE id BETWEEN ? AND ?",
      bounds.first_design, bounds.last_design);
  const Shift shift{.designs = campaign.designs_before};
  const std::int64_t taken = remove_others(campaign, derived, shift);
  run("UPDATE evaluation SET iteration = NULL WHERE candidate BETWEEN ? AND ?",
      bounds.first_candidate, bounds.last_candidate);
  RowWriter writer(connection_);
  for (const Row& row : derived.rows)
    writer.write(shifted(row, shift));
  Statement gone(connection_,
                 "DELETE FROM evaluation WHERE candidate = ? AND purpose = ? AND pair = ?");
  for (const EvaluationKey& key : derived.unasked) {
    const EvaluationKey stored = shifted(key, shift);
    gone.run(stored.candidate.value, static_cast<std::int64_t>(stored.purpose), stored.pair);
  }
  // A distrusted campaign stays distrusted in the copy.
  Statement(connection_,
            fmt::format("UPDATE campaign SET state = 'running' WHERE id = ?1"
                        " AND (?2 OR state <> 'distrusted' AND EXISTS (SELECT 1 FROM design"
                        " WHERE campaign = ?1 AND state <> {}))",
                        static_cast<int>(DesignState::Finished)))
      .run(campaign.id, is_trusted_again_);
  // A number of a source without a name is that of the campaign's own source; there is only one.
  if (!source.empty()) {
    const std::string nameless = " WHERE source NOT IN (SELECT id FROM source) AND purpose IN " +
                                 numbers_in_sql(has_own_source) +
                                 " AND candidate BETWEEN ?1 AND ?2";
    Statement(connection_,
              "INSERT OR IGNORE INTO source (id, name) SELECT DISTINCT source, ?3 FROM evaluation" +
                  nameless)
        .run(bounds.first_candidate, bounds.last_candidate, source);
    Statement(connection_,
              "UPDATE evaluation SET source = (SELECT id FROM source WHERE name = ?3)" + nameless)
        .run(bounds.first_candidate, bounds.last_candidate, source);
  }
  transaction.commit();
  derived_campaigns_.insert(campaign.id);
  return taken;
}

/// No race makes the rows of imports again: they are kept, without their references to lost
/// candidates. Returns the number of candidates that lost their parent.
std::int64_t SqliteRecovery::keep_imports() {
  if (schema_of(connection_) < 4) return 0;  // there were no imports
  const std::string lost = "NOT IN (SELECT id FROM candidate)";
  const std::string imported =
      "IN (SELECT d.id FROM design AS d JOIN campaign AS c ON c.id = d.campaign"
      " WHERE c.state = 'imported')";
  connection_.execute("UPDATE race_step SET best = NULL WHERE best " + lost + " AND design " +
                      imported);
  connection_.execute("UPDATE candidate SET parent = NULL WHERE parent " + lost +
                      " AND (id - 1) / 1000000 + 1 " + imported);
  return connection_.changes();
}

/// Names the tables that another program changed and that no race derives again.
std::string SqliteRecovery::doubt() {
  const bool all_derived = std::ranges::all_of(campaigns(), [&](const StoredCampaign& campaign) {
    return derived_campaigns_.contains(campaign.id);
  });
  std::string tables;
  for (const Changed& table : changed_) {
    if (table.is_derived_by_races && all_derived) continue;
    if (table.table == RowSums::Table::Evaluation && found_.changed_evaluations > 0) continue;
    tables += (tables.empty() ? "" : ", ") + std::string(table.name);
  }
  if (!tables.empty()) {
    const EventRow event = event_row(
        "error", "rows changed by another program",
        {{"tables", tables}, {"reason", "their values are not those that were committed"}});
    Statement(connection_, "INSERT INTO event (severity, kind, text) VALUES (?, ?, ?)")
        .run(event.severity, event.kind, event.text);
    connection_.execute("UPDATE campaign SET state = 'distrusted'");
    return "its rows are not those that were committed, and it is unknown which ones changed: " +
           tables;
  }
  const bool was_doubted = std::ranges::any_of(
      campaigns(), [](const StoredCampaign& campaign) { return campaign.state == "distrusted"; });
  return was_doubted ? "the damaged store already said so (its events say why)" : "";
}

Expected<Recovery::End> SqliteRecovery::finish() {
  End end;
  try {
    if (campaigns().empty() &&
        sqlite::integer_of(connection_, "SELECT count(*) FROM design") == 0) {
      // A store with only real runs: the row of its campaign can be made again.
      const std::string key = sqlite::text_of(
          connection_, "SELECT coalesce((SELECT key FROM real_run ORDER BY id), '')");
      if (!key.empty()) write_campaign_of_real_runs(connection_, key);
    }
    if (campaigns().empty()) {
      return unexpected(ErrorKind::Corrupt,
                        "the campaign's own row is lost; name the campaign's file, so that the new "
                        "store knows the owner of these rows: `--campaign campaign.toml`");
    }
    end.without_parent = keep_imports();
    std::int64_t before = -1;
    while (before != orphans_) {
      before = orphans_;
      for (const char* statement : kOrphans)
        remove(statement);
    }
    connection_.execute(
        "UPDATE design SET best = NULL WHERE best NOT IN (SELECT id FROM candidate)");
    orphans_ += mend_real_runs(connection_);
    write_maker(connection_);
    end.doubt = doubt();
    RowSums::found(connection_).write(connection_);
    if (const auto faults = faults_of(connection_); !faults.empty()) {
      return unexpected(ErrorKind::Corrupt,
                        "the recovered rows are not a whole store: " + faults.front());
    }
    {
      const ReadTransaction snapshot(connection_);
      end.digest = digest_of_store(connection_);
      end.evaluations = sqlite::integer_of(connection_, "SELECT count(*) FROM evaluation");
      end.orphans = orphans_;
    }
    connection_ = Connection(":memory:", SQLITE_OPEN_READWRITE);
  } catch (const SqliteError& error) {
    return copying_failed(error, file_.path(), file_.path());
  }
  if (auto published = file_.publish(); !published) return Unexpected(published.error());
  return end;
}

}  // namespace

Expected<std::unique_ptr<Recovery>> Recovery::begin(const fs::path& damaged, const fs::path& into) {
  std::error_code trouble;
  if (!fs::is_regular_file(damaged, trouble)) {
    return unexpected(ErrorKind::NotFound, "there is no such file", damaged.string());
  }
  auto file = NewFile::beside(into);
  if (!file) return Unexpected(file.error());
  auto image = PageImage::read(damaged);
  if (!image) return Unexpected(image.error());
  if (image->user_version() > kSchemaVersion && image->user_version() < 1000) {
    return unexpected(ErrorKind::Newer,
                      fmt::format("the store has schema {}, and this program knows {} at most; use "
                                  "the version of swarmsmith that wrote it, or a later one",
                                  image->user_version(), kSchemaVersion),
                      damaged.string());
  }
  try {
    Connection connection(file->path().string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    configure_writer(connection);
    connection.execute("PRAGMA foreign_keys = OFF");
    const PageFind found = salvage_pages(*image, connection);
    const bool nothing = std::ranges::all_of(found.tables, [](const TableFind& table) {
      return table.rows == 0 || table.name == "meta";
    });
    if (nothing) {
      return unexpected(ErrorKind::Corrupt, "this file has nothing of a store", damaged.string());
    }
    return std::make_unique<SqliteRecovery>(std::move(*file), std::move(connection), found,
                                            !image->has_header());
  } catch (const SqliteError& error) {
    return copying_failed(error, into, into);
  }
}

}  // namespace swarmsmith
