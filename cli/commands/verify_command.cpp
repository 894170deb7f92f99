#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/commands/compared_runs.h"
#include "coordinator/design/verify.h"

namespace swarmsmith::cli {
namespace {

/// Default number of scores that are evaluated again; they take well below a second.
constexpr std::int64_t kUsualSample = 64;
constexpr std::int64_t kLargest = 2'147'483'647;

struct VerifyArguments {
  StoreArgument store;
  std::optional<std::int64_t> sample;
  std::optional<std::int64_t> seed;
};

/// The evaluations that were repeated, and those with a different result.
struct Sampled {
  std::int64_t seed = 0;
  std::size_t evaluations = 0;
  std::vector<Difference> different;
};

void write_json(Output& output, const Verification& found, const std::optional<Sampled>& sampled) {
  std::optional<JsonObject> again;
  if (sampled) {
    again = JsonObject()
                .add("seed", sampled->seed)
                .add("evaluations", sampled->evaluations)
                .add("different", json_list(sampled->different, std::mem_fn(&Difference::id)));
  }
  output.out << JsonObject()
                    .add("clean", found.complaints.empty())
                    .add("designs", found.designs)
                    .add("finished", found.finished)
                    .add("evaluations", found.evaluations)
                    .add("real_runs", found.real_runs)
                    .add("evaluated_again", again)
                    .add("complaints", found.complaints)
                    .text()
             << "\n";
}

void write_text(Output& output, const Verification& found, const std::optional<Sampled>& sampled) {
  for (const std::string& complaint : found.complaints)
    output.out << as_shown(complaint, Layout::Escaped) << "\n";
  std::string again = "; nothing was evaluated again";
  if (sampled) {
    again = fmt::format("; {} made again (--seed {}), {} with other bits",
                        counted(sampled->evaluations, "evaluation was", "evaluations were"),
                        sampled->seed, sampled->different.size());
  }
  if (!found.complaints.empty()) {
    if (sampled) print_note(output, again.substr(2));
    return;
  }
  output.out << "clean: " << counted(found.evaluations, "evaluation") << " of "
             << counted(found.designs, "design") << ", " << found.finished
             << " finished; every race was replayed" << again;
  if (found.real_runs > 0)
    output.out << "; " << counted(found.real_runs, "real run") << " scored again";
  output.out << "\n";
}

/// Without --seed, each call chooses other evaluations, so that a worker cannot know them in
/// advance.
std::int64_t drawn_seed() {
  return static_cast<std::int64_t>(std::random_device{}() % kLargest);
}

/// Empty if no campaign of the store simulates.
Expected<std::optional<Sampled>> evaluate_again(std::unique_ptr<StoreReader> store,
                                                const VerifyArguments& arguments, Output& output) {
  auto runs = StoredRuns::open(std::move(store));
  if (!runs) return Unexpected(runs.error());
  Sampled sampled{.seed = arguments.seed.value_or(drawn_seed()), .different = {}};
  const auto ids = runs->chosen({.rejections = true,
                                 .tests = arguments.sample.has_value(),
                                 .scores = arguments.sample.value_or(kUsualSample),
                                 .seed = sampled.seed});
  if (!ids) return Unexpected(ids.error());
  if (ids->empty() && !runs->has_machines()) {
    if (arguments.sample) return Unexpected(programs_scored("--sample"));
    return std::optional<Sampled>();
  }
  Counter counter(output, "evaluated", "evaluations again");
  auto different = compare_again(*runs, *ids, counter);
  if (!different) return Unexpected(different.error());
  sampled.evaluations = ids->size();
  sampled.different = std::move(*different);
  return sampled;
}

ExitCode run_verify(const VerifyArguments& arguments, Output& output) {
  auto store = arguments.store.open();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  auto found = verify(**store);
  if (!found) return fail(output, ExitCode::Store, found.error());
  std::optional<Sampled> sampled;
  if (arguments.sample.value_or(kUsualSample) > 0 && found->designs > 0) {
    auto again = evaluate_again(std::move(*store), arguments, output);
    if (!again && again.error().kind == ErrorKind::BadInput)
      return fail(output, ExitCode::Usage, again.error());
    if (again) {
      sampled = std::move(*again);
    } else {
      found->complaints.push_back("nothing can be evaluated again: " + to_string(again.error()));
    }
  }
  for (const Difference& difference : sampled ? sampled->different : std::vector<Difference>{})
    found->complaints.push_back("evaluation " + difference.sentence);
  output.json ? write_json(output, *found, sampled) : write_text(output, *found, sampled);
  return found->complaints.empty() ? ExitCode::Done : ExitCode::Store;
}

}  // namespace

CommandRun declare_verify(Options& options) {
  auto arguments = std::make_shared<VerifyArguments>();
  arguments->store.declare(options);
  options.integer(
      "--sample", arguments->sample, {0, kLargest},
      "Evaluate N scores and all tests of winners again (rejections always; 0: nothing)");
  options.integer("--seed", arguments->seed, {0, kLargest},
                  "Seed that selects the scores to evaluate again (default: a new one each time)");
  return [arguments](Output& output) { return run_verify(*arguments, output); };
}

}  // namespace swarmsmith::cli
