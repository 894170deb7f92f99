#include "cli/dashboard/race_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/figures/race_plot.h"
#include "analysis/records/records.h"
#include "cli/output/stored_stages.h"

namespace swarmsmith::cli {
namespace {

using RaceCell = StoreReader::Cell;

constexpr std::int64_t kMostIterations = 1'000'000;

/// A candidate in an iteration.
struct Racer {
  std::int64_t candidate = 0;
  std::map<std::size_t, std::string> scores{};  ///< JSON, by place of the step
  double sum = 0;
  std::int64_t runs = 0;
  std::optional<std::int64_t> dropped_at{};
  std::string reason{};
  std::int64_t elite_before = 0;  ///< rank; 0: none
  std::int64_t elite_after = 0;

  double mean() const {
    return runs == 0 ? -std::numeric_limits<double>::infinity() : sum / static_cast<double>(runs);
  }
};

/// Those who came further first; among them elites by rank, then the better mean.
bool came_further(const Racer& a, const Racer& b) {
  static constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  const auto order = [](const Racer& racer) {
    return std::tuple(-racer.dropped_at.value_or(kLast),
                      racer.elite_after == 0 ? kLast : racer.elite_after, -racer.mean(),
                      racer.candidate);
  };
  return order(a) < order(b);
}

/// Elites at the end of an iteration, by rank.
Expected<std::map<std::int64_t, std::int64_t>> elites_of(const Question& question,
                                                         std::int64_t iteration) {
  const auto rows =
      rows_of(question, fmt::format("SELECT candidate, rank FROM v_convergence WHERE design = {} "
                                    "AND iteration = {}",
                                    question.design.value, iteration));
  if (!rows) return Unexpected(rows.error());
  std::map<std::int64_t, std::int64_t> ranks;
  for (const auto& cells : rows->cells)
    ranks[cells[0].integer()] = cells[1].integer();
  return ranks;
}

/// The iteration that is asked for, else the last one that has a step: most of an iteration's time
/// goes before its first step ends, and a page shows the race before it until then.
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
  const auto stepped = rows_of(question, fmt::format("SELECT coalesce(max(iteration), {}) FROM "
                                                     "v_race_steps WHERE design = {}",
                                                     newest, question.design.value));
  if (!stepped) return Unexpected(stepped.error());
  const auto asked =
      question.integer("iteration", stepped->cells.front().front().integer(), 1, kMostIterations);
  if (!asked || *asked <= newest) return asked;
  return unexpected(ErrorKind::NotFound,
                    fmt::format("the design has no such iteration; it has 1 to {}", newest),
                    "iteration");
}

struct Race {
  Rows steps;
  std::vector<Racer> racers;
};

Expected<Race> read_race(const Question& question, std::int64_t iteration) {
  const std::string of_race =
      fmt::format(" WHERE design = {} AND iteration = {}", question.design.value, iteration);
  Race race;
  auto steps = rows_of(question,
                       "SELECT step, pair, marker, alive_after, statistic, p_value, used, "
                       "best, mean_best, alive_before FROM v_race_steps" +
                           of_race + " ORDER BY step");
  if (!steps) return Unexpected(steps.error());
  race.steps = std::move(*steps);
  std::map<std::int64_t, std::size_t> places;
  for (std::size_t i = 0; i < race.steps.cells.size(); ++i)
    places[race.steps.cells[i][0].integer()] = i;
  const auto cells =
      rows_of(question, "SELECT candidate, step, score FROM v_race_matrix" + of_race);
  const auto drops =
      rows_of(question, "SELECT candidate, step, reason FROM v_eliminations" + of_race);
  const auto before = elites_of(question, iteration - 1);
  const auto after = elites_of(question, iteration);
  if (!cells) return Unexpected(cells.error());
  if (!drops) return Unexpected(drops.error());
  if (!before) return Unexpected(before.error());
  if (!after) return Unexpected(after.error());
  std::map<std::int64_t, Racer> racers;
  for (const auto& row : cells->cells) {
    // A race that goes on may be a step further than its list of steps was.
    const auto place = places.find(row[1].integer());
    if (place == places.end()) continue;
    Racer& racer = racers[row[0].integer()];
    racer.scores[place->second] = cell_as_json(row[2]).text;
    if (row[2].type == RaceCell::Type::Null) continue;
    racer.sum += row[2].real();
    ++racer.runs;
  }
  for (const auto& row : drops->cells) {
    const auto racer = racers.find(row[0].integer());
    if (racer == racers.end()) continue;
    racer->second.dropped_at = row[1].integer();
    racer->second.reason = row[2].text;
  }
  for (auto& [candidate, racer] : racers) {
    racer.candidate = candidate;
    if (const auto rank = before->find(candidate); rank != before->end())
      racer.elite_before = rank->second;
    if (const auto rank = after->find(candidate); rank != after->end())
      racer.elite_after = rank->second;
    race.racers.push_back(std::move(racer));
  }
  std::ranges::sort(race.racers, came_further);
  return race;
}

/// Scores of the step's survivors, in their order; who was dropped before has none any more.
JsonPiece scores_at(std::span<const Racer> racers, std::size_t place, std::int64_t step) {
  std::string text = "[";
  for (const Racer& racer : racers) {
    if (racer.dropped_at && *racer.dropped_at < step) break;
    if (text.size() > 1) text += ',';
    const auto score = racer.scores.find(place);
    text += score == racer.scores.end() ? "null" : score->second;
  }
  return {text + "]"};
}

/// A column of the steps.
JsonPiece column_of(const Rows& rows, std::size_t column) {
  return json_list(rows.cells,
                   [&](const std::vector<RaceCell>& cells) { return cell_as_json(cells[column]); });
}

/// Instance and seed of each step's pair.
Expected<std::pair<JsonPiece, JsonPiece>> pairs_of(const Question& question, const Rows& steps) {
  const auto rows = rows_of(question, fmt::format("SELECT number, instance, seed FROM pair WHERE "
                                                  "design = {} AND purpose = 0",
                                                  question.design.value));
  if (!rows) return Unexpected(rows.error());
  std::map<std::string, const std::vector<RaceCell>*> known;
  for (const auto& cells : rows->cells)
    known[cells[0].text] = &cells;
  const auto values = [&](std::size_t column) {
    return json_list(steps.cells, [&](const std::vector<RaceCell>& step) {
      const auto found = known.find(step[1].text);
      return found == known.end() ? JsonPiece{"null"} : cell_as_json((*found->second)[column]);
    });
  };
  return std::pair(values(1), values(2));
}

std::optional<std::int64_t> none_for_0(std::int64_t rank) {
  return rank == 0 ? std::nullopt : std::optional(rank);
}

/// What is sampled: all elites, and of the others so many, evenly.
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

std::set<std::string> names_of(const Question& question) {
  std::set<std::string> names;
  std::string_view rest = question.text("names");
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    names.emplace(rest.substr(0, comma));
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  return names;
}

/// What an iteration is called, and why it is no race where it is none.
struct RoundTexts {
  std::string title{};
  std::string note{};
};

Expected<RoundTexts> round_of(const Question& question, std::int64_t iteration) {
  const auto stages = StoredStages::read(question.store);
  if (!stages) return Unexpected(stages.error());
  const std::string design = std::to_string(question.design.value);
  const SearchOptions* search = stages->search(design);
  if (search == nullptr) return RoundTexts{.title = fmt::format("Race {}", iteration)};
  RoundTexts texts{.title = stages->round(design, std::to_string(iteration))};
  texts.title.front() = static_cast<char>(std::toupper(texts.title.front()));
  const SearchWords& words = words_of(search->kind);
  if (!words.has_tests)
    texts.note = fmt::format(
        "This is no race: {} compares means, and no statistical test drops anybody.", words.name);
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
  const auto race = read_race(question, *iteration);
  if (!race) return Unexpected(race.error());
  const auto over = rows_of(
      question, fmt::format("SELECT 1 FROM v_designs WHERE design = {} AND (iteration > {} OR "
                            "state IN ('finished', 'stopped', 'testing'))",
                            question.design.value, *iteration));
  if (!over) return Unexpected(over.error());
  const auto round = round_of(question, *iteration);
  if (!round) return Unexpected(round.error());
  const auto pairs = pairs_of(question, race->steps);
  if (!pairs) return Unexpected(pairs.error());
  std::span<const Racer> shown(race->racers);
  shown = shown.subspan(std::min(shown.size(), static_cast<std::size_t>(*from)));
  shown = shown.first(std::min(shown.size(), static_cast<std::size_t>(*rows)));
  std::string scores;
  for (std::size_t i = 0; i < race->steps.cells.size(); ++i)
    scores += (i == 0 ? "" : ",") + scores_at(shown, i, race->steps.cells[i][0].integer()).text;
  // A later campaign of a finished design (`extend`) begins new iterations.
  const bool ended = !over->cells.empty();
  return json_answer(
      answer_object()
          .add("design", question.design)
          .add("iteration", *iteration)
          .add("ended", ended)
          .add("title", round->title)
          .add("note", round->note)
          .add("rows_total", race->racers.size())
          .add("from", *from)
          .add("steps", column_of(race->steps, 0))
          .add("pairs", column_of(race->steps, 1))
          .add("instances", pairs->first)
          .add("seeds", pairs->second)
          .add("markers", column_of(race->steps, 2))
          .add("meanings",
               json_list(race->steps.cells,
                         [](const auto& cells) { return meaning_of_marker(cells[2].text); }))
          .add("alive", column_of(race->steps, 3))
          .add("alive_before", column_of(race->steps, 9))
          .add("statistic", column_of(race->steps, 4))
          .add("p_value", column_of(race->steps, 5))
          .add("used", column_of(race->steps, 6))
          .add("best", column_of(race->steps, 7))
          .add("mean_best", column_of(race->steps, 8))
          .add("candidates", json_list(shown, [](const Racer& each) { return each.candidate; }))
          .add("elite_before",
               json_list(shown, [](const Racer& each) { return none_for_0(each.elite_before); }))
          .add("elite_after",
               json_list(shown, [](const Racer& each) { return none_for_0(each.elite_after); }))
          .add("dropped_at", json_list(shown, [](const Racer& each) { return each.dropped_at; }))
          .add("reasons", json_list(shown,
                                    [](const Racer& each) {
                                      return each.reason.empty() ? std::nullopt
                                                                 : std::optional(each.reason);
                                    }))
          .add("scores", JsonPiece{"[" + scores + "]"}),
      ended);
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
  const std::set<std::string> names = names_of(question);
  // In the order in which they first occur.
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::string>> values;
  for (std::size_t i = 0; i < rows->cells.size(); ++i) {
    const auto parameters = nlohmann::ordered_json::parse(rows->cells[i][4].text, nullptr, false);
    if (!parameters.is_object()) continue;
    for (const auto& [name, value] : parameters.items()) {
      if (!names.empty() && !names.contains(name)) continue;
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
                                                 [&](const std::vector<RaceCell>& cells) {
                                                   return sample->elites.contains(
                                                       cells[0].integer());
                                                 }))
                         .add("parameters", parameters));
}

}  // namespace swarmsmith::cli
