#include "cli/irace/irace_run.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <utility>
#include <variant>

#include "base/usable_processors.h"
#include "cli/irace/irace_actions.h"
#include "cli/irace/irace_console.h"
#include "cli/irace/irace_report.h"
#include "cli/output/progress.h"
#include "cli/output/run_listener.h"
#include "cli/run/campaign_run.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/irace_campaign.h"
#include "coordinator/campaign/method_space.h"
#include "irace_core/files/options.h"
#include "irace_core/iterated_race.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kLargestSeed = 2'147'483'647;  // limit of irace

std::string times_line(TimePoint begin) {
  rusage own{};
  rusage children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  const auto seconds = [](const timeval& a, const timeval& b) {
    return static_cast<double>(a.tv_sec + b.tv_sec) +
           1e-6 * static_cast<double>(a.tv_usec + b.tv_usec);
  };
  const std::chrono::duration<double> wall = SystemClock().now() - begin;
  return fmt::format(
      "# Total CPU user time: {:.3f}, CPU sys time: {:.3f}, Wall-clock time: {:.3f}\n",
      seconds(own.ru_utime, children.ru_utime), seconds(own.ru_stime, children.ru_stime),
      wall.count());
}

/// The events of `run --json`, with costs instead of scores.
class CostEvents final : public RunListener {
 public:
  explicit CostEvents(Progress& progress) : progress_(progress) {}

  void restore(std::size_t campaign, const StoredProgress& stored) override {
    progress_.restore(campaign, stored);
  }
  void update(const LiveStatus& live, TimePoint now) override { progress_.update(live, now); }
  void finish(const LiveStatus& live) override { progress_.finish(live); }

  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override {
    Row told = row;
    if (auto* step = std::get_if<RaceStepRow>(&told)) {
      step->mean_best = to_cost(step->mean_best);
    } else if (auto* elite = std::get_if<EliteRow>(&told)) {
      elite->mean = to_cost(elite->mean);
    } else if (auto* state = std::get_if<DesignStateRow>(&told)) {
      state->best_mean = to_cost(state->best_mean);
    } else if (auto* conflict = std::get_if<ConflictRow>(&told)) {
      conflict->kept_score = to_cost(conflict->kept_score);
      conflict->other_score = to_cost(conflict->other_score);
    }
    progress_.add(campaign, told, now);
  }

 private:
  Progress& progress_;
};

/// Passes everything on, and notes whether anything was evaluated, because a finished run may have
/// been extended.
class WorkWatch final : public RunListener {
 public:
  explicit WorkWatch(RunListener& teller) : teller_(teller) {}

  void restore(std::size_t campaign, const StoredProgress& stored) override {
    teller_.restore(campaign, stored);
  }
  void update(const LiveStatus& live, TimePoint now) override { teller_.update(live, now); }
  void finish(const LiveStatus& live) override { teller_.finish(live); }
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override {
    saw_work_ = saw_work_ || std::holds_alternative<EvaluationRow>(row) ||
                std::holds_alternative<RaceStepRow>(row);
    teller_.add(campaign, row, now);
  }
  bool saw_work() const { return saw_work_; }

 private:
  RunListener& teller_;
  bool saw_work_ = false;
};

std::string no_result(const std::string& reason) {
  return "there is no best configuration: " + with_irace_option_names(reason) +
         ". Fix the target or the scenario, and start again with another store (--log-file NAME) "
         "or without this one";
}

/// A run of one scenario, from its first line to its report.
class ScenarioRun {
 public:
  ScenarioRun(Output& output, const IraceSetup& setup, const StorePlace& store, Campaign campaign)
      : output_(output), setup_(setup), place_(store), campaign_(std::move(campaign)) {
    campaign_.store = store.file();
    if (campaign_.race.max_time > 0) keep_parallel();
  }

  ExitCode run(const RunOptions& options) {
    race_ = race_on(campaign_, campaign_.missions.front());
    auto console = make_console();
    if (!console) return fail(output_, ExitCode::Failed, with_irace_option_names(console.error()));
    Progress progress(output_, design_rows(campaign_), begin_);
    CostEvents events(progress);
    WorkWatch teller(output_.json ? static_cast<RunListener&>(events) : *console);
    const bool begins = may_begin(campaign_);
    if (!campaign_.only_test && !is_finished() && begins && !output_.json) {
      console->write_begin();
      if (auto told = tell_what_was(*console); !told)
        return fail(output_, ExitCode::Failed, told.error());
    }
    const std::string ended_before = date_of_end();
    const ExitCode ended = carry_out(output_, {campaign_}, options, teller).front();
    const std::int64_t more = ended == ExitCode::Store && !begins ? experiments_more() : 0;
    if (more > 0) {
      output_.err << fmt::format(
          "It was made with maxExperiments = {}. To continue with more: `swarmsmith extend {} d1 "
          "--budget {}`, then this command with the old number.\n",
          campaign_.race.max_experiments - more, place_.file().string(), more);
    }
    if (ended == ExitCode::Done && !ended_before.empty() && !teller.saw_work())
      tell_that_nothing_ran(ended_before);
    return ended == ExitCode::Done ? report() : explain_end(output_, ended, begins);
  }

