#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "base/plain_text.h"
#include "base/text/csv.h"
#include "base/text/whole_file.h"
#include "cli/irace/ablation_way.h"
#include "cli/irace/candidate_table.h"
#include "cli/irace/irace_actions.h"
#include "cli/irace/irace_console.h"
#include "cli/irace/irace_report.h"
#include "cli/irace/stored_configurations.h"
#include "console/counter.h"
#include "coordinator/campaign/irace_campaign.h"
#include "irace_core/ablation.h"
#include "irace_core/files/command_line_text.h"
#include "irace_core/files/configurations_file.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

/// The number of pairs per configuration: `firstTest` blocks, times --ablation-instances; in a
/// race, each training instance once (R's ablation()).
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

/// The scenario's campaign with the ablation instead of its race. Its other race settings have no
/// effect here.
Expected<Campaign> campaign_for(const IraceSetup& setup, const AblationWay& way, AblationType type,
                                std::int64_t pairs, std::uint64_t seed) {
  const Configuration ends[] = {way.source, way.target};
  auto text = print_configurations_file(setup.space, ends);
  if (!text) return Unexpected(text.error());
  Campaign campaign = campaign_of(setup, seed);
  campaign.repair.clear();
  campaign.methods.front().configurations = std::move(*text);
  campaign.missions.front().instances.test.clear();
  campaign.missions.front().test_count = 0;
  campaign.test_nb_elites = 0;
  campaign.test_iteration_elites = false;
  const Scenario& run = setup.race;
  campaign.race = {.max_experiments = most_ablation_runs(way.source, way.target, pairs),
                   .sample_instances = run.sample_instances,
                   .deterministic = run.deterministic,
                   .test_type = test_type_of(run),
                   .confidence = run.confidence,
                   .first_test = run.first_test,
                   .each_test = run.each_test,
                   .block_size = run.block_size,
                   .mu = run.mu,
                   .min_measurable_time = run.min_measurable_time,
                   .bound_max = run.bound_max,
                   .ablation = type,
                   .ablation_pairs = pairs};
  return campaign;
}

/// The path of the table of all runs; empty if it is not wanted.
std::string table_file(const IraceSettings& settings) {
  const IraceSetting* setting = settings.find("--ablation-csv");
  if (setting == nullptr) return {};
  return absolute_path(std::get<std::string>(setting->value), setting->folder).string();
}

/// Prints finished steps, and writes a table of all runs, from stored rows and from new ones.
class AblationReport final : public RunListener {
 public:
  AblationReport(Output& output, const IraceSetup& setup, const Campaign& campaign,
                 Configuration target, std::string file)
      : output_(output),
        space_(setup.space),
        target_(std::move(target)),
        n_pairs_(static_cast<std::size_t>(campaign.race.ablation_pairs)),
        counted_(campaign.target->evaluator.empty() ? Purpose::Race : Purpose::Evaluator),
        console_(output, {.race = campaign.race, .space = setup.space}, SystemClock().now()),
        counter_(output, "made", "runs"),
        file_(std::move(file)) {
    std::error_code unknown;
    const auto status = std::filesystem::status(file_, unknown);
    is_stream_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                 !std::filesystem::is_directory(status);
  }

  /// Reads the results of an earlier process.
  Expected<void> go_on_from(StoreReader& store) {
    store.each_answer_row([this](const Row& row) { take(row); });
    for (const StoredScore& score : store.scores())
      note(score.key, score.status, score.measured.score);
    tell_steps();
    return fault();
  }

  void restore(std::size_t, const StoredProgress&) override {}
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override {
    take(row);
    if (std::holds_alternative<EventRow>(row)) console_.add(campaign, row, now);
    if (const auto* run = std::get_if<EvaluationRow>(&row)) {
      note(run->key, run->status, run->measured.score);
      if (run->key.purpose == counted_) counter_.tell(++made_, wanted_);
    }
    if (std::holds_alternative<DesignStateRow>(row)) tell_steps();
  }
  void update(const LiveStatus& live, TimePoint now) override { console_.update(live, now); }
  void finish(const LiveStatus&) override {}

  /// The latest state of the design.
  const DesignStateRow& state() const { return state_; }

