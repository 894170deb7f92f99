#include "cli/irace/irace_actions.h"

#include <fmt/format.h>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "base/process/guard.h"
#include "base/rng.h"
#include "base/text/csv.h"
#include "base/text/whole_file.h"
#include "cli/irace/candidate_table.h"
#include "cli/irace/irace_console.h"
#include "cli/irace/stored_configurations.h"
#include "console/counter.h"
#include "coordinator/campaign/method_space.h"
#include "irace_core/ablation.h"
#include "irace_core/files/command_line_text.h"
#include "programs/runner.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kLargestPairSeed = 2'147'483'647;  // irace's

struct AblationPair {
  std::int64_t instance;
  std::int64_t seed;
};

/// A configuration of the way, or beside it.
struct AblationRow {
  std::int64_t id = 0;
  std::int64_t step = 0;
  std::string changed;
  Configuration configuration;
  std::vector<double> costs;  ///< a pair each; NaN where it was not run
  bool on_path = false;
};

/// Runs of the target on pairs that are the same for all configurations.
class TargetRuns {
 public:
  TargetRuns(const IraceSetup& setup, const Campaign& campaign, const MethodSpace& space,
             std::vector<AblationPair> pairs)
      : setup_(setup), campaign_(campaign), space_(space), pairs_(std::move(pairs)) {}

  const std::vector<AblationPair>& pairs() const { return pairs_; }

  /// Makes the experiments of `rows`, as many at a time as `parallel` says, notes the costs in the
  /// rows and says how far it is. Costs of runs that ended before another one failed are noted,
  /// too.
  Expected<std::vector<Measurement>> make(std::span<const Experiment> wanted,
                                          std::span<AblationRow> rows, Counter& counter) {
    std::vector<Measurement> measured(wanted.size());
    std::atomic<std::size_t> next{0};
    std::size_t done = 0;
    const auto work = [&] {
      const TargetRunner runner(*campaign_.target, {.shell = true}, interrupt_);
      for (std::size_t i = next++; i < wanted.size() && !interrupt_.triggered(); i = next++) {
        const Experiment& experiment = wanted[i];
        AblationRow& row = rows[static_cast<std::size_t>(experiment.configuration - 1)];
        const auto result = experiment.is_evaluation
                                ? runner.evaluate(evaluation_of(experiment, wanted, rows))
                                : runner.run(run_of(experiment, row));
        const std::scoped_lock lock(mutex_);
        if (!result) {
          keep(result.error());
          break;
        }
        measured[i] = {
            result->rejected ? std::numeric_limits<double>::infinity() : result->reading.cost,
            result->reading.time};
        if (campaign_.target->evaluator.empty() || experiment.is_evaluation)
          row.costs[static_cast<std::size_t>(experiment.pair - 1)] = measured[i].cost;
        counter.tell(static_cast<std::int64_t>(++done), static_cast<std::int64_t>(wanted.size()));
      }
    };
    {
      // As many as irace makes: one, unless it is told. A targetEvaluator is called once at a time.
      const bool evaluates = !wanted.empty() && wanted.front().is_evaluation;
      const std::int64_t threads = evaluates ? 1 : setup_.parallel.value_or(1);
      std::vector<std::jthread> running;
      for (std::int64_t i = 0; i < std::max<std::int64_t>(1, threads); ++i)
        running.emplace_back(work);
    }
    if (error_) return Unexpected(*error_);
    return measured;
  }

 private:
  const AblationPair& pair_of(const Experiment& experiment) const {
    return pairs_[static_cast<std::size_t>(experiment.pair - 1)];
  }

  const std::string& text_of(const AblationPair& pair) const {
    return setup_.training[static_cast<std::size_t>(pair.instance - 1)];
  }

  RunnerCall run_of(const Experiment& experiment, const AblationRow& row) const {
    const AblationPair& pair = pair_of(experiment);
    return {.configuration = row.id,
            .instance_id = std::to_string(pair.instance),
            .seed = pair.seed,
            .instance = text_of(pair),
            .bound = experiment.bound,
            .switches = space_.text_of(row.configuration).call};
  }

