#include "cli/irace/irace_console.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <ctime>
#include <utility>
#include <variant>

#include "base/overloaded.h"
#include "base/plain_text.h"
#include "cli/irace/race_table.h"
#include "cli/output/progress_text.h"
#include "irace_core/files/options.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

const char* true_or_false(bool value) {
  return value ? "TRUE" : "FALSE";
}

std::int64_t min_survival(const IraceRun& run) {
  if (run.race.min_nb_survival > 0) return run.race.min_nb_survival;
  // floor(2 + log2(d)), irace facts, 3.1.
  const auto variable = static_cast<unsigned>(run.space.variable_count());
  return 1 + std::bit_width(variable);
}

std::string capping_lines(const Scenario& race) {
  constexpr std::array<const char*, 4> kTypes{"median", "mean", "worst", "best"};
  return fmt::format(
      "# capping: {}\n# type bound: {}\n# boundMax: {}\n# par bound: {}\n"
      "# bound digits: {}\n",
      kTypes.at(static_cast<std::size_t>(race.capping_type)),
      race.bound_type == BoundType::Candidate ? "candidate" : "instance", race.bound_max,
      race.bound_par, race.bound_digits);
}

}  // namespace

std::string irace_date() {
  return irace_date(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()));
}

std::string irace_date(std::time_t time) {
  std::tm parts{};
  localtime_r(&time, &parts);
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S %Z", &parts)};
}

std::string irace_order(const Scenario& scenario) {
  return test_type_of(scenario) == TestType::FTest ? "the sum of ranks" : "the mean value";
}

IraceConsole::IraceConsole(Output& output, IraceRun run, TimePoint begin,
                           std::function<std::string()> date)
    : output_(output),
      run_(std::move(run)),
      date_(std::move(date)),
      candidates_(run_.space),
      calls_(run_.target, run_.instances),
      bounds_(uses_capping(run_.race)),
      last_(begin) {}

void IraceConsole::write(const std::string& text) {
  if (!output_.quiet) output_.out << text << std::flush;
}

void IraceConsole::write_begin() {
  const Scenario& race = run_.race;
  std::string text = "# " + date_() + ": Initialization\n";
  if (race.elitist) {
    text += fmt::format("# Elitist race\n# Elitist new instances: {}\n# Elitist limit: {}\n",
                        race.elitist_new_instances * race.block_size, race.elitist_limit);
  } else {
    text += "# Non-elitist race\n";
  }
  text += fmt::format(
      "# nbIterations: {}\n# minNbSurvival: {}\n# nbParameters: {}\n# seed: {}\n"
      "# confidence level: {}\n",
      run_.n_iterations, min_survival(run_), run_.space.variable_count(), run_.seed,
      race.confidence);
  if (run_.budget > 0) text += fmt::format("# budget: {}\n", run_.budget);
  if (race.max_time > 0) text += fmt::format("# time budget: {}\n", race.max_time);
  text += fmt::format("# mu: {}\n# deterministic: {}\n",
                      std::max(race.mu, race.first_test * race.block_size),
                      true_or_false(race.deterministic));
  if (bounds_) text += capping_lines(race);
  write(text + '\n');
}