 private:
  /// With a time budget, the first estimate depends on the number of parallel runs. A run that
  /// continues keeps its original number, even if this computer has another number of cores.
  void keep_parallel() {
    const std::optional<Campaign> stored = stored_campaign(place_.file());
    if (!stored || stored->race.max_time <= 0) return;
    if (stored->race.parallel != campaign_.race.parallel) {
      print_note(output_,
                 fmt::format("the store was started with --parallel {}, which its budget of "
                             "time keeps; runs are made {} at a time now",
                             stored->race.parallel, setup_.parallel.value_or(1)));
    }
    campaign_.race.parallel = stored->race.parallel;
  }

  /// How many experiments the new budget has more than the stored one, if nothing else differs. The
  /// command `extend` adds them.
  std::int64_t experiments_more() const {
    std::optional<Campaign> stored = stored_campaign(place_.file());
    if (!stored) return 0;
    const std::int64_t more = campaign_.race.max_experiments - stored->race.max_experiments;
    stored->race.max_experiments = campaign_.race.max_experiments;
    return campaign_digest(*stored) == campaign_digest(campaign_) ? more : 0;
  }

  Expected<IraceConsole> make_console() {
    if (campaign_.only_test) return IraceConsole(output_, irace_run(), begin_);
    const auto race = IteratedRace::start(setup_.space, race_, setup_.initial);
    if (!race) return Unexpected(race.error());
    IraceRun run = irace_run();
    run.seed = campaign_.seed;
    run.n_iterations = race->n_iterations();
    run.budget = race_.max_time > 0 ? 0 : race->budget();
    return IraceConsole(output_, std::move(run), begin_);
  }

  IraceRun irace_run() const {
    return {.race = race_,
            .space = setup_.space,
            .debug_level = setup_.debug_level,
            .target = *campaign_.target,
            .instances = campaign_.missions.front().instances};
  }

  /// The date when the store's run ended; empty if the store does not hold this run or it is not
  /// finished.
  std::string date_of_end() const {
    const auto store = store_of(campaign_);
    return store != nullptr && store->finished() ? end_date(*store) : "";
  }

  /// Tells users who have changed the target since then that it was not run.
  void tell_that_nothing_ran(const std::string& ended) {
    ended_ = ended;
    const std::string text = nothing_ran_text(ended_, place_.file());
    if (output_.json) print_note(output_, text);
    if (!output_.json && !output_.quiet) output_.out << "# " << text << '\n';
  }

  /// Whether the store holds this run and it is finished.
  bool is_finished() const {
    const auto store = store_of(campaign_);
    return store != nullptr && store->finished();
  }

  Expected<void> tell_what_was(IraceConsole& console) const {
    const auto store = store_of(campaign_);
    if (store == nullptr) return {};
    return console.go_on_from(*store);
  }

  ExitCode report() {
    const auto store = StoreReader::open(place_.file());
    if (!store) return fail(output_, ExitCode::Failed, store.error());
    const auto result = read_irace_result(**store, setup_.space);
    if (!result) return fail(output_, ExitCode::Failed, result.error());
    const auto seed = static_cast<std::int64_t>(campaign_.seed);
    // The race ended without a best configuration, for example because the target rejected all of
    // them.
    const bool has_failed = result->state.state == DesignState::Stopped;
    if (output_.json) {
      output_.out << result_json(*result, place_.is_kept() ? place_.file().string() : "", seed);
    } else if (campaign_.only_test && !output_.quiet) {
      output_.out << testing_text(*result, date()) << finished_testing();
      if (place_.is_kept()) print_note(output_, "The results are in " + place_.file().string());
    } else if (!output_.quiet && !has_failed) {
      output_.out << times_line(begin_) << best_text(*result, race_) << tests_text(*result)
                  << std::flush;
      print_whereabouts();
    }
    if (has_failed) return fail(output_, ExitCode::Failed, no_result(result->state.reason));
    return ExitCode::Done;
  }