  /// A targetEvaluator is told who is alive: those that it is called for.
  EvaluatorCall evaluation_of(const Experiment& experiment, std::span<const Experiment> wanted,
                              std::span<const AblationRow> rows) const {
    const auto id_of = [&rows](const Experiment& one) {
      return rows[static_cast<std::size_t>(one.configuration - 1)].id;
    };
    const AblationPair& pair = pair_of(experiment);
    EvaluatorCall call{
        id_of(experiment), std::to_string(pair.instance), pair.seed, text_of(pair), {}};
    for (const Experiment& one : wanted)
      call.alive.push_back(id_of(one));
    return call;
  }

  /// The first failure ends the others.
  void keep(const TargetFailure& failure) {
    if (!error_)
      error_ = Error{ErrorKind::BadInput, message_of(failure.reason, failure.details), {}};
    interrupt_.trigger();
  }

  const IraceSetup& setup_;
  const Campaign& campaign_;
  const MethodSpace& space_;
  std::vector<AblationPair> pairs_;
  Interrupt interrupt_;
  std::mutex mutex_;
  std::optional<Error> error_;
};

/// As irace: the instances in turn, shuffled each time unless sampleInstances is off, with a seed
/// each.
std::vector<AblationPair> draw_pairs(const IraceSetup& setup, std::int64_t count,
                                     std::uint64_t seed) {
  Rng rng = Rng(seed).split("ablation");
  std::vector<AblationPair> pairs;
  std::vector<std::int64_t> order(setup.training.size());
  while (static_cast<std::int64_t>(pairs.size()) < count) {
    const std::size_t at = pairs.size() % order.size();
    if (at == 0) {
      std::iota(order.begin(), order.end(), 1);
      if (setup.race.sample_instances) rng.shuffle(std::span(order));
    }
    pairs.push_back({order[at], rng.uniform_int(1, kLargestPairSeed)});
  }
  return pairs;
}

/// The runs that were made, and their mean cost.
std::pair<std::size_t, double> runs_and_mean(const std::vector<double>& costs) {
  std::size_t runs = 0;
  double sum = 0;
  for (const double cost : costs) {
    if (std::isnan(cost)) continue;
    ++runs;
    sum += cost;
  }
  return {runs, sum / static_cast<double>(runs)};
}

/// All runs as a table, which is whole at any time: written anew whenever some have ended.
class AblationTable {
 public:
  /// Without a file nothing is written.
  explicit AblationTable(std::string file) : file_(std::move(file)) {
    std::error_code unknown;
    const auto status = std::filesystem::status(file_, unknown);
    is_stream_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                 !std::filesystem::is_directory(status);
  }

  /// A pipe or a device gets the table once, when all of it is there.
  Expected<void> write(const std::vector<AblationRow>& rows, const std::vector<AblationPair>& pairs,
                       bool is_over) const {
    if (file_.empty() || (is_stream_ && !is_over)) return {};
    std::string text = "configuration,step,on_path,changed,pair,instance,seed,cost\n";
    for (const AblationRow& row : rows) {
      for (std::size_t p = 0; p < row.costs.size(); ++p) {
        if (std::isnan(row.costs[p])) continue;
        text += fmt::format("{},{},{},{},{},{},{},{:.17g}\n", row.id, row.step, row.on_path ? 1 : 0,
                            csv_field(row.changed), p + 1, pairs[p].instance, pairs[p].seed,
                            row.costs[p]);
      }
    }
    return write_whole_file(file_, text);
  }

 private:
  std::string file_;
  bool is_stream_ = false;
};

class Ablation {
 public:
  Ablation(Output& output, const IraceSetup& setup, AblationType type, const MethodSpace& method,
           TargetRuns& runs, AblationTable table)
      : output_(output),
        setup_(setup),
        type_(type),
        method_(method),
        runs_(runs),
        table_(std::move(table)) {}