Expected<void> IraceConsole::go_on_from(StoreReader& store) {
  std::map<std::int64_t, IterationRow> iterations;
  std::map<std::int64_t, EliteRow> best;
  std::vector<RaceStepRow> steps;
  std::optional<Error> error;
  store.each_answer_row([&](const Row& row) {
    if (const auto* iteration = std::get_if<IterationRow>(&row)) {
      iterations[iteration->number] = *iteration;
    } else if (const auto* candidate = std::get_if<CandidateRow>(&row)) {
      if (auto added = candidates_.add(*candidate); !added) error = added.error();
    } else if (const auto* pair = std::get_if<PairRow>(&row)) {
      calls_.take(*pair);
    } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
      steps.push_back(*step);
    } else if (const auto* elite = std::get_if<EliteRow>(&row); elite && elite->rank == 1) {
      best[elite->iteration] = *elite;
    }
  });
  if (error) return Unexpected(*error);
  for (const CommandRow& command : store.commands())
    take(command);
  // Rows after the last step are not replayed yet; they come again.
  if (steps.empty()) return {};
  const std::int64_t current = steps.back().iteration;
  write(fmt::format("# {}: Continuing after {}\n", date_(),
                    counted(steps.back().used, "experiment")));
  for (const RaceStepRow& step : steps) {
    if (step.iteration == current) {
      if (!in_table_) begin_iteration(iterations[current]);
      add_step(step, std::nullopt);
    }
    used_ = step.used;
    const bool ends = &step == &steps.back() || (&step)[1].iteration != step.iteration;
    if (!ends || step.iteration == current) continue;
    write(fmt::format("# Iteration {} of {}: experimentsUsed: {}", step.iteration,
                      iterations[step.iteration].of, step.used));
    if (const auto found = best.find(step.iteration); found != best.end()) {
      write(fmt::format(", best configuration: {}, mean value: {:.10g}",
                        number_of(found->second.candidate), to_cost(found->second.mean)));
    }
    write("\n");
  }
  return {};
}

void IraceConsole::restore(std::size_t /*campaign*/, const StoredProgress& stored) {
  if (const auto* state = std::get_if<DesignStateRow>(&stored))
    used_ = std::max(used_, state->used);
  if (const auto* command = std::get_if<CommandRow>(&stored)) take(*command);
}

void IraceConsole::add(std::optional<std::size_t> /*campaign*/, const Row& row, TimePoint now) {
  if (const auto* elite = std::get_if<EliteRow>(&row)) {
    elites_.push_back(*elite);
  } else if (const auto* candidate = std::get_if<CandidateRow>(&row)) {
    // Ignores an error: the row is our own, and the error is reported when it is read from a store.
    (void)candidates_.add(*candidate);
  } else if (const auto* iteration = std::get_if<IterationRow>(&row)) {
    end_race();
    last_ = now;
    begin_iteration(*iteration);
  } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
    add_step(*step, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_state(*state);
  } else if (const auto* event = std::get_if<EventRow>(&row)) {
    add_event(*event);
  } else if (const auto* pair = std::get_if<PairRow>(&row)) {
    calls_.take(*pair);
  } else if (const auto* run = std::get_if<EvaluationRow>(&row)) {
    add_run(*run);
  } else if (const auto* command = std::get_if<CommandRow>(&row)) {
    take(*command);
  }
}

void IraceConsole::take(const CommandRow& command) {
  if (command.kind == CommandKind::Extend) extensions_[command.number] = command.budget;
}

std::int64_t IraceConsole::left_after(std::int64_t used) const {
  std::int64_t left = run_.budget - used;
  for (const auto& [number, budget] : extensions_)
    left += budget;
  return left;
}

void IraceConsole::add_run(const EvaluationRow& row) {
  if (run_.debug_level < 2) return;
  write(calls_.text(row, candidates_.command_line(number_of(row.key.candidate)), date_()));
}

void IraceConsole::begin_iteration(const IterationRow& row) {
  used_before_ = used_;
  iteration_ = row.number;
  std::string text;
  if (row.postselection) {
    text = fmt::format("# {}: Post-selection race\n", date_());
  } else {
    text = fmt::format("# {}: Iteration {} of {}\n", date_(), row.number, row.of);
  }
  text += fmt::format("# experimentsUsed: {}\n", used_);
  const std::optional<std::int64_t> remaining =
      run_.budget > 0 ? std::optional(left_after(used_)) : remaining_;
  if (remaining) text += fmt::format("# remainingBudget: {}\n", *remaining);
  text +=
      fmt::format("# currentBudget: {}\n# nbConfigurations: {}\n", row.budget, row.configurations);
  if (row.soft_restart) {
    text += fmt::format(
        "# {}: Soft restart: configurations were too similar, new ones were sampled from wider "
        "models\n",
        date_());
  }
  write(text + marker_legend() + "\n" + race_headline(bounds_));
  in_table_ = true;
}

