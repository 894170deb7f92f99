#include "cli/dashboard/race_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/figures/race_plot.h"
#include "analysis/records/race_matrix.h"
#include "base/plain_text.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

constexpr std::int64_t kMostIterations = 1'000'000;

/// The requested iteration, else the last one with a step. Most of an iteration's time passes
/// before its first step ends, and until then the page shows the race before it.
Expected<std::int64_t> iteration_of(const Question& question) {
  const auto last = rows_of(question, fmt::format("SELECT coalesce(max(iteration), 0) FROM "
                                                  "v_iterations WHERE design = {}",
                                                  question.design.value));
  if (!last) return Unexpected(last.error());
  const std::int64_t newest = last->cells.front().front().integer();
  if (newest == 0) {
    return unexpected(ErrorKind::NotFound, "no iteration has begun yet",
                      to_string(question.design));
  }
  const auto stepped = last_raced_iteration(question.store, question.design);
  if (!stepped) return Unexpected(stepped.error());
  const auto asked =
      question.integer("iteration", *stepped == 0 ? newest : *stepped, 1, kMostIterations);
  if (!asked || *asked <= newest) return asked;
  return unexpected(ErrorKind::NotFound,
                    fmt::format("the design has no such iteration; it has 1 to {}", newest),
                    "iteration");
}

/// A value for each candidate in each step; candidates that were dropped earlier have none.
JsonPiece cells_of(const RaceMatrix& matrix, std::span<const RaceMatrix::Row> shown,
                   std::optional<double> RaceMatrix::Cell::*value) {
  return json_list(matrix.steps, [&](const RaceMatrix::Step& step) {
    const auto column = static_cast<std::size_t>(&step - matrix.steps.data());
    const auto gone = std::ranges::find_if(
        shown, [&](const auto& row) { return row.dropped_after && *row.dropped_after < column; });
    return json_list(shown.first(static_cast<std::size_t>(gone - shown.begin())),
                     [&](const RaceMatrix::Row& row) { return row.at(column).*value; });
  });
}

JsonPiece column_of(const Rows& rows, std::size_t column) {
  return json_list(rows.cells, [&](const std::vector<StoreReader::Cell>& cells) {
    return cell_as_json(cells[column]);
  });
}

/// The sample: all elites, and a limited number of other candidates, evenly spaced.
struct Sample {
  std::int64_t total = 0;
  std::set<std::int64_t> elites;
  std::string condition;
};

Expected<Sample> sample_of(const Question& question, std::int64_t wanted) {
  const std::int64_t design = question.design.value;
  const auto total =
      rows_of(question, fmt::format("SELECT count(*) FROM candidate WHERE id > {} AND id <= {}",
                                    (design - 1) * 1'000'000, design * 1'000'000));
  if (!total) return Unexpected(total.error());
  const auto elites = rows_of(
      question,
      fmt::format("SELECT DISTINCT candidate FROM v_convergence WHERE design = {}", design));
  if (!elites) return Unexpected(elites.error());
  Sample sample{.total = total->cells.front().front().integer(), .elites = {}, .condition = {}};
  for (const auto& cells : elites->cells)
    sample.elites.insert(cells.front().integer());
  const std::int64_t every = std::max<std::int64_t>(1, (sample.total + wanted - 1) / wanted);
  sample.condition = fmt::format(" WHERE design = {} AND ((candidate - 1) % {} = 0", design, every);
  std::string list;
  for (const std::int64_t elite : sample.elites)
    list += (list.empty() ? "" : ",") + std::to_string(elite);
  if (!list.empty()) sample.condition += " OR candidate IN (" + list + ")";
  sample.condition += ")";
  return sample;
}

/// The name of an iteration, and a note if it is not a race.
struct RoundTexts {
  std::string title{};
  std::string note{};
};

Expected<RoundTexts> round_of(const Question& question, std::int64_t iteration) {
  const auto stages = StoredStages::read(question.store, question.design);
  if (!stages) return Unexpected(stages.error());
  const std::string design = std::to_string(question.design.value);
  const SearchOptions* search = stages->search(design);
  if (search == nullptr) return RoundTexts{.title = fmt::format("Race {}", iteration)};
  RoundTexts texts{.title = stages->round(design, std::to_string(iteration))};
  texts.title.front() = static_cast<char>(std::toupper(texts.title.front()));
  const SearchWords& words = words_of(*search);
  if (!words.has_tests)
    texts.note = fmt::format(
        "This is not a race: {} compares means; no statistical test drops candidates.", words.name);
  return texts;
}

}  // namespace