  Expected<void> run(const Configuration& source, const Configuration& target) {
    // Also says at once whether the table can be written.
    if (auto written = write(false); !written) return written;
    std::int64_t step = 0;
    if (auto done = run_end(step, "source", source); !done) return done;
    std::vector<std::size_t> open = differences(source, target);
    Configuration current = source;
    while (open.size() > 1) {
      const auto changes = ablation_changes(setup_.space, current, target, open);
      if (changes.empty() || changes.front().configuration == target) break;
      const std::size_t first = rows_.size();
      ++step;
      for (const AblationChange& change : changes)
        add_row(step, text_of(change, current), change.configuration);
      const auto best = run_rows(first, type_);
      if (!best) return Unexpected(best.error());
      if (!*best) {
        return bad_input(fmt::format("the target rejected all changes of step {}", step),
                         "--ablation");
      }
      if (auto kept = keep_on_path(first + **best); !kept) return kept;
      current = changes[**best].configuration;
      open = differences(current, target);
    }
    return run_end(step + 1, text_of({target, open}, current), target);
  }

  Expected<void> finish() const { return write(true); }

  Expected<std::string> result() const {
    CandidateTable table(setup_.space);
    std::vector<std::int64_t> ids;
    std::vector<std::vector<double>> costs;
    for (const AblationRow& row : rows_) {
      if (!row.on_path) continue;
      const CandidateText text = method_.text_of(row.configuration);
      CandidateRow candidate;
      candidate.id = candidate_id(DesignId{1}, row.id);
      candidate.parameters = text.parameters;
      candidate.machine = text.machine;
      if (auto added = table.add(candidate); !added) return Unexpected(added.error());
      ids.push_back(row.id);
      costs.push_back(row.costs);
    }
    const std::vector<std::int64_t> best = {ids[best_by_ranks(costs, test_type_of(setup_.race))]};
    return fmt::format(
        "# {}: Final best configuration (first number is its number in the ablation):\n{}"
        "# Best configurations as commandlines (first number is the configuration ID; same order "
        "as above):\n{}",
        irace_date(), table.configurations(best), table.command_lines(best));
  }

 private:
  void add_row(std::int64_t step, std::string changed, const Configuration& configuration) {
    rows_.push_back({.id = static_cast<std::int64_t>(rows_.size()) + 1,
                     .step = step,
                     .changed = std::move(changed),
                     .configuration = configuration,
                     .costs = std::vector<double>(runs_.pairs().size(),
                                                  std::numeric_limits<double>::quiet_NaN())});
  }

  /// Source and target are run on all pairs.
  Expected<void> run_end(std::int64_t step, std::string changed, const Configuration& end) {
    add_row(step, std::move(changed), end);
    const auto best = run_rows(rows_.size() - 1, AblationType::Full);
    if (!best) return Unexpected(best.error());
    return keep_on_path(rows_.size() - 1);
  }

  /// "alpha: 1 -> 2.5, rho: 0.5 -> NA".
  std::string text_of(const AblationChange& change, const Configuration& before) const {
    const auto value = [this](const Configuration& configuration, std::size_t i) {
      return configuration.is_active(i) ? value_text(setup_.space, i, configuration[i])
                                        : std::string("NA");
    };
    std::string text;
    for (const std::size_t i : change.changed) {
      text += fmt::format("{}{}: {} -> {}", text.empty() ? "" : ", ", setup_.space[i].name,
                          value(before, i), value(change.configuration, i));
    }
    return text;
  }

  /// The best of the rows from `first` on, by its position among them.
  Expected<std::optional<std::size_t>> run_rows(std::size_t first, AblationType type) {
    const std::span<AblationRow> rows = std::span(rows_).subspan(first);
    Counter counter(output_, "made", "runs");
    const auto make =
        [&](std::span<const Experiment> wanted) -> Expected<std::vector<Measurement>> {
      auto made = runs_.make(wanted, rows, counter);
      if (auto written = write(false); made && !written) return Unexpected(written.error());
      return made;
    };
    const auto best = best_change(setup_.race, type, rows.size(),
                                  static_cast<std::int64_t>(runs_.pairs().size()), make);
    if (!best) return best;
    for (const AblationRow& row : rows) {
      const auto [runs, mean] = runs_and_mean(row.costs);
      tell(fmt::format("  {:>4}  {:>4}  {:>14.6g}  {}\n", row.id, runs, mean, row.changed));
    }
    return best;
  }