  /// The file of the table is complete at any time. A pipe or a device gets the table once, at the
  /// end.
  Expected<void> write(bool is_over) const {
    if (file_.empty() || (is_stream_ && !is_over)) return {};
    std::string text = "configuration,step,on_path,changed,pair,instance,seed,cost\n";
    for (const auto& [number, member] : members_) {
      const std::string begin =
          fmt::format("{},{},{},{}", number, member.row.iteration - 1, is_on_path(member) ? 1 : 0,
                      csv_field(change_of(member)));
      for (std::size_t p = 0; p < n_pairs_; ++p) {
        if (std::isnan(member.costs[p])) continue;
        const PairRow& pair = pairs_.at({Purpose::Race, static_cast<std::int64_t>(p) + 1});
        text += fmt::format("{},{},{},{},{:.17g}\n", begin, p + 1, pair.instance, pair.seed,
                            member.costs[p]);
      }
    }
    return write_whole_file(file_, text);
  }

  Expected<std::string> result() const {
    CandidateTable table(space_);
    for (const auto& [number, member] : members_) {
      if (auto added = table.add(member.row); !added) return Unexpected(added.error());
    }
    const std::vector<std::int64_t> best = {elites_.rbegin()->second.front()};
    return fmt::format(
        "# {}: Final best configuration (first number is its number in the ablation):\n{}"
        "# Best configurations as commandlines (first number is the configuration ID; same order "
        "as above):\n{}",
        irace_date(), table.configurations(best), table.command_lines(best));
  }

  /// The first error in reading or writing so far.
  Expected<void> fault() const {
    if (fault_) return Unexpected(*fault_);
    return {};
  }

 private:
  struct Member {
    CandidateRow row;
    Configuration configuration;
    std::vector<double> costs;  ///< one per pair; NaN if the pair was not run
  };

  void take(const Row& row) {
    if (const auto* candidate = std::get_if<CandidateRow>(&row)) {
      auto configuration = configuration_of(space_, *candidate);
      if (!configuration) {
        fault_ = Error{ErrorKind::Corrupt, "holds a configuration that is not one of the scenario",
                       to_string(candidate->id)};
        return;
      }
      // Rows after the last stored step come again; costs of such a candidate may be known already.
      members_.try_emplace(
          number_of(candidate->id),
          Member{*candidate, std::move(*configuration),
                 std::vector<double>(n_pairs_, std::numeric_limits<double>::quiet_NaN())});
    } else if (const auto* pair = std::get_if<PairRow>(&row)) {
      pairs_[{pair->purpose, pair->number}] = *pair;
    } else if (const auto* iteration = std::get_if<IterationRow>(&row)) {
      made_ = 0;
      wanted_ = iteration->budget;
      counter_ = Counter(output_, "made", "runs");
    } else if (const auto* elite = std::get_if<EliteRow>(&row)) {
      if (elite->rank == 1) elites_[elite->iteration].clear();
      elites_[elite->iteration].push_back(number_of(elite->candidate));
    } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
      state_ = *state;
    }
  }

  void note(const EvaluationKey& key, EvaluationStatus status, double score) {
    const auto member = members_.find(number_of(key.candidate));
    if (key.purpose != counted_ || member == members_.end()) return;
    member->second.costs.at(place_of(key)) =
        status == EvaluationStatus::Ok ? to_cost(score) : std::numeric_limits<double>::infinity();
  }

  /// The evaluation of a targetEvaluator has its own pair number, but the instance and seed of the
  /// run.
  std::size_t place_of(const EvaluationKey& key) const {
    if (key.purpose == Purpose::Race) return static_cast<std::size_t>(key.pair - 1);
    const PairRow& own = pairs_.at({key.purpose, key.pair});
    for (std::int64_t number = 1;; ++number) {
      const PairRow& pair = pairs_.at({Purpose::Race, number});
      if (pair.instance == own.instance && pair.seed == own.seed)
        return static_cast<std::size_t>(number - 1);
    }
  }

  bool is_on_path(const Member& member) const {
    const auto elites = elites_.find(member.row.iteration);
    return elites != elites_.end() &&
           std::ranges::find(elites->second, number_of(member.row.id)) != elites->second.end();
  }

  /// "alpha: 1 -> 2.5, rho: 0.5 -> NA".
  std::string change_of(const Member& member) const {
    if (!member.row.parent) return "source";
    const Configuration& before = members_.at(number_of(member.row.parent)).configuration;
    const auto value = [this](const Configuration& configuration, std::size_t i) {
      return configuration.is_active(i) ? value_text(space_, i, configuration[i])
                                        : std::string("NA");
    };
    std::string text;
    for (const std::size_t i : change_between(space_, before, member.configuration, target_)) {
      text += fmt::format("{}{}: {} -> {}", text.empty() ? "" : ", ", space_[i].name,
                          value(before, i), value(member.configuration, i));
    }
    return text;
  }

  /// The number of runs, and their mean cost.
  static std::pair<std::size_t, double> runs_and_mean(const std::vector<double>& costs) {
    std::size_t runs = 0;
    double sum = 0;
    for (const double cost : costs) {
      if (std::isnan(cost)) continue;
      ++runs;
      sum += cost;
    }
    return {runs, sum / static_cast<double>(runs)};
  }

  /// Prints the finished steps that were not printed yet.
  void tell_steps() {
    for (; elites_.contains(told_ + 1); ++told_) {
      counter_.tell(wanted_, wanted_);
      std::string text, kept;
      for (const auto& [number, member] : members_) {
        if (member.row.iteration != told_ + 1) continue;
        const auto [runs, mean] = runs_and_mean(member.costs);
        text +=
            fmt::format("  {:>4}  {:>4}  {:>14.6g}  {}\n", number, runs, mean, change_of(member));
        if (is_on_path(member)) kept = fmt::format("# Step {}: {}\n", told_, change_of(member));
      }
      if (!output_.quiet) output_.out << text << kept << std::flush;
      if (auto written = write(false); !written) fault_ = written.error();
    }
  }

  Output& output_;
  const ParameterSpace& space_;
  Configuration target_;
  std::size_t n_pairs_;
  Purpose counted_;  ///< purpose of the evaluations that give the costs
  IraceConsole console_;
  Counter counter_;
  std::string file_;  ///< path of the table; empty: no table
  bool is_stream_ = false;
  std::map<std::int64_t, Member> members_;
  std::map<std::pair<Purpose, std::int64_t>, PairRow> pairs_;
  std::map<std::int64_t, std::vector<std::int64_t>> elites_;  ///< by iteration, best first
  DesignStateRow state_;
  std::int64_t told_ = 0;    ///< iterations printed so far
  std::int64_t made_ = 0;    ///< finished runs of the current iteration
  std::int64_t wanted_ = 0;  ///< runs that the current iteration needs
  std::optional<Error> fault_;
};

}  // namespace