Expected<Answer> race_answer(const Question& question) {
  if (auto known = check_design(question); !known) return Unexpected(known.error());
  const auto rows = question.integer("rows", 400, 1, 1'000'000);
  if (!rows) return Unexpected(rows.error());
  const auto from = question.integer("from", 0, 0, 1'000'000);
  if (!from) return Unexpected(from.error());
  const auto iteration = iteration_of(question);
  if (!iteration) {
    if (iteration.error().kind != ErrorKind::NotFound || !question.text("iteration").empty())
      return Unexpected(iteration.error());
    return json_answer(answer_object().add("nothing", iteration.error().message));
  }
  const auto race = race_matrix(question.store, question.design, *iteration);
  if (!race) return Unexpected(race.error());
  const auto over = rows_of(
      question, fmt::format("SELECT 1 FROM v_designs WHERE design = {} AND (iteration > {} OR "
                            "state IN ('finished', 'stopped', 'testing'))",
                            question.design.value, *iteration));
  if (!over) return Unexpected(over.error());
  const auto round = round_of(question, *iteration);
  if (!round) return Unexpected(round.error());
  std::span<const RaceMatrix::Row> shown(race->rows);
  shown = shown.subspan(std::min(shown.size(), static_cast<std::size_t>(*from)));
  shown = shown.first(std::min(shown.size(), static_cast<std::size_t>(*rows)));
  const auto by_step = [&](const auto& of) { return json_list(race->steps, std::mem_fn(of)); };
  const auto by_row = [&](const auto& of) { return json_list(shown, std::mem_fn(of)); };
  // A later run of a finished design (`extend`) begins new iterations.
  const bool ended = !over->cells.empty();
  return json_answer(
      answer_object()
          .add("design", question.design)
          .add("iteration", *iteration)
          .add("ended", ended)
          .add("title", round->title)
          .add("note", round->note)
          .add("rows_total", race->rows.size())
          .add("from", *from)
          .add("steps", by_step(&StepRecord::step))
          .add("pairs", by_step(&StepRecord::pair))
          .add("instances", by_step(&StepRecord::instance))
          .add("seeds", by_step(&StepRecord::seed))
          .add("markers", by_step(&StepRecord::marker))
          .add("meanings",
               json_list(race->steps,
                         [](const auto& step) { return meaning_of_marker(step.marker); }))
          .add("alive", by_step(&StepRecord::alive_after))
          .add("alive_before", by_step(&StepRecord::alive_before))
          .add("statistic", by_step(&StepRecord::statistic))
          .add("p_value", by_step(&StepRecord::p_value))
          .add("used", by_step(&StepRecord::used))
          .add("best", json_list(race->steps,
                                 [](const auto& step) {
                                   return step.best ? std::optional(step.best->value)
                                                    : std::nullopt;
                                 }))
          .add("mean_best", by_step(&StepRecord::mean_best))
          .add("ranked", by_step(&RaceMatrix::Step::ranked))
          .add("candidates", json_list(shown, [](const auto& row) { return row.candidate.value; }))
          .add("elite_before", by_row(&RaceMatrix::Row::elite_before))
          .add("elite_after", by_row(&RaceMatrix::Row::elite_after))
          .add("dropped_at", json_list(shown,
                                       [&](const auto& row) {
                                         return row.dropped_after
                                                    ? std::optional(
                                                          race->steps[*row.dropped_after].step)
                                                    : std::nullopt;
                                       }))
          .add("reasons", json_list(shown,
                                    [](const auto& row) {
                                      return row.dropped_after ? std::optional(row.reason)
                                                               : std::nullopt;
                                    }))
          .add("scores", cells_of(*race, shown, &RaceMatrix::Cell::score))
          .add("ranks", cells_of(*race, shown, &RaceMatrix::Cell::rank)),
      // Without an iteration, the answer is about another one as soon as that has a step.
      ended && !question.text("iteration").empty());
}

Expected<Answer> parameters_answer(const Question& question) {
  if (auto known = check_design(question); !known) return Unexpected(known.error());
  const auto wanted = question.integer("sample", 1000, 1, 100'000);
  if (!wanted) return Unexpected(wanted.error());
  const auto sample = sample_of(question, *wanted);
  if (!sample) return Unexpected(sample.error());
  const auto rows = rows_of(question,
                            "SELECT candidate, iteration, mean, runs, parameters FROM "
                            "v_candidates" +
                                sample->condition + " ORDER BY candidate");
  if (!rows) return Unexpected(rows.error());
  const std::string& asked = question.text("names");
  const std::vector<std::string_view> names = split(asked, ',');
  // Values in the order of their first occurrence.
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::string>> values;
  for (std::size_t i = 0; i < rows->cells.size(); ++i) {
    const auto parameters = nlohmann::ordered_json::parse(rows->cells[i][4].text, nullptr, false);
    if (!parameters.is_object()) continue;
    for (const auto& [name, value] : parameters.items()) {
      if (!asked.empty() && std::ranges::find(names, name) == names.end()) continue;
      auto& column = values[name];
      if (column.empty()) {
        order.push_back(name);
        column.assign(rows->cells.size(), "null");
      }
      column[i] = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
  }
  JsonObject parameters;
  for (const std::string& name : order)
    parameters.add(
        name, json_list(values[name], [](const std::string& value) { return JsonPiece{value}; }));
  return json_answer(answer_object()
                         .add("total", sample->total)
                         .add("candidates", column_of(*rows, 0))
                         .add("iteration", column_of(*rows, 1))
                         .add("mean", column_of(*rows, 2))
                         .add("runs", column_of(*rows, 3))
                         .add("elite", json_list(rows->cells,
                                                 [&](const std::vector<StoreReader::Cell>& cells) {
                                                   return sample->elites.contains(
                                                       cells[0].integer());
                                                 }))
                         .add("parameters", parameters));
}

}  // namespace swarmsmith::cli
