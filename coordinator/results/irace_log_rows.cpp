#include "coordinator/results/irace_log_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/text/json.h"
#include "base/text/toml_text.h"
#include "coordinator/campaign/machine_space.h"
#include "coordinator/results/internal/log_races.h"
#include "sim/control/flavour_file.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

/// Makes the rows for one log.
class Rows {
 public:
  Rows(const IraceLog& log, const IraceImport& known, DesignId design)
      : log_(log), known_(known), design_(design), races_(log) {}

  OrErrors<std::vector<Row>> all() {
    add_iterations();
    if (auto errors = add_candidates(); !errors.empty()) return tl::unexpected(std::move(errors));
    add_pairs_and_evaluations();
    for (std::int64_t iteration = 1; iteration <= races_.iterations(); ++iteration)
      add_race(iteration);
    add_elites();
    add_end();
    return std::move(rows_);
  }

 private:
  CandidateId id_of(std::int64_t configuration) const {
    return configuration == 0 ? CandidateId{} : candidate_id(design_, configuration);
  }

  void add_iterations();
  std::vector<Error> add_candidates();
  Expected<CandidateRow> candidate(const LogConfiguration& configuration) const;
  void add_pairs_and_evaluations();
  void add_race(std::int64_t iteration);
  void add_eliminations(const std::vector<LogStep>& steps, std::size_t at, std::int64_t number);
  void add_elites();
  void add_end();

  const IraceLog& log_;
  const IraceImport& known_;
  DesignId design_;
  LogRaces races_;
  std::vector<Row> rows_;
  std::int64_t steps_ = 0;
  std::int64_t used_ = 0;
};

void Rows::add_iterations() {
  for (std::int64_t iteration = 1; iteration <= races_.iterations(); ++iteration) {
    const auto ran = std::ranges::count(log_.runs, iteration, &LogRun::iteration);
    const auto& restarts = log_.soft_restarts;
    rows_.emplace_back(IterationRow{
        .design = design_,
        .number = iteration,
        .of = std::max(log_.iterations, races_.iterations()),
        .budget = ran,
        .configurations = static_cast<std::int64_t>(races_.racers_of(iteration).size()),
        .elites = static_cast<std::int64_t>(races_.elites_of(iteration - 1).size()),
        .soft_restart = std::ranges::find(restarts, iteration) != restarts.end()});
  }
}

std::vector<Error> Rows::add_candidates() {
  std::map<std::int64_t, std::int64_t> first_ran;
  for (const LogRun& run : log_.runs)
    first_ran.emplace(run.configuration, run.iteration);
  std::vector<Error> errors;
  std::int64_t iteration = 1;  // without runs: as the one before
  for (const LogConfiguration& configuration : log_.configurations) {
    if (const auto ran = first_ran.find(configuration.id); ran != first_ran.end()) {
      iteration = ran->second;
    }
    auto row = candidate(configuration);
    if (!row) {
      errors.push_back({ErrorKind::BadInput, row.error().message,
                        fmt::format("configuration {}, {}", configuration.id, row.error().where)});
      continue;
    }
    row->iteration = iteration;
    rows_.emplace_back(std::move(*row));
  }
  return errors;
}

Expected<CandidateRow> Rows::candidate(const LogConfiguration& configuration) const {
  CandidateRow row{.id = id_of(configuration.id),
                   .iteration = 0,
                   .parent = id_of(configuration.parent),
                   .parameters = "",
                   .machine = "",
                   .modules = "{}",
                   .states = 0,
                   .transitions = 0};
  JsonObject parameters;
  for (std::size_t i = 0; i < configuration.values.size(); ++i) {
    const std::string& value = configuration.values[i];
    if (value.empty()) continue;
    const LogParameter& parameter = log_.parameters[i];
    const bool is_number = parameter.type == 'i' || parameter.type == 'r';
    parameters.add(parameter.name,
                   JsonPiece{is_number && number_in(value) ? value : quoted_text(value)});
    row.machine += (row.machine.empty() ? "" : " ") + parameter.switch_text + value;
  }
  row.parameters = parameters.text();
  if (!known_.flavour) return row;
  const auto machine = parse_machine(row.machine, *known_.flavour);
  if (!machine) return Unexpected(machine.error());
  row.machine = print_machine(*machine, *known_.flavour);
  row.modules = modules_json(*machine, *known_.flavour);
  row.states = static_cast<std::int64_t>(machine->states.size());
  row.transitions = transition_count(*machine);
  return row;
}

void Rows::add_pairs_and_evaluations() {
  for (const LogPair& pair : log_.pairs) {
    rows_.emplace_back(PairRow{.design = design_,
                               .purpose = pair.test ? Purpose::Test : Purpose::Race,
                               .number = pair.number,
                               .instance = pair.instance,
                               .seed = pair.seed});
  }
  std::map<std::int64_t, CandidateTotalsRow> totals;
  for (const LogRun& run : log_.runs) {
    const bool rejected = is_rejected(run);
    const double value = rejected ? 0 : -*run.cost;
    rows_.emplace_back(
        EvaluationRow{.key = {id_of(run.configuration), Purpose::Race, run.pair},
                      .iteration = run.iteration,
                      .status = rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok,
                      .measured = {.score = value, .time = run.time},
                      .bound = run.bound,
                      .source = "command"});
    CandidateTotalsRow& total = totals[run.configuration];
    total.candidate = id_of(run.configuration);
    total.runs += rejected ? 0 : 1;
    total.score_sum += value;
    // A cost may be as large as 1e300, and a store takes only finite numbers.
    total.score_squares =
        std::min(total.score_squares + value * value, std::numeric_limits<double>::max());
  }
  for (const auto& [configuration, total] : totals)
    rows_.emplace_back(total);
  for (const LogTest& test : log_.tests) {
    const bool rejected = !std::isfinite(test.cost);
    rows_.emplace_back(
        EvaluationRow{.key = {id_of(test.configuration), Purpose::Test, test.pair},
                      .status = rejected ? EvaluationStatus::Rejected : EvaluationStatus::Ok,
                      .measured = {.score = rejected ? 0 : -test.cost},
                      .source = "command"});
  }
}