ExitCode ablate(Output& output, const IraceSettings& settings, const IraceSetup& setup,
                const std::filesystem::path& finished, const IraceSlots& slots) {
  const auto failed = [&output](const Error& error) {
    return fail(output, ExitCode::Failed, error);
  };
  if (output.json) {
    return failed({ErrorKind::BadInput,
                   "cannot be used with --ablation: --ablation-csv FILE has every run", "--json"});
  }
  const AblationType type =
      settings.text("--ablation-type") == "racing" ? AblationType::Racing : AblationType::Full;
  const auto pairs = pairs_wanted(settings, setup, type);
  if (!pairs) return failed(pairs.error());
  const auto way = ablation_way(settings, setup, finished);
  if (!way) return failed(way.error());
  const auto seed = seed_of(setup, StorePlace::at(finished));
  auto campaign = campaign_for(setup, *way, type, *pairs, seed);
  if (!campaign) return failed(campaign.error());
  const StorePlace store = place_beside(finished, ablation_ending(settings, type),
                                        [&campaign](const StorePlace&) { return *campaign; });
  campaign->store = store.file();
  AblationReport report(output, setup, *campaign, way->target, table_file(settings));
  // Fails now if the table cannot be written.
  if (auto written = report.write(false); !written) return failed(written.error());
  const bool begins = may_begin(*campaign);
  if (begins && !output.quiet) {
    output.out << fmt::format(
        "# {}: Starting ablation from {} to {}\n# Seed: {}\n# Source: {}\n# Target: {}\n"
        "# {} of instance and seed; columns: number, runs, mean cost, change\n",
        irace_date(), way->from, way->to, campaign->seed,
        command_line_text(setup.space, way->source), command_line_text(setup.space, way->target),
        counted(*pairs, "pair"));
  }
  if (const auto known = store_of(*campaign)) {
    if (known->finished() && !output.quiet)
      output.out << "# " << nothing_ran_text(end_date(*known), store.file()) << '\n';
    if (auto told = report.go_on_from(*known); !told) return failed(told.error());
  }
  const ExitCode ended = carry_out(output, {*campaign}, run_options(slots, store), report).front();
  if (auto written = report.write(true); !written) return failed(written.error());
  if (auto well = report.fault(); !well) return failed(well.error());
  if (ended != ExitCode::Done) return explain_end(output, ended, begins, false);
  if (report.state().state == DesignState::Stopped)
    return failed({ErrorKind::BadInput, report.state().reason, "--ablation"});
  const auto result = report.result();
  if (!result) return failed(result.error());
  if (!output.quiet) output.out << *result << std::flush;
  print_note(output, "The ablation is in " + store.file().string());
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
