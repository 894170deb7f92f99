#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "storage/internal/sqlite.h"
#include "storage/rows.h"
#include "storage/store.h"

namespace swarmsmith {

/// Functions that read tables as rows, each in the order of its key. They throw SqliteError.

/// The designs to read: all, or those of one campaign, with the ids that they have when it is alone
/// in a store. Commands to the whole store belong to none of its campaigns.
struct Part {
  std::int64_t designs_before = 0;
  std::optional<std::int64_t> designs{};  ///< none: all
};

/// The campaigns by number, at least one; more than one only after a merge or an import.
std::vector<StoredCampaign> read_campaigns(const sqlite::Connection& connection);
std::vector<DesignRow> read_designs(const sqlite::Connection& connection, const Part& part = {});
std::vector<StoredScore> read_scores(const sqlite::Connection& connection, const Part& part = {});
std::vector<StoredStep> read_steps(const sqlite::Connection& connection, const Part& part = {});
/// The designs of the first campaign, the only one that may run in the store.
Part first_campaign(const sqlite::Connection& connection);
/// Of the first campaign, which is the one that runs in the store; from schema 4 on.
std::vector<DesignStateRow> read_design_states(const sqlite::Connection& connection);
std::vector<TestedDesign> read_tested_designs(const sqlite::Connection& connection);
std::vector<CommandRow> read_commands(const sqlite::Connection& connection, const Part& part = {});
std::int64_t read_next_worker(const sqlite::Connection& connection);
/// Whether the rows of all campaigns say that they are finished.
bool is_finished(const sqlite::Connection& connection);
/// Version of tables and views.
std::int64_t schema_of(const sqlite::Connection& connection);

/// Candidates whose texts cannot be made because the table lacks a phrase.
std::vector<CandidateId> candidates_without_phrases(const sqlite::Connection& connection);

/// Every row of the answer in canonical order: states of the designs, iterations, candidates,
/// pairs, evaluations, steps, eliminations, elites, totals, commands that took effect; rows of a
/// type by their key.
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
/// False when the store has another text under the name.
bool keep_profile(sqlite::Connection& connection, const std::string& name, const std::string& text);

}  // namespace swarmsmith
