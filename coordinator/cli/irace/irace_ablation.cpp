#include "coordinator/cli/irace/irace_ablation.h"

#include <fmt/format.h>
#include <atomic>
#include <fstream>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "base/rng.h"
#include "base/suggestion.h"
#include "coordinator/campaign/method_space.h"
#include "coordinator/cli/irace/candidate_table.h"
#include "coordinator/cli/irace/irace_console.h"
#include "coordinator/cli/irace/stored_configurations.h"
#include "irace_core/ablation.h"
#include "irace_core/files/command_line_text.h"
#include "target/guard.h"
#include "target/runner.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kLargestSeed = 2'147'483'647;  // irace's

struct AblationPair {
  std::int64_t instance;
  std::int64_t seed;
};

struct AblationRow {
  std::int64_t id = 0;
  std::int64_t step = 0;
  std::string changed;
  Configuration configuration;
  std::vector<double> costs;  ///< a pair each
  bool on_path = false;
};

/// Runs of the target on pairs that are the same for all configurations.
class Evaluations {
 public:
  Evaluations(const IraceSetup& setup, const Campaign& campaign, const MethodSpace& space,
              std::vector<AblationPair> pairs)
      : setup_(setup), campaign_(campaign), space_(space), pairs_(std::move(pairs)) {}

  const std::vector<AblationPair>& pairs() const { return pairs_; }

  /// Fills in the costs, as many runs at a time as `parallel` says.
  Expected<void> run(std::vector<AblationRow>& rows) {
    for (AblationRow& row : rows)
      row.costs.assign(pairs_.size(), 0);
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      const TargetRunner runner(*campaign_.target, {.shell = true}, interrupt_);
      for (std::size_t i = next++; i < rows.size() * pairs_.size() && !interrupt_.triggered();
           i = next++) {
        AblationRow& row = rows[i / pairs_.size()];
        const AblationPair& pair = pairs_[i % pairs_.size()];
        keep(runner.run({.configuration = row.id,
                         .instance_id = std::to_string(pair.instance),
                         .seed = pair.seed,
                         .instance = text_of(pair),
                         .bound = campaign_.race.bound_max,
                         .switches = space_.text_of(row.configuration).call}),
             row.costs[i % pairs_.size()]);
      }
    };
    {
      std::vector<std::jthread> threads;
      // As many as irace makes: one, unless it is told.
      for (std::int64_t i = 0; i < std::max<std::int64_t>(1, setup_.parallel.value_or(1)); ++i)
        threads.emplace_back(work);
    }
    if (!campaign_.target->evaluator.empty() && !error_) evaluate(rows);
    if (error_) return Unexpected(*error_);
    return {};
  }

 private:
  const std::string& text_of(const AblationPair& pair) const {
    return setup_.training[static_cast<std::size_t>(pair.instance - 1)];
  }

  /// A targetEvaluator is called once at a time, with all runs done.
  void evaluate(std::vector<AblationRow>& rows) {
    const TargetRunner runner(*campaign_.target, {.shell = true}, interrupt_);
    std::vector<std::int64_t> alive;
    for (const AblationRow& row : rows)
      alive.push_back(row.id);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      for (AblationRow& row : rows) {
        if (error_) return;
        keep(runner.evaluate({row.id, std::to_string(pairs_[p].instance), pairs_[p].seed,
                              text_of(pairs_[p]), alive}),
             row.costs[p]);
      }
    }
  }

  void keep(const tl::expected<TargetResult, TargetFailure>& result, double& cost) {
    if (result) {
      cost = result->rejected ? std::numeric_limits<double>::infinity() : result->reading.cost;
      return;
    }
    const std::scoped_lock lock(mutex_);
    if (!error_) {
      error_ =
          Error{ErrorKind::BadInput, message_of(result.error().reason, result.error().details), {}};
    }
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
/// each; `firstTest` of them, so many times.
std::vector<AblationPair> draw_pairs(const IraceSetup& setup, std::int64_t times,
                                     std::uint64_t seed) {
  Rng rng = Rng(seed).split("ablation");
  const auto n = static_cast<std::int64_t>(setup.training.size());
  std::int64_t count = times * setup.race.first_test * setup.race.block_size;
  if (setup.race.deterministic) count = std::min(count, n);
  std::vector<AblationPair> pairs;
  std::vector<std::int64_t> order(setup.training.size());
  while (static_cast<std::int64_t>(pairs.size()) < count) {
    const std::size_t at = pairs.size() % order.size();
    if (at == 0) {
      std::iota(order.begin(), order.end(), 1);
      if (setup.race.sample_instances) rng.shuffle(std::span(order));
    }
    pairs.push_back({order[at], rng.uniform_int(1, kLargestSeed)});
  }
  return pairs;
}

double mean_of(const std::vector<double>& costs) {
  return std::accumulate(costs.begin(), costs.end(), 0.0) / static_cast<double>(costs.size());
}

class Ablation {
 public:
  Ablation(Output& output, const IraceSetup& setup, const MethodSpace& method,
           Evaluations& evaluations)
      : output_(output), setup_(setup), method_(method), evaluations_(evaluations) {}

  Expected<void> run(const Configuration& source, const Configuration& target) {
    std::vector<AblationRow> ends = {new_row(0, "source", source)};
    if (auto done = evaluate(ends); !done) return done;
    keep_on_path(ends.front());
    std::vector<std::size_t> open = differences(source, target);
    Configuration current = source;
    for (std::int64_t step = 1; open.size() > 1; ++step) {
      std::vector<AblationRow> rows;
      const auto changes = ablation_changes(setup_.space, current, target, open);
      if (changes.empty() || changes.front().configuration == target) break;
      for (const AblationChange& change : changes)
        rows.push_back(new_row(step, text_of(change, current), change.configuration));
      if (auto done = evaluate(rows); !done) return done;
      std::vector<std::vector<double>> costs;
      for (const AblationRow& row : rows)
        costs.push_back(row.costs);
      const std::size_t best = best_by_ranks(costs, test_type_of(setup_.race));
      current = changes[best].configuration;
      keep_on_path(rows[best]);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i != best) rows_.push_back(rows[i]);
      }
      open = differences(current, target);
    }
    const std::string rest = text_of({target, open}, current);
    std::vector<AblationRow> last = {new_row(path_.back().step + 1, rest, target)};
    if (auto done = evaluate(last); !done) return done;
    keep_on_path(last.front());
    return {};
  }

  Expected<std::string> result() const {
    CandidateTable table(setup_.space);
    std::vector<std::vector<double>> costs;
    for (const AblationRow& row : path_) {
      const CandidateText text = method_.text_of(row.configuration);
      CandidateRow candidate;
      candidate.id = candidate_id(DesignId{1}, row.id);
      candidate.parameters = text.parameters;
      candidate.machine = text.machine;
      if (auto added = table.add(candidate); !added) return Unexpected(added.error());
      costs.push_back(row.costs);
    }
    const AblationRow& best = path_[best_by_ranks(costs, test_type_of(setup_.race))];
    const std::vector<std::int64_t> numbers = {best.id};
    return fmt::format(
        "# {}: Final best configuration (first number is its number in the ablation):\n{}"
        "# Best configurations as commandlines (first number is the configuration ID; same order "
        "as above):\n{}",
        irace_date(), table.configurations(numbers), table.command_lines(numbers));
  }

  std::string csv() const {
    std::string text = "configuration,step,on_path,changed,pair,instance,seed,cost\n";
    for (const auto* rows : {&path_, &rows_}) {
      for (const AblationRow& row : *rows) {
        std::string changed = row.changed;
        for (std::size_t at = 0; (at = changed.find('"', at)) != std::string::npos; at += 2)
          changed.insert(at, 1, '"');
        for (std::size_t p = 0; p < row.costs.size(); ++p) {
          const AblationPair& pair = evaluations_.pairs()[p];
          text += fmt::format("{},{},{},\"{}\",{},{},{},{:.17g}\n", row.id, row.step,
                              row.on_path ? 1 : 0, changed, p + 1, pair.instance, pair.seed,
                              row.costs[p]);
        }
      }
    }
    return text;
  }

 private:
  AblationRow new_row(std::int64_t step, std::string changed, const Configuration& configuration) {
    return {
        .id = ++ids_, .step = step, .changed = std::move(changed), .configuration = configuration};
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

  Expected<void> evaluate(std::vector<AblationRow>& rows) {
    if (auto done = evaluations_.run(rows); !done) return done;
    for (const AblationRow& row : rows)
      tell(fmt::format("  {:>4}  {:>14.6g}  {}\n", row.id, mean_of(row.costs), row.changed));
    return {};
  }

  void keep_on_path(AblationRow row) {
    row.on_path = true;
    tell(fmt::format("# Step {}: {}\n", row.step, row.changed));
    path_.push_back(std::move(row));
  }

  void tell(const std::string& text) {
    if (!output_.quiet) output_.out << text << std::flush;
  }

  Output& output_;
  const IraceSetup& setup_;
  const MethodSpace& method_;
  Evaluations& evaluations_;
  std::int64_t ids_ = 0;
  std::vector<AblationRow> path_;
  std::vector<AblationRow> rows_;  ///< tried, and not taken
};

