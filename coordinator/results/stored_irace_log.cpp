#include "coordinator/results/stored_irace_log.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "base/overloaded.h"
#include "base/text/csv.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/irace_folder.h"
#include "coordinator/campaign/method_space.h"
#include "irace_core/files/expression_text.h"
#include "irace_core/files/number_text.h"
#include "irace_core/files/scenario_text.h"
#include "programs/cost.h"

namespace swarmsmith {
namespace {

using Cell = StoreReader::Cell;
using LogCells = std::vector<Cell>;

/// The log's layout, for functions of irace that check its version; they ignore the last part.
constexpr const char* kLayout = "4.2.0.swarmsmith";

/// NULL becomes 0.
std::int64_t number_of_candidate(const Cell& cell) {
  const std::int64_t id = cell.integer();
  return id == 0 ? 0 : number_of(CandidateId{id});
}

std::string text_of(const Bound& bound) {
  return std::visit(Overloaded{[](double value) { return fmt::format("{:.15g}", value); },
                               [](const Expression& expression) { return print(expression); }},
                    bound);
}

LogParameter log_parameter(const Parameter& parameter) {
  LogParameter log{.name = parameter.name, .switch_text = parameter.switch_text};
  if (parameter.condition) log.condition = print(*parameter.condition);
  const auto choices = [&](char type, const std::vector<std::string>& values) {
    log.type = type;
    log.domain = values;
  };
  const auto range = [&](char type, const auto& domain) {
    log.type = type;
    log.log = domain.log;
    log.domain = {text_of(domain.lower), text_of(domain.upper)};
  };
  std::visit(Overloaded{[&](const Categorical& one) { choices('c', one.values); },
                        [&](const Ordinal& one) { choices('o', one.values); },
                        [&](const Integer& one) { range('i', one); },
                        [&](const Real& one) { range('r', one); }},
             parameter.domain);
  return log;
}

void add_instances(bool test, const std::vector<std::string>& names, IraceLog& log) {
  for (const std::string& name : names) {
    const bool first = log.instances.empty() || log.instances.back().test != test;
    log.instances.push_back({test, first ? 1 : log.instances.back().number + 1, name});
  }
}

/// Adds the design's settings from the campaign's file.
Expected<void> add_settings(const Campaign& campaign, const DesignRow& design, IraceLog& log) {
  const auto method = std::ranges::find(campaign.methods, design.method, &Method::name);
  if (method == campaign.methods.end()) {
    return unexpected(ErrorKind::Corrupt, "its campaign's file has no method " + design.method,
                      to_string(design.id));
  }
  if (!method->baseline.empty()) {
    return bad_input("no race made it: its machine was given, to compare with",
                     to_string(design.id));
  }
  const bool aclib = campaign.target && campaign.target->aclib;
  const auto space = MethodSpace::make(*method, static_cast<int>(campaign.digits), aclib);
  if (!space) return Unexpected(space.error());
  auto setup = irace_setup(campaign, design);
  if (!setup) return Unexpected(setup.error());
  // A log contains the options that were used, even if they were not given.
  setup->race.test_type = test_type_of(setup->race);
  setup->race.capping = uses_capping(setup->race);
  for (const Parameter& parameter : space->parameters().parameters())
    log.parameters.push_back(log_parameter(parameter));
  add_instances(false, setup->training, log);
  add_instances(true, setup->test, log);
  for (auto& [option, value] : irace_options(*setup)) {
    // Left out: options that are in the log itself, a program for R's function, and empty options.
    const bool apart = option == "seed" || option == "maxExperiments" ||
                       option == "repairConfiguration" || value == "\"\"";
    if (!apart) log.options.emplace_back(option, std::move(value));
  }
  log.options.emplace_back("trainInstancesDir", "\"\"");
  log.options.emplace_back("digits", std::to_string(space->parameters().digits()));
  for (const Expression& clause : space->parameters().forbidden())
    log.options.emplace_back("forbidden", quoted_in_r(print(clause)));
  log.version = kLayout;
  return {};
}

/// Reads the rows of one design and builds its log.
class Reading {
 public:
  Reading(StoreReader& store, DesignId design, const std::function<void(std::int64_t)>& on_row)
      : store_(store),
        on_row_(on_row),
        design_(design),
        of_design_(fmt::format(" WHERE design = {} ", design.value)) {}

  Expected<IraceLog> log() {
    for (const auto step :
         {&Reading::read_design, &Reading::read_settings, &Reading::read_iterations,
          &Reading::read_configurations, &Reading::read_values, &Reading::read_pairs,
          &Reading::read_elites, &Reading::read_runs}) {
      if (auto read = (this->*step)(); !read) return Unexpected(read.error());
    }
    return std::move(log_);
  }

