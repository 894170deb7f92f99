#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/irace/store_place.h"
#include "cli/run/campaign_run.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The number of evaluations at a time.
struct IraceSlots {
  std::optional<std::int64_t> workers;   ///< processes
  std::optional<std::int64_t> parallel;  ///< evaluations of all of them together
};

/// Translates both to worker processes for `carry_out`.
RunOptions run_options(const IraceSlots& slots, const StorePlace& store);

/// The campaign's store; null if there is none that holds this campaign.
std::unique_ptr<StoreReader> store_of(const Campaign& campaign);
/// Whether there is no store yet, or it belongs to this campaign. Errors of the store are reported
/// later, when it is opened for writing.
bool may_begin(const Campaign& campaign);

/// The campaign with which the store in a file was made; empty if the file cannot be read.
std::optional<Campaign> stored_campaign(const std::filesystem::path& file);

/// Chooses the store for a campaign that belongs to the run in `file`: the first of NAME-ending.db,
/// NAME-ending-2.db, NAME-ending-3.db, ... that holds the campaign or does not exist. So each
/// campaign keeps its own store, and the same command finds it again. `campaign_at` returns the
/// campaign for a place, because the seed may come from the store there.
StorePlace place_beside(const std::filesystem::path& file, const std::string& ending,
                        const std::function<Campaign(const StorePlace&)>& campaign_at);

/// The exit code after `carry_out` has not finished: 1 for all errors, as in irace, except for a
/// store that was lost after the run `began`. If the store belongs to another scenario, prints what
/// to do; `named`: an option named this store, else it was chosen beside such a store.
ExitCode explain_end(Output& output, ExitCode ended, bool began, bool named = true);

/// Runs the scenario into its store, or continues it, and prints irace's report. Failed for all
/// errors, as in irace; Interrupted and Terminated as in `run`. If the store already holds the
/// finished run and only the tests differ, the winners are tested again in a store beside it
/// (`test_elites`).
ExitCode run_scenario(Output& output, const IraceSetup& setup, const StorePlace& store,
                      const IraceSlots& slots);
/// Like `run_scenario`, for a campaign made from a scenario.
ExitCode run_campaign(Output& output, const IraceSetup& setup, const StorePlace& store,
                      Campaign campaign, const IraceSlots& slots);

/// The seed of the setup, else of the store, so that the same command continues, else a new one.
std::uint64_t seed_of(const IraceSetup& setup, const StorePlace& store);

}  // namespace swarmsmith::cli
