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

/// How many evaluations run at a time.
struct IraceSlots {
  std::optional<std::int64_t> workers;   ///< processes
  std::optional<std::int64_t> parallel;  ///< evaluations of all of them together
};

/// Both as the worker processes of `carry_out`.
RunOptions run_options(const IraceSlots& slots, const StorePlace& store);

/// The campaign's store, when there is one that holds this campaign.
std::unique_ptr<StoreReader> store_of(const Campaign& campaign);
/// There is no store yet, or it is this campaign's. What is wrong with one is said by who opens it
/// to write.
bool may_begin(const Campaign& campaign);

/// What the store in a file was made with; nothing where none can be read.
std::optional<Campaign> stored_campaign(const std::filesystem::path& file);

/// Where what belongs to the run in `file` has its store: the first of NAME-ending.db,
/// NAME-ending-2.db, NAME-ending-3.db, ... that holds the campaign or is free. So each keeps its
/// own, and the same command finds it again. `campaign_at` gives the campaign at a place, whose
/// store may have its seed.
StorePlace place_beside(const std::filesystem::path& file, const std::string& ending,
                        const std::function<Campaign(const StorePlace&)>& campaign_at);

/// What to exit with after `carry_out` did not come to its end: 1 for all errors, as irace, but
/// that of a store that was lost after the run `began`. Says what to do about a store of another
/// scenario, which is `named` by an option, or lies beside such a one.
ExitCode explain_end(Output& output, ExitCode ended, bool began, bool named = true);

/// Runs the scenario into its store, or goes on with it, and prints irace's report. Failed for
/// whatever goes wrong, as irace; Interrupted and Terminated as `run`. When the store holds this
/// run to its end, but for its tests, the winners are tested again, beside it (`test_elites`).
ExitCode run_scenario(Output& output, const IraceSetup& setup, const StorePlace& store,
                      const IraceSlots& slots);
/// The same of a campaign that was made of a scenario.
ExitCode run_campaign(Output& output, const IraceSetup& setup, const StorePlace& store,
                      Campaign campaign, const IraceSlots& slots);

/// The setup's seed, else that of the store, so that the same command continues, else a new one.
std::uint64_t seed_of(const IraceSetup& setup, const StorePlace& store);

}  // namespace swarmsmith::cli
