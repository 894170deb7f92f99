#pragma once

#include <functional>
#include <vector>

#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Reads tables back as rows, each in the order of its key. Throws SqliteError.

CampaignRow read_campaign(const sqlite::Connection& connection);
std::vector<DesignRow> read_designs(const sqlite::Connection& connection);
std::vector<StoredScore> read_scores(const sqlite::Connection& connection);
std::vector<StoredStep> read_steps(const sqlite::Connection& connection);
/// Of the first campaign, the one that runs in the store; of schema 4.
std::vector<DesignStateRow> read_design_states(const sqlite::Connection& connection);
std::vector<CommandRow> read_commands(const sqlite::Connection& connection);
std::int64_t read_next_worker(const sqlite::Connection& connection);
/// Whether the campaign's row says that it is finished.
bool is_finished(const sqlite::Connection& connection);

/// Every row of the answer in canonical order: states of the designs, iterations, candidates,
/// pairs, evaluations, steps, eliminations, elites, totals, commands that acted; each kind by
/// its key.
void read_answer(const sqlite::Connection& connection,
                 const std::function<void(const Row&)>& on_row);

}  // namespace swarmsmith