  Expected<void> keep_on_path(std::size_t row) {
    rows_[row].on_path = true;
    tell(fmt::format("# Step {}: {}\n", rows_[row].step, rows_[row].changed));
    return write(false);
  }

  Expected<void> write(bool is_over) const { return table_.write(rows_, runs_.pairs(), is_over); }

  void tell(const std::string& text) {
    if (!output_.quiet) output_.out << text << std::flush;
  }

  Output& output_;
  const IraceSetup& setup_;
  AblationType type_;
  const MethodSpace& method_;
  TargetRuns& runs_;
  AblationTable table_;
  std::vector<AblationRow> rows_;  ///< in the order of their ids
};

/// The place of the table of all runs; empty where none is asked for.
std::string table_file(const IraceSettings& settings) {
  const IraceSetting* setting = settings.find("--ablation-csv");
  if (setting == nullptr) return {};
  return absolute_path(std::get<std::string>(setting->value), setting->folder).string();
}

/// How many runs each configuration has at most: `firstTest` pairs, so many times; in a race the
/// training instances once (R's ablation()).
Expected<std::int64_t> pairs_wanted(const IraceSettings& settings, const IraceSetup& setup,
                                    AblationType type) {
  const auto times = settings.number("--ablation-instances");
  if (times.value_or(1) < 1) return bad_input("must be 1 or more", "--ablation-instances");
  const auto instances = static_cast<std::int64_t>(setup.training.size());
  if (type == AblationType::Racing) {
    if (!times) return instances;
    return bad_input("is for the type full: a race takes each training instance once",
                     "--ablation-instances");
  }
  const std::int64_t count = times.value_or(1) * setup.race.first_test * setup.race.block_size;
  return setup.race.deterministic ? std::min(count, instances) : count;
}

}  // namespace

ExitCode ablate(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                const Campaign& campaign, const std::filesystem::path& finished) {
  const auto failed = [&output](const Error& error) {
    return fail(output, ExitCode::Failed, error);
  };
  if (output.json) {
    return failed({ErrorKind::BadInput,
                   "is not there with --ablation: --ablation-csv FILE has "
                   "every run",
                   "--json"});
  }
  const AblationType type =
      settings.text("--ablation-type") == "racing" ? AblationType::Racing : AblationType::Full;
  const auto pairs = pairs_wanted(settings, setup, type);
  if (!pairs) return failed(pairs.error());
  const auto stored = read_stored_configurations(finished, setup.space);
  if (!stored) return failed(stored.error());
  const std::int64_t from = settings.number("--ablation-source").value_or(1);
  const std::int64_t to =
      settings.number("--ablation-target").value_or(stored->elites.rbegin()->second.front());
  const auto source = stored->find(from, "--ablation-source");
  if (!source) return failed(source.error());
  const auto target = stored->find(to, "--ablation-target");
  if (!target) return failed(target.error());
  if (*source == *target) {
    return failed({ErrorKind::BadInput,
                   fmt::format("configurations {} and {} are the same: name others by "
                               "--ablation-source and --ablation-target",
                               from, to),
                   "--ablation"});
  }
  const auto method = MethodSpace::make(campaign.methods.front(), static_cast<int>(campaign.digits),
                                        campaign.target->aclib);
  if (!method) return failed(method.error());
  if (auto guarded = start_guard(); !guarded) return failed(guarded.error());
  TargetRuns runs(setup, campaign, *method, draw_pairs(setup, *pairs, campaign.seed));
  if (!output.quiet) {
    output.out << fmt::format(
        "# {}: Starting ablation from {} to {}\n# Seed: {}\n# Source: {}\n# Target: {}\n"
        "# {} pairs of instance and seed; columns: number, runs, mean cost, change\n",
        irace_date(), from, to, campaign.seed, method->text_of(*source).machine,
        method->text_of(*target).machine, *pairs);
  }
  Ablation ablation(output, setup, type, *method, runs, AblationTable(table_file(settings)));
  if (auto done = ablation.run(*source, *target); !done) return failed(done.error());
  const auto result = ablation.result();
  if (!result) return failed(result.error());
  if (!output.quiet) output.out << *result;
  if (auto written = ablation.finish(); !written) return failed(written.error());
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