  std::string tests_text(const IraceResult& result) const {
    std::string text = fmt::format(
        "\n\n# Testing of elite configurations: {}\n"
        "# Testing iteration configurations: {}\n",
        campaign_.test_nb_elites, campaign_.test_iteration_elites ? "TRUE" : "FALSE");
    if (setup_.test.empty()) {
      return text + fmt::format("# {}: No test instances, skip testing\n", date());
    }
    return text + testing_text(result, date()) + finished_testing();
  }

  std::string finished_testing() const { return fmt::format("# {}: Finished testing\n", date()); }

  /// The date of the results.
  std::string date() const { return ended_.empty() ? irace_date() : ended_; }

  void print_whereabouts() {
    if (!place_.is_kept()) {
      print_note(output_, "nothing is kept: the log file has no name (logFile, --log-file)");
      return;
    }
    const std::string file = place_.file().string();
    print_note(output_, "\nEverything is in " + file +
                            ". How to continue:\n  swarmsmith ls elites " + file +
                            "\n  swarmsmith query " + file + "\n  swarmsmith verify " + file);
  }

  Output& output_;
  const IraceSetup& setup_;
  const StorePlace& place_;
  Campaign campaign_;
  Scenario race_;
  TimePoint begin_ = SystemClock().now();
  std::string ended_;  ///< when the run ended, if it had ended before
};

}  // namespace

std::optional<Campaign> stored_campaign(const std::filesystem::path& file) {
  std::error_code trouble;
  if (!std::filesystem::exists(file, trouble)) return std::nullopt;
  const auto store = StoreReader::open(file);
  if (!store) return std::nullopt;
  auto campaign = parse_campaign((*store)->campaign().file, file);
  if (!campaign) return std::nullopt;
  return std::move(*campaign);
}

RunOptions run_options(const IraceSlots& slots, const StorePlace& store) {
  RunOptions options;
  options.keeps_store = store.is_kept();
  // All cores by default; a given number of worker processes gets one core each.
  const std::int64_t all = slots.parallel ? std::max<std::int64_t>(*slots.parallel, 1)
                                          : slots.workers.value_or(usable_processors());
  const std::int64_t workers = std::min(slots.workers.value_or(1), all);
  options.workers = workers;
  options.slots = (all + workers - 1) / workers;
  return options;
}

std::unique_ptr<StoreReader> store_of(const Campaign& campaign) {
  std::error_code trouble;
  if (!std::filesystem::exists(campaign.store, trouble)) return nullptr;
  auto store = StoreReader::open(campaign.store);
  if (!store || (*store)->campaign().digest != campaign_digest(campaign)) return nullptr;
  return std::move(*store);
}

bool may_begin(const Campaign& campaign) {
  std::error_code trouble;
  return !std::filesystem::exists(campaign.store, trouble) || store_of(campaign) != nullptr;
}

StorePlace place_beside(const std::filesystem::path& file, const std::string& ending,
                        const std::function<Campaign(const StorePlace&)>& campaign_at) {
  for (int number = 1;; ++number) {
    auto place =
        StorePlace::beside(file, number == 1 ? ending : fmt::format("{}-{}", ending, number));
    Campaign campaign = campaign_at(place);
    campaign.store = place.file();
    // A store that cannot be read is accepted here; opening it for writing reports the error.
    if (may_begin(campaign) || !StoreReader::open(place.file())) return place;
  }
}

ExitCode explain_end(Output& output, ExitCode ended, bool began, bool named) {
  if (ended == ExitCode::Interrupted || ended == ExitCode::Terminated) return ended;
  if (ended == ExitCode::Store) {
    // The message about the store was printed already.
    if (began) return ended;
    output.err << (named
                       ? "Give the options that made this store, or another one: --log-file NAME, "
                         "or --store PATH.\n"
                       : "Give the options that made this store, or move it away: the run that it "
                         "belongs to may have changed.\n");
  }
  return ExitCode::Failed;
}

std::uint64_t seed_of(const IraceSetup& setup, const StorePlace& store) {
  if (setup.seed) return *setup.seed;
  if (const auto stored = store.seed()) return *stored;
  std::random_device device;
  return 1 + device() % static_cast<std::uint64_t>(kLargestSeed);
}

ExitCode run_campaign(Output& output, const IraceSetup& setup, const StorePlace& store,
                      Campaign campaign, const IraceSlots& slots) {
  return ScenarioRun(output, setup, store, std::move(campaign)).run(run_options(slots, store));
}

ExitCode run_scenario(Output& output, const IraceSetup& setup, const StorePlace& store,
                      const IraceSlots& slots) {
  Campaign campaign = campaign_of(setup, seed_of(setup, store));
  campaign.store = store.file();
  if (has_other_tests(campaign)) return test_elites(output, setup, store, slots);
  return run_campaign(output, setup, store, std::move(campaign), slots);
}

}  // namespace swarmsmith::cli