/// Writes the CSV where one is asked for.
Expected<void> write_csv(const IraceSettings& settings, const Ablation& ablation) {
  const IraceSetting* setting = settings.find("--ablation-csv");
  if (setting == nullptr) return {};
  const auto file = absolute_path(std::get<std::string>(setting->value), setting->folder);
  std::ofstream stream(file);
  stream << ablation.csv() << std::flush;
  if (stream) return {};
  return unexpected(ErrorKind::Unavailable, "cannot be written", file.string());
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
  const std::int64_t times = settings.number("--ablation-instances").value_or(1);
  if (times < 1) return failed({ErrorKind::BadInput, "must be 1 or more", "--ablation-instances"});
  Evaluations evaluations(setup, campaign, *method, draw_pairs(setup, times, campaign.seed));
  if (!output.quiet) {
    output.out << fmt::format(
        "# {}: Starting ablation from {} to {}\n# Seed: {}\n# Source: {}\n# Target: {}\n"
        "# Each configuration is run on {} instances; columns: number, mean cost, change\n",
        irace_date(), from, to, campaign.seed, method->text_of(*source).machine,
        method->text_of(*target).machine, evaluations.pairs().size());
  }
  Ablation ablation(output, setup, *method, evaluations);
  if (auto done = ablation.run(*source, *target); !done) return failed(done.error());
  const auto result = ablation.result();
  if (!result) return failed(result.error());
  if (!output.quiet) output.out << *result;
  if (auto written = write_csv(settings, ablation); !written) return failed(written.error());
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
