#include "cli/irace/irace_report.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>
#include <set>
#include <variant>

#include "base/text/json.h"
#include "cli/irace/aligned_table.h"
#include "cli/irace/irace_console.h"
#include "console/output.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

double cost_of(const EvaluationRow& row) {
  return row.status == EvaluationStatus::Ok ? to_cost(row.measured.score)
                                            : std::numeric_limits<double>::infinity();
}

/// Collects the rows for the report, in any order.
class Collector {
 public:
  explicit Collector(const ParameterSpace& space) : result_{.candidates = CandidateTable(space)} {}

  void add(const Row& row) {
    if (const auto* candidate = std::get_if<CandidateRow>(&row)) {
      if (auto added = result_.candidates.add(*candidate); !added) error_ = added.error();
    } else if (const auto* elite = std::get_if<EliteRow>(&row)) {
      elites_[elite->iteration][elite->rank] = *elite;
    } else if (const auto* state = std::get_if<DesignStateRow>(&row)) {
      result_.state = *state;
    } else if (const auto* pair = std::get_if<PairRow>(&row)) {
      if (pair->purpose == Purpose::Test) {
        instances_[{Purpose::Test, pair->number}] = pair->instance;
        result_.test_seeds[pair->instance] = pair->seed;
      } else if (pair->purpose == Purpose::Evaluator && pair->instance < 0) {
        // The number of a test instance is negative, so that it is not mistaken for a training
        // instance.
        instances_[{Purpose::Evaluator, pair->number}] = -pair->instance;
      }
    } else if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
      const Purpose purpose = evaluation->key.purpose;
      if (purpose == Purpose::Test || purpose == Purpose::Evaluator)
        evaluations_.push_back(*evaluation);
    }
  }

  Expected<IraceResult> result() && {
    if (error_) return Unexpected(*error_);
    if (!elites_.empty()) {
      for (const auto& [rank, elite] : elites_.rbegin()->second) {
        result_.best.push_back({number_of(elite.candidate), to_cost(elite.mean), elite.runs});
      }
    }
    // If an evaluator gives the costs, the runs themselves have none.
    for (const Purpose purpose : {Purpose::Test, Purpose::Evaluator}) {
      for (const EvaluationRow& row : evaluations_) {
        const auto instance = instances_.find({purpose, row.key.pair});
        if (row.key.purpose != purpose || instance == instances_.end()) continue;
        result_.tests[{number_of(row.key.candidate), instance->second}] = cost_of(row);
      }
    }
    return std::move(result_);
  }

 private:
  IraceResult result_;
  std::map<std::int64_t, std::map<std::int64_t, EliteRow>> elites_;  ///< by iteration and rank
  std::map<std::pair<Purpose, std::int64_t>, std::int64_t> instances_;
  std::vector<EvaluationRow> evaluations_;
  std::optional<Error> error_;
};

std::vector<std::int64_t> best_numbers(const IraceResult& result) {
  std::vector<std::int64_t> numbers;
  for (const IraceResult::Best& best : result.best)
    numbers.push_back(best.number);
  return numbers;
}

std::set<std::int64_t> tested(const IraceResult& result) {
  std::set<std::int64_t> numbers;
  for (const auto& [key, cost] : result.tests)
    numbers.insert(key.first);
  return numbers;
}

}  // namespace

Expected<IraceResult> read_irace_result(StoreReader& store, const ParameterSpace& space) {
  Collector collector(space);
  store.each_answer_row([&](const Row& row) { collector.add(row); });
  return std::move(collector).result();
}

std::string best_text(const IraceResult& result, const Scenario& scenario) {
  const std::vector<std::int64_t> numbers = best_numbers(result);
  std::string means;
  for (const IraceResult::Best& best : result.best) {
    means += fmt::format("{}{}: {:.10g} ({})", means.empty() ? "" : ", ", best.number, best.mean,
                         best.pairs);
  }
  if (!means.empty()) means = "# Mean costs (and how many runs each is over): " + means + "\n";
  return fmt::format(
      "# Best configurations (first number is the configuration ID; listed from best to worst "
      "according to {}):\n{}{}"
      "# Best configurations as commandlines (first number is the configuration ID; same order as "
      "above):\n{}",
      irace_order(scenario), result.candidates.configurations(numbers), means,
      result.candidates.command_lines(numbers));
}

std::string testing_text(const IraceResult& result, const std::string& date) {
  if (result.tests.empty()) return "";
  std::vector<std::string> names;
  for (const auto& [instance, seed] : result.test_seeds)
    names.push_back(std::to_string(instance) + "t");
  std::vector<TableColumn> columns;
  for (const std::int64_t number : tested(result)) {
    std::vector<std::optional<double>> costs;
    for (const auto& [instance, seed] : result.test_seeds) {
      const auto found = result.tests.find({number, instance});
      costs.push_back(found == result.tests.end() ? std::nullopt : std::optional(found->second));
    }
    columns.push_back({std::to_string(number), real_cells(costs)});
  }
  return fmt::format(
      "# {}: Testing results (column number is configuration ID in no particular order):\n{}", date,
      aligned_table(names, columns));
}

std::string end_date(StoreReader& store) {
  std::time_t ended = 0;
  (void)store.query(
      "SELECT CAST(strftime('%s', coalesce(max(finished), max(created))) AS INTEGER) "
      "FROM v_campaigns",
      {}, [](const auto&) {},
      [&ended](const std::vector<StoreReader::Cell>& cells) { ended = cells[0].integer(); });
  return irace_date(ended);
}

std::string nothing_ran_text(const std::string& date, const std::filesystem::path& store) {
  return fmt::format(
      "Nothing was run: these are the results of {}, which {} holds. Move that file away to run "
      "all of it again.",
      date, store.string());
}

std::string result_json(const IraceResult& result, const std::string& store, std::int64_t seed) {
  const auto best_json = [&](const IraceResult::Best& best) {
    const std::string parameters = result.candidates.parameters(best.number);
    return JsonObject()
        .add("id", best.number)
        .add("mean_cost", best.mean)
        .add("pairs", best.pairs)
        .add("parameters", JsonPiece{parameters.empty() ? "{}" : parameters})
        .add("command_line", result.candidates.command_line(best.number));
  };
  // JSON has no infinity, so a rejection is null.
  const auto test_json = [&](const auto& test) {
    const auto& [key, cost] = test;
    const auto drawn = result.test_seeds.find(key.second);
    return JsonObject()
        .add("id", key.first)
        .add("instance", fmt::format("{}t", key.second))
        .add("seed", drawn == result.test_seeds.end() ? 0 : drawn->second)
        .add("cost", cost);
  };
  return JsonObject()
             .add("v", 1)
             .add("event", "done")
             .add("store", store)
             .add("seed", seed)
             .add("experiments", result.state.used)
             .add("reason", result.state.reason)
             .add("best", json_list(result.best, best_json))
             .add("tests", json_list(result.tests, test_json))
             .text() +
         "\n";
}

}  // namespace swarmsmith::cli