void IraceConsole::add_step(const RaceStepRow& row, std::optional<double> wall_s) {
  last_step_ = row;
  used_ = row.used;
  write(race_line(row, row.used - used_before_, wall_s, bounds_));
}

void IraceConsole::end_race() {
  if (!in_table_) return;
  in_table_ = false;
  std::string text = race_rule(bounds_);
  if (last_step_ && last_step_->best) {
    const std::int64_t best = number_of(last_step_->best);
    text += best_so_far(best, to_cost(last_step_->mean_best)) +
            "Description of the best-so-far configuration:\n" +
            candidates_.configurations({&best, 1}, true) + "\n";
  }
  std::vector<std::int64_t> numbers;
  for (const EliteRow& elite : elites_)
    numbers.push_back(number_of(elite.candidate));
  elites_.clear();
  if (!numbers.empty() && run_.debug_level >= 3) {
    text +=
        fmt::format(
            "# {}: Results for the race of iteration {} (from best to worst, according to {}):\n",
            date_(), iteration_, irace_order(run_.race)) +
        candidates_.configurations(numbers, true);
  }
  if (!numbers.empty()) {
    text += fmt::format(
                "# {}: Elite configurations (first number is the configuration ID; listed from "
                "best to worst according to {}):\n",
                date_(), irace_order(run_.race)) +
            candidates_.configurations(numbers);
  }
  write(text);
}

void IraceConsole::add_state(const DesignStateRow& row) {
  used_ = row.used;
  // A race also reports its state after each step.
  if (!elites_.empty() || row.state != DesignState::Racing) end_race();
  if (row.reason.empty() || row.reason == reason_) return;
  reason_ = row.reason;
  std::string text =
      fmt::format("# {}: Stopped: {}\n# Iteration: {}\n# experimentsUsed: {}\n", date_(),
                  with_irace_option_names(row.reason), row.iteration, row.used);
  if (run_.budget > 0) text += fmt::format("# remainingBudget: {}\n", left_after(row.used));
  write(text);
}

void IraceConsole::add_event(const EventRow& event) {
  // A failure is printed in full at the end of the command.
  if (event.kind == "evaluation failed" || event.kind == "campaign stopped") return;
  const auto field = [&](std::string_view key) {
    return std::ranges::find(event.fields, key, &EventField::first);
  };
  const auto text = [&](std::string_view key) {
    const auto found = field(key);
    const auto* value =
        found == event.fields.end() ? nullptr : std::get_if<std::string>(&found->second);
    return value == nullptr ? std::string() : *value;
  };
  const auto number = [&](std::string_view key) {
    const auto found = field(key);
    if (found == event.fields.end()) return 0.0;
    return std::visit(Overloaded{[](const std::string&) { return 0.0; },
                                 [](auto value) { return static_cast<double>(value); }},
                      found->second);
  };
  if (event.kind == "time estimated") {
    remaining_ = static_cast<std::int64_t>(number("remaining"));
    write(
        fmt::format("# {}: Estimated execution time is {:.15g} based on {:.0f} runs. Used time: "
                    "{:.15g}, remaining time: {:.15g}, remaining budget (experiments): {}\n",
                    date_(), number("mean"), number("runs"), number("time"),
                    run_.race.max_time - number("time"), *remaining_));
  } else if (event.kind == "race") {
    write("# Warning: " + with_irace_option_names(text("text")) + "\n");
  } else if (event.severity != "info" || output_.verbose) {
    write("# " + event_line(event) + "\n");
  }
}

void IraceConsole::update(const LiveStatus& live, TimePoint /*now*/) {
  if (live.trouble == trouble_) return;
  trouble_ = live.trouble;
  // Printed even with --quiet: the run stops until a person has helped.
  if (!trouble_.empty()) output_.err << "warning: nothing can be stored: " << trouble_ << std::endl;
}

void IraceConsole::finish(const LiveStatus& /*live*/) {
  if (in_table_) write(race_rule(bounds_));
  in_table_ = false;
}

}  // namespace swarmsmith::cli
