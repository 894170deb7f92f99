#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "storage/internal/sqlite.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith {

/// Reads tables back as rows, each in the order of its key. Throws SqliteError.

/// The designs that are read: all, or those of one campaign, whose ids are then those that they
/// have in a store of their own. Commands to the whole of a store belong to no campaign of it.
struct Part {
  std::int64_t designs_before = 0;
  std::optional<std::int64_t> designs{};  ///< none: all
};

/// The campaigns by number: one but in stores that were merged or imported into. At least one.
std::vector<StoredCampaign> read_campaigns(const sqlite::Connection& connection);
std::vector<DesignRow> read_designs(const sqlite::Connection& connection, const Part& part = {});
std::vector<StoredScore> read_scores(const sqlite::Connection& connection, const Part& part = {});
std::vector<StoredStep> read_steps(const sqlite::Connection& connection, const Part& part = {});
/// The designs of the first campaign, the only one that may run in the store.
Part first_campaign(const sqlite::Connection& connection);
/// Of the first campaign, the one that runs in the store; of schema 4.
std::vector<DesignStateRow> read_design_states(const sqlite::Connection& connection);
std::vector<TestedDesign> read_tested_designs(const sqlite::Connection& connection);
std::vector<CommandRow> read_commands(const sqlite::Connection& connection, const Part& part = {});
std::int64_t read_next_worker(const sqlite::Connection& connection);
/// Whether the rows of all campaigns say that they are finished.
bool is_finished(const sqlite::Connection& connection);
/// Version of tables and views.
std::int64_t schema_of(const sqlite::Connection& connection);

/// Candidates with texts that cannot be made, for want of a phrase of the table.
std::vector<CandidateId> candidates_without_phrases(const sqlite::Connection& connection);

/// Every row of the answer in canonical order: states of the designs, iterations, candidates,
/// pairs, evaluations, steps, eliminations, elites, totals, commands that acted; each kind by
/// its key.
void read_answer(const sqlite::Connection& connection, const Part& part,
                 const std::function<void(const Row&)>& on_row);
/// Every candidate by its id.
void read_candidates(const sqlite::Connection& connection, const Part& part,
                     const std::function<void(const Row&)>& on_row);

StoredTrust read_trust(const sqlite::Connection& connection);
/// See Store::keep_secret.
std::string keep_secret(sqlite::Connection& connection, const std::string& fresh);
void forget_secret(sqlite::Connection& connection);

/// See StoreReader::kept_profiles.
std::map<std::string, std::string> read_kept_profiles(const sqlite::Connection& connection);
/// False when the store keeps another text under the name.
bool keep_profile(sqlite::Connection& connection, const std::string& name, const std::string& text);

}  // namespace swarmsmith