void Rows::add_eliminations(const std::vector<LogStep>& steps, std::size_t at,
                            std::int64_t number) {
  // A race ends with its elites: all others are dropped at its last step, whatever its test said.
  const bool is_last = at + 1 == steps.size();
  const std::vector<std::int64_t> kept =
      is_last ? races_.elites_of(steps[at].iteration) : steps[at + 1].alive;
  for (const std::int64_t configuration : steps[at].alive) {
    if (std::ranges::find(kept, configuration) != kept.end()) continue;
    const bool rejected = !races_.score(configuration, steps[at].pair, steps[at].iteration);
    rows_.emplace_back(EliminationRow{.candidate = id_of(configuration),
                                      .iteration = steps[at].iteration,
                                      .step = number,
                                      .rank_sum = races_.rank_sum(steps, at, configuration),
                                      .reason = rejected  ? "rejected"
                                                : is_last ? "not kept"
                                                          : "test"});
  }
}

void Rows::add_race(std::int64_t iteration) {
  const std::vector<LogStep> steps = races_.steps_of(iteration);
  for (std::size_t at = 0; at < steps.size(); ++at) {
    const bool is_last = at + 1 == steps.size();
    used_ += steps[at].evaluated;
    const auto [best, mean] = races_.best_of(steps, at);
    rows_.emplace_back(RaceStepRow{
        .design = design_,
        .step = ++steps_,
        .iteration = iteration,
        .pair = steps[at].pair,
        .marker = '?',
        .evaluated = steps[at].evaluated,
        .alive_before = static_cast<std::int64_t>(steps[at].alive.size()),
        .alive_after = static_cast<std::int64_t>(is_last ? races_.elites_of(iteration).size()
                                                         : steps[at + 1].alive.size()),
        .best = id_of(best),
        .mean_best = mean,
        .used = used_});
    add_eliminations(steps, at, steps_);
  }
}

void Rows::add_elites() {
  for (const LogElite& elite : log_.elites) {
    double sum = 0;
    std::int64_t runs = 0;
    for (const LogRun& run : log_.runs) {
      if (run.configuration != elite.configuration || run.iteration > elite.iteration) continue;
      if (is_rejected(run)) continue;
      sum -= *run.cost;
      ++runs;
    }
    rows_.emplace_back(EliteRow{.design = design_,
                                .iteration = elite.iteration,
                                .rank = elite.rank,
                                .candidate = id_of(elite.configuration),
                                .mean = runs == 0 ? 0 : sum / static_cast<double>(runs),
                                .runs = runs});
  }
}

/// The winner is the first elite of the last iteration that has elites.
void Rows::add_end() {
  DesignStateRow state{.design = design_,
                       .state = DesignState::Finished,
                       .used = static_cast<std::int64_t>(log_.runs.size()),
                       .iteration = races_.iterations(),
                       .best = {},
                       .best_mean = 0,
                       .reason = log_.completed};
  if (log_.completed == "Incomplete") state.state = DesignState::Stopped;
  for (const Row& row : rows_) {
    const auto* elite = std::get_if<EliteRow>(&row);
    if (elite == nullptr || elite->rank != 1) continue;
    state.best = elite->candidate;
    state.best_mean = elite->mean;
  }
  rows_.emplace_back(std::move(state));
}

/// Contains the tables for which the store has no columns, so that the log can be written again.
std::string deciding_of(const IraceLog& log) {
  JsonObject object;
  object.add("imported", "irace log").add("irace", log.version).add("log", log.digest);
  const auto texts = print_irace_log(log);
  // Bytes that are not UTF-8 are kept, so that the files can be written again without changes.
  for (const std::string& file : irace_setting_files())
    object.add(file, JsonPiece{quoted_text(texts.at(file))});
  return object.text();
}

std::int64_t next_repetition(const IraceImport& known) {
  std::int64_t last = 0;
  for (const KnownDesign& design : known.designs) {
    if (design.mission == known.mission && design.method == known.method) {
      last = std::max(last, design.repetition);
    }
  }
  return last + 1;
}

}  // namespace

OrErrors<Addition> irace_log_addition(const IraceLog& log, const IraceImport& known) {
  const DesignId design{known.designs.empty() ? 1 : known.designs.back().id.value + 1};
  auto rows = Rows(log, known, design).all();
  if (!rows) return tl::unexpected(rows.error());
  const std::string flavour = known.flavour ? known.flavour->name : "";
  Digest digest;
  for (const std::string& text :
       {std::string("irace"), log.digest, known.mission, known.method, flavour})
    digest.add(text);
  if (const std::string own = known.flavour ? own_flavour_text(*known.flavour) : ""; !own.empty())
    digest.add(own);
  return Addition{.campaign = CampaignRow{.name = known.campaign,
                                          .digest = digest.hex(),
                                          .deciding = deciding_of(log),
                                          .file = "",
                                          .seed = log.seed},
                  .designs = {{.row = {.id = design,
                                       .mission = known.mission,
                                       .method = known.method,
                                       .flavour = flavour,
                                       .repetition = next_repetition(known),
                                       .seed = log.seed,
                                       .budget = log.budget},
                               .name = ""}},
                  .removed = {},
                  .rows = std::move(*rows)};
}

}  // namespace swarmsmith
