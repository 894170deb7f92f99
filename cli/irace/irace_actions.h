#pragma once

#include <filesystem>

#include "cli/irace/irace_run.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"
#include "irace_core/files/settings.h"

namespace swarmsmith::cli {

/// The actions of `swarmsmith irace` other than a run; one source file per action.

/// irace's --check: calls the target for the given configurations and two random ones, on one
/// instance with one seed, in this process, and prints each call and its result. `campaign` is the
/// campaign of the setup. Failed if a call fails or if the race could not even begin.
ExitCode check_target(Output& output, const IraceSetup& setup, const Campaign& campaign);

/// irace's --only-test: evaluates the configurations of a file on the test instances and prints
/// their costs. The evaluations are stored, and can be continued, like those of a run: in `store`
/// if the user named it, else in a separate store beside it.
ExitCode only_test(Output& output, const IraceSetup& setup, const std::filesystem::path& file,
                   const StorePlace& store, bool is_named, const IraceSlots& slots);

/// Whether the store holds a finished run of this campaign that differs only in its test instances
/// or in the choice of configurations to test.
bool has_other_tests(const Campaign& campaign);
/// R's testing_fromlog(): tests the winners of the finished run in `store` on the setup's test
/// instances. This is a separate campaign, in a store beside it.
ExitCode test_elites(Output& output, const IraceSetup& setup, const StorePlace& store,
                     const IraceSlots& slots);

/// irace's --init: writes templates of all files into the current folder, but does not overwrite
/// files.
ExitCode write_templates(Output& output);

/// R's psRace(): one more race of configurations that the run in `finished` found, from the
/// beginning and on new pairs, until one remains or the budget is used. This is a separate run, in
/// a store beside `finished`.
ExitCode race_again(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                    const std::filesystem::path& finished, const IraceSlots& slots);

/// R's ablation(): changes a configuration of the run in `finished` to its best one, parameter by
/// parameter, each time with the change that gives the lowest cost on training instances.
/// Prints the steps and the best configuration on the way; on request writes all runs to a CSV
/// file, too. This is a separate campaign, in a store beside `finished`; it can be continued like a
/// run.
ExitCode ablate(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                const std::filesystem::path& finished, const IraceSlots& slots);

}  // namespace swarmsmith::cli
