#pragma once

#include <filesystem>

#include "cli/irace/irace_run.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"
#include "irace_core/files/settings.h"

namespace swarmsmith::cli {

/// What `swarmsmith irace` does besides a run, a file an action.

/// irace's --check: calls the target for the given configurations and two random ones, on one
/// instance with one seed, in this process, and prints each call and what came of it. `campaign` is
/// the setup's. Failed, when a call fails or the race could not even begin.
ExitCode check_target(Output& output, const IraceSetup& setup, const Campaign& campaign);

/// irace's --only-test: evaluates the configurations of a file on the test instances and prints
/// their costs. The evaluations are kept like those of a run, and continue like those: in `store`
/// if that was named, else in one of their own beside it.
ExitCode only_test(Output& output, const IraceSetup& setup, const std::filesystem::path& file,
                   const StorePlace& store, bool is_named, const IraceSlots& slots);

/// Whether the campaign's store holds it to its end, but for test instances and which
/// configurations run on them.
bool has_other_tests(const Campaign& campaign);
/// R's testing_fromlog(): the winners of the finished run in `store` on the setup's test instances.
/// A campaign of its own, in a store beside it.
ExitCode test_elites(Output& output, const IraceSetup& setup, const StorePlace& store,
                     const IraceSlots& slots);

/// irace's --init: writes templates of all files into the current folder, but none over a file that
/// is there.
ExitCode write_templates(Output& output);

/// R's psRace(): one more race of configurations that the run in `finished` found, from the
/// beginning and on new pairs, until one is left or its budget is used. A run of its own, in a
/// store beside `finished`.
ExitCode race_again(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                    const std::filesystem::path& finished, const IraceSlots& slots);

/// R's ablation(): the way from a configuration of the run in `finished` to its best one, parameter
/// by parameter, each time the change that costs least on training instances.
/// Prints steps and the best configuration on the way; where asked to, keeps all runs in a CSV
/// file, too. A campaign of its own, in a store beside `finished`, which continues like a run.
ExitCode ablate(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                const std::filesystem::path& finished, const IraceSlots& slots);

}  // namespace swarmsmith::cli