 private:
  struct Costs {
    std::int64_t task = 0;       ///< the targetEvaluator's task that gave the cost
    std::int64_t iteration = 0;  ///< the task's iteration
    double cost = 0;
  };

  Expected<void> each(const std::string& sql, const std::function<void(const LogCells&)>& on_row) {
    const auto end = store_.query(
        sql,
        {.rows = std::numeric_limits<std::int64_t>::max(),
         .seconds = 3600,
         .bytes = std::numeric_limits<std::int64_t>::max(),
         .memory = std::int64_t{1} << 30U},
        [](const auto&) {},
        [&](const LogCells& cells) {
          on_row_(++rows_);
          on_row(cells);
        });
    if (!end) return Unexpected(end.error());
    return {};
  }

  Expected<void> read_design();
  Expected<void> read_settings();
  Expected<void> read_imported_settings();
  Expected<void> read_iterations();
  Expected<void> read_configurations();
  Expected<void> read_values();
  Expected<void> read_pairs();
  Expected<void> read_elites();
  Expected<void> read_runs();
  void judge();
  Expected<void> cap();
  Expected<double> read_lowered_bound();
  void sort_runs();
  void sort_tests();

  StoreReader& store_;
  const std::function<void(std::int64_t)>& on_row_;
  std::int64_t rows_ = 0;
  DesignId design_;
  std::string of_design_;
  DesignRow row_;
  std::int64_t campaign_ = 1;
  IraceLog log_;
  std::optional<Scenario> capping_;                     ///< of a race with capping
  std::map<std::int64_t, std::size_t> configurations_;  ///< index in the log, by id
  /// Numbers of the race's pairs by instance and seed: evaluators know a pair by these two.
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> pairs_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> test_pairs_;
  std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> tasks_;  ///< of the evaluator
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> steps_;  ///< by iteration and pair
  /// The evaluator's last cost for each configuration and pair (negative: a test's pair).
  std::map<std::pair<std::int64_t, std::int64_t>, Costs> judged_;
};

Expected<void> Reading::read_design() {
  bool found = false;
  const auto read = each(
      "SELECT mission, method, flavour, repetition, seed, budget, state, reason, campaign "
      "FROM v_designs" +
          of_design_,
      [&](const LogCells& cells) {
        found = true;
        row_ = {.id = design_,
                .mission = cells[0].text,
                .method = cells[1].text,
                .flavour = cells[2].text,
                .repetition = cells[3].integer(),
                .seed = cells[4].integer(),
                .budget = cells[5].integer()};
        log_.completed = cells[6].text == "finished" ? cells[7].text : "Incomplete";
        if (log_.completed.empty()) log_.completed = "Finished";
        campaign_ = cells[8].integer();
      });
  if (!read) return read;
  if (!found) {
    return unexpected(ErrorKind::NotFound, "the store has no design " + to_string(design_));
  }
  log_.seed = row_.seed;
  log_.budget = row_.budget;
  return {};
}

Expected<void> Reading::read_settings() {
  const auto campaign = store_.campaign_of(design_);
  if (!campaign) return Unexpected(campaign.error());
  if (campaign->state == "imported") return read_imported_settings();
  // R cannot represent larger integers exactly; the design's own seed has 64 bits.
  constexpr std::int64_t kLargest = std::int64_t{1} << 53U;
  log_.seed = campaign->row.seed < kLargest ? campaign->row.seed : 0;
  const auto parsed = parse_campaign(campaign->row.file, "campaign.toml");
  if (!parsed) return Unexpected(parsed.error().front());
  if (uses_capping(parsed->race)) capping_ = parsed->race;
  return add_settings(*parsed, row_, log_);
}

/// Reads the settings that irace_log_addition kept.
Expected<void> Reading::read_imported_settings() {
  std::string columns = "json_extract(deciding, '$.imported'), json_extract(deciding, '$.irace')";
  for (const std::string& file : irace_setting_files())
    columns += ", json_extract(deciding, '$.\"" + file + "\"')";
  LogCells kept;
  const auto read =
      each("SELECT " + columns + " FROM v_campaigns WHERE campaign = " + std::to_string(campaign_),
           [&](const LogCells& cells) { kept = cells; });
  if (!read) return read;
  if (kept.empty() || kept[0].text != "irace log") {
    return bad_input("no race made it: it was imported", to_string(design_));
  }
  std::map<std::string, std::string> texts;
  for (std::size_t i = 0; i < irace_setting_files().size(); ++i) {
    if (kept[i + 2].type != Cell::Type::Null)
      texts.emplace(irace_setting_files()[i], kept[i + 2].text);
  }
  if (texts.empty()) {
    return bad_input(
        "it was imported by a version that kept no parameters; import its log into a new store",
        to_string(design_));
  }
  auto settings = read_irace_settings(texts);
  if (!settings) return Unexpected(settings.error().front());
  log_.version = kept[1].text;
  log_.parameters = std::move(settings->parameters);
  log_.instances = std::move(settings->instances);
  log_.options = std::move(settings->options);
  return {};
}

Expected<void> Reading::read_iterations() {
  return each("SELECT iteration, planned, soft_restart FROM v_iterations" + of_design_ +
                  "ORDER BY iteration",
              [&](const LogCells& cells) {
                log_.iterations = cells[1].integer();
                if (cells[2].integer() != 0) log_.soft_restarts.push_back(cells[0].integer());
              });
}

Expected<void> Reading::read_configurations() {
  return each(
      "SELECT number, parent FROM v_candidates" + of_design_ + "ORDER BY candidate",
      [&](const LogCells& cells) {
        const std::int64_t id = cells[0].integer();
        configurations_.emplace(id, log_.configurations.size());
        log_.configurations.push_back({.id = id,
                                       .parent = number_of_candidate(cells[1]),
                                       .values = std::vector<std::string>(log_.parameters.size())});
      });
}

Expected<void> Reading::read_values() {
  std::map<std::string, std::size_t, std::less<>> places;
  for (std::size_t i = 0; i < log_.parameters.size(); ++i)
    places.emplace(log_.parameters[i].name, i);
  std::optional<std::string> unknown;
  const auto read = each("SELECT candidate, parameter, value FROM v_parameters" + of_design_,
                         [&](const LogCells& cells) {
                           const auto place = places.find(cells[1].text);
                           if (place == places.end()) {
                             unknown = cells[1].text;
                             return;
                           }
                           const std::size_t at = configurations_.at(number_of_candidate(cells[0]));
                           const bool is_real = cells[2].type == Cell::Type::Real;
                           log_.configurations[at].values[place->second] =
                               is_real ? fmt::format("{:.15g}", cells[2].real()) : cells[2].text;
                         });
  if (!read) return read;
  if (unknown) {
    return unexpected(ErrorKind::Corrupt,
                      "has a parameter " + *unknown + " that its campaign does not know",
                      to_string(design_));
  }
  return {};
}

Expected<void> Reading::read_pairs() {
  const auto read = each(
      "SELECT purpose, number, instance, seed FROM pair" + of_design_ + "ORDER BY purpose, number",
      [&](const LogCells& cells) {
        const auto purpose = static_cast<Purpose>(cells[0].integer());
        const std::int64_t pair = cells[1].integer();
        const std::pair what{cells[2].integer(), cells[3].integer()};
        if (purpose == Purpose::Evaluator) tasks_.emplace(pair, what);
        if (purpose == Purpose::Race) pairs_.emplace(what, pair);
        if (purpose == Purpose::Test)
          test_pairs_.emplace(std::pair{-what.first, what.second}, pair);
        if (purpose != Purpose::Race && purpose != Purpose::Test) return;
        const bool test = purpose == Purpose::Test;
        log_.pairs.push_back({.test = test,
                              .number = pair,
                              .instance = test ? pair : what.first,
                              .seed = what.second});
      });
  if (!read) return read;
  return each(
      "SELECT iteration, pair, step FROM v_race_steps" + of_design_, [&](const LogCells& cells) {
        steps_.emplace(std::pair{cells[0].integer(), cells[1].integer()}, cells[2].integer());
      });
}

Expected<void> Reading::read_elites() {
  return each("SELECT iteration, rank, candidate FROM v_convergence" + of_design_ +
                  "ORDER BY iteration, rank",
              [&](const LogCells& cells) {
                log_.elites.push_back(
                    {cells[0].integer(), cells[1].integer(), number_of_candidate(cells[2])});
              });
}

Expected<void> Reading::read_runs() {
  const auto read = each(
      "SELECT candidate, purpose, pair, iteration, status, score, time, bound FROM v_evaluations " +
          of_design_ + "AND purpose IN ('race', 'test', 'evaluator') AND used <> 0",
      [&](const LogCells& cells) {
        const std::int64_t configuration = number_of_candidate(cells[0]);
        const std::int64_t pair = cells[2].integer();
        const double cost = cells[4].text == "ok" ? to_cost(cells[5].real())
                                                  : std::numeric_limits<double>::infinity();
        if (cells[1].text == "race") {
          log_.runs.push_back({.iteration = cells[3].integer(),
                               .pair = pair,
                               .configuration = configuration,
                               .cost = cost,
                               .time = cells[6].real(),
                               .bound = cells[7].real()});
        } else if (cells[1].text == "test") {
          log_.tests.push_back({pair, configuration, cost});
        } else if (const auto task = tasks_.find(pair); task != tasks_.end()) {
          const bool test = task->second.first < 0;
          const auto& pairs = test ? test_pairs_ : pairs_;
          const auto of = pairs.find(task->second);
          if (of == pairs.end()) return;
          Costs& last = judged_[{configuration, test ? -of->second : of->second}];
          if (pair >= last.task) {
            last = {.task = pair, .iteration = cells[3].integer(), .cost = cost};
          }
        }
      });
  if (!read) return read;
  // In this order: a race caps the costs that the evaluator gave.
  judge();
  if (auto capped = cap(); !capped) return capped;
  sort_runs();
  sort_tests();
  return {};
}

/// A race with capping uses its own capped costs instead of the printed ones, and so does a log.
Expected<void> Reading::cap() {
  if (!capping_) return {};
  double bound_max = capping_->bound_max;
  if (capping_->max_time > 0) {
    const auto lowered = read_lowered_bound();
    if (!lowered) return Unexpected(lowered.error());
    bound_max = std::min(bound_max, *lowered);
  }
  for (LogRun& run : log_.runs) {
    const auto judged = judged_.find({run.configuration, run.pair});
    const bool ran_in_task = judged == judged_.end() || judged->second.iteration == run.iteration;
    // Runs before the first race had larger bounds, up to which costs are not capped.
    const double most = std::max(bound_max, run.bound);
    if (!std::isfinite(*run.cost)) continue;
    run.cost = capped_cost(*capping_, most, *run.cost, run.time, ran_in_task ? run.bound : most);
  }
  return {};
}

/// The largest bound of the races' runs; with a time budget, the first runs lower it.
Expected<double> Reading::read_lowered_bound() {
  double lowered = std::numeric_limits<double>::infinity();
  const auto read = each(
      "SELECT json_extract(text, '$.bound_max'), json_extract(text, '$.mean') FROM event "
      "WHERE kind = 'time estimated' AND json_extract(text, '$.design') = '" +
          to_string(design_) + "' ORDER BY seq DESC LIMIT 1",
      [&](const LogCells& cells) {
        // If the first race has not begun, this estimate is not final yet.
        lowered =
            log_.elites.empty() ? std::min(cells[0].real(), 2 * cells[1].real()) : cells[0].real();
      });
  if (!read) return Unexpected(read.error());
  return lowered;
}

/// In irace's order: step by step, with the elites of the previous iteration first.
void Reading::sort_runs() {
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> ranks;
  for (const LogElite& elite : log_.elites)
    ranks.emplace(std::pair{elite.iteration + 1, elite.configuration}, elite.rank);
  // Runs before the first race come before its steps; runs of an unfinished step come last.
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  const std::int64_t without_step = log_.completed == "Incomplete" ? kLast : 0;
  std::ranges::stable_sort(log_.runs, {}, [&](const LogRun& run) {
    const auto step = steps_.find({run.iteration, run.pair});
    const auto rank = ranks.find({run.iteration, run.configuration});
    return std::tuple{run.iteration, step == steps_.end() ? without_step : step->second, run.pair,
                      rank == ranks.end() ? kLast : rank->second, run.configuration};
  });
}

/// In irace's order: first the elites of the first iteration, then those of the next that are new.
void Reading::sort_tests() {
  std::map<std::int64_t, std::size_t> turns;
  for (const LogElite& elite : log_.elites)
    turns.emplace(elite.configuration, turns.size());
  std::ranges::stable_sort(log_.tests, {}, [&](const LogTest& test) {
    const auto turn = turns.find(test.configuration);
    return std::tuple{turn == turns.end() ? turns.size() : turn->second, test.configuration,
                      test.pair};
  });
}

/// If an evaluator gives the costs, the runs themselves have none.
void Reading::judge() {
  if (judged_.empty()) return;
  const auto said = [&](std::int64_t configuration, std::int64_t pair, double cost) {
    const auto found = judged_.find({configuration, pair});
    return found == judged_.end() || std::isinf(cost) ? cost : found->second.cost;
  };
  for (LogRun& run : log_.runs)
    run.cost = said(run.configuration, run.pair, *run.cost);
  for (LogTest& test : log_.tests)
    test.cost = said(test.configuration, -test.pair, test.cost);
}

}  // namespace

Expected<IraceLog> stored_irace_log(StoreReader& store, DesignId design,
                                    const std::function<void(std::int64_t)>& on_row) {
  return Reading(store, design, on_row).log();
}

}  // namespace swarmsmith
