#include "analysis/records/records.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/ranks.h"
#include "base/text/csv.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

using Cell = StoreReader::Cell;
using Cells = std::vector<Cell>;

std::optional<std::int64_t> maybe_integer(const Cell& cell) {
  return cell.is_null() ? std::nullopt : std::optional(cell.integer());
}

std::optional<CandidateId> maybe_candidate(const Cell& cell) {
  return cell.is_null() ? std::nullopt : std::optional(CandidateId{cell.integer()});
}

/// " WHERE ..." for the columns mission, method and design of `table`.
std::string where(const RecordFilter& filter, std::string_view table = "") {
  std::vector<std::string> terms;
  if (!filter.mission.empty())
    terms.push_back(fmt::format("{}mission = {}", table, sql_text(filter.mission)));
  if (!filter.method.empty())
    terms.push_back(fmt::format("{}method = {}", table, sql_text(filter.method)));
  if (filter.design) terms.push_back(fmt::format("{}design = {}", table, filter.design->value));
  return terms.empty() ? "" : fmt::format(" WHERE {}", fmt::join(terms, " AND "));
}

/// SQL for the flavour of a design `d`; a constant in stores with a schema before 4, which lack it.
Expected<std::string> flavour_column(StoreReader& store) {
  std::string column = "''";
  const auto end = store.query(
      "SELECT * FROM v_designs LIMIT 0", kRecordLimits,
      [&](const std::vector<std::string>& names) {
        if (std::ranges::find(names, "flavour") != names.end()) column = "d.flavour";
      },
      [](const Cells&) {});
  if (!end) return Unexpected(end.error());
  return column;
}

template <class Record, class Make>
Expected<std::vector<Record>> read(StoreReader& store, const std::string& sql, const Make& make) {
  std::vector<Record> records;
  const auto end = store.query(
      sql, kRecordLimits, [](const std::vector<std::string>&) {},
      [&](const Cells& row) { records.push_back(make(row)); });
  if (!end) return Unexpected(end.error());
  if (end->truncated) {
    return bad_input(
        fmt::format("reading took over {} s: ask for one mission or design", kRecordLimits.seconds),
        sql);
  }
  return records;
}

/// The ranks of the cells of one step, by their scores.
void rank_cells(std::span<RaceCell> step) {
  std::vector<double> costs;
  for (const RaceCell& cell : step)
    if (cell.score) costs.push_back(-*cell.score);
  const AverageRanks ranked = average_ranks(costs);
  std::size_t next = 0;
  for (RaceCell& cell : step)
    cell.rank = cell.score ? std::optional(ranked.ranks[next++]) : std::nullopt;
}

/// If a targetEvaluator gives the costs, the scores of the runs are without meaning: they are
/// replaced, and so are their ranks. The last of its answers on a run counts.
Expected<void> judge_cells(StoreReader& store, DesignId design, std::vector<RaceCell>& cells) {
  const auto has_evaluator = has_key(store, "evaluator");
  if (!has_evaluator) return Unexpected(has_evaluator.error());
  if (!*has_evaluator) return {};
  std::map<std::pair<CandidateId, std::int64_t>, std::optional<double>> scores;
  const auto end = store.query(
      fmt::format("SELECT r.candidate, r.pair, v.score FROM v_evaluations AS v"
                  " JOIN v_evaluations AS r ON r.candidate = v.candidate AND r.purpose = 'race'"
                  " AND r.instance = v.instance AND r.seed IS v.seed"
                  " WHERE v.design = {} AND v.purpose = 'evaluator' ORDER BY v.pair",
                  design.value),
      kRecordLimits, [](const std::vector<std::string>&) {},
      [&](const Cells& row) {
        scores[{CandidateId{row[0].integer()}, row[1].integer()}] = row[2].maybe_real();
      });
  if (!end) return Unexpected(end.error());
  if (scores.empty()) return {};
  for (RaceCell& cell : cells) {
    const auto judged = scores.find({cell.candidate, cell.pair});
    if (judged != scores.end()) cell.score = judged->second;
  }
  for (auto first = cells.begin(); first != cells.end();) {
    const auto last = std::ranges::find_if(
        first, cells.end(), [&](const RaceCell& cell) { return cell.step != first->step; });
    rank_cells({first, last});
    first = last;
  }
  return {};
}

}  // namespace

Expected<std::vector<CampaignRecord>> campaigns(StoreReader& store) {
  return read<CampaignRecord>(
      store,  // an imported campaign has no file that could be run
      "SELECT campaign, name, seed, digest, iif(state = 'imported', '', file) FROM v_campaigns "
      "ORDER BY campaign",
      [](const Cells& row) {
        return CampaignRecord{.campaign = row[0].integer(),
                              .name = row[1].text,
                              .seed = row[2].integer(),
                              .digest = row[3].text,
                              .file = row[4].text};
      });
}

Expected<bool> has_key(StoreReader& store, std::string_view key) {
  const auto all = campaigns(store);
  if (!all) return Unexpected(all.error());
  return std::ranges::any_of(*all, [&](const CampaignRecord& campaign) {
    return campaign.file.find(fmt::format("\n{} = \"", key)) != std::string::npos;
  });
}

Expected<std::vector<DesignScore>> design_scores(StoreReader& store, const RecordFilter& filter) {
  // Candidate, source, instance and seed identify one score. This is a LEFT JOIN, because for a
  // condition with IN, SQLite would search the whole list of rows for each row.
  const std::string transfers =
      "SELECT DISTINCT candidate, source, instance, seed FROM v_evaluations WHERE purpose IN " +
      words_in_sql(is_transfer) + " AND candidate IN (SELECT best_candidate FROM v_designs" +
      where(filter) + ")";
  auto scores =
      read<DesignScore>(store,
                        "SELECT s.design, s.mission, s.method, s.repetition, "
                        "s.candidate, s.source, s.purpose, s.pair, s.instance, s.seed, "
                        "s.score, t.seed IS NOT NULL FROM v_design_scores AS s "
                        "LEFT JOIN (" +
                            transfers +
                            ") AS t ON s.purpose = 'score' AND t.candidate = s.candidate "
                            "AND t.source = s.source AND t.instance = s.instance AND "
                            "t.seed = s.seed" +
                            where(filter, "s.") + " ORDER BY s.design, s.purpose, s.source, s.pair",
                        [](const Cells& row) {
                          return DesignScore{.design = {row[0].integer()},
                                             .mission = row[1].text,
                                             .method = row[2].text,
                                             .repetition = row[3].integer(),
                                             .candidate = {row[4].integer()},
                                             .source = row[5].text,
                                             .purpose = row[6].text,
                                             .is_transfer = row[11].integer() != 0,
                                             .pair = row[7].integer(),
                                             .instance = row[8].integer(),
                                             .seed = row[9].integer(),
                                             .score = row[10].real()};
                        });
  if (!scores) return scores;
  // Programs never write such a score; no axis and no bin could contain it.
  const auto wrong = std::ranges::find_if(
      *scores, [](const DesignScore& score) { return !std::isfinite(score.score); });
  if (wrong == scores->end()) return scores;
  return unexpected(
      ErrorKind::Corrupt,
      fmt::format(
          "the score of {} on pair {} ({}) is not finite: another program changed the store",
          to_string(wrong->candidate), wrong->pair, wrong->purpose));
}

Expected<std::vector<DesignRecord>> designs(StoreReader& store, const RecordFilter& filter) {
  const auto flavour = flavour_column(store);
  if (!flavour) return Unexpected(flavour.error());
  return read<DesignRecord>(
      store,
      "SELECT d.design, d.mission, d.method, d.repetition, d.state, d.budget, d.used, d.iteration,"
      " d.best_candidate, d.best_mean, "  // a LEFT JOIN would compute all rows of v_candidates
      "coalesce((SELECT c.fsm_config FROM v_candidates AS c WHERE c.candidate = d.best_candidate),"
      " ''), " +
          *flavour + " FROM v_designs AS d" + where(filter, "d.") + " ORDER BY d.design",
      [](const Cells& row) {
        return DesignRecord{.design = {row[0].integer()},
                            .mission = row[1].text,
                            .method = row[2].text,
                            .repetition = row[3].integer(),
                            .state = row[4].text,
                            .budget = row[5].integer(),
                            .used = row[6].integer(),
                            .iteration = row[7].integer(),
                            .best = maybe_candidate(row[8]),
                            .best_mean = row[9].maybe_real(),
                            .machine = row[10].text,
                            .flavour = row[11].text};
      });
}

Expected<MachineRecord> candidate(StoreReader& store, CandidateId id) {
  const auto flavour = flavour_column(store);
  if (!flavour) return Unexpected(flavour.error());
  auto found = read<MachineRecord>(
      store,
      fmt::format(
          "SELECT c.candidate, c.design, d.mission, d.method, d.repetition, c.fsm_config, {}"
          " FROM v_candidates AS c JOIN v_designs AS d ON d.design = c.design"
          " WHERE c.candidate = {}",
          *flavour, id.value),
      [](const Cells& row) {
        return MachineRecord{.candidate = {row[0].integer()},
                             .design = {row[1].integer()},
                             .mission = row[2].text,
                             .method = row[3].text,
                             .repetition = row[4].integer(),
                             .machine = row[5].text,
                             .flavour = row[6].text};
      });
  if (!found) return Unexpected(found.error());
  if (found->empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate " + to_string(id));
  }
  return std::move(found->front());
}

Expected<std::vector<EliteRecord>> elites(StoreReader& store, const RecordFilter& filter) {
  return read<EliteRecord>(
      store,
      "SELECT e.design, e.iteration, e.rank, e.candidate, e.mean, e.n, e.experiments_used"
      " FROM v_convergence AS e JOIN v_designs AS d ON d.design = e.design" +
          where(filter, "d.") + " ORDER BY e.design, e.iteration, e.rank",
      [](const Cells& row) {
        return EliteRecord{.design = {row[0].integer()},
                           .iteration = row[1].integer(),
                           .rank = row[2].integer(),
                           .candidate = {row[3].integer()},
                           .mean = row[4].real(),
                           .runs = row[5].integer(),
                           .experiments_used = row[6].integer()};
      });
}

Expected<std::vector<ModuleFrequency>> module_frequencies(StoreReader& store,
                                                          const RecordFilter& filter) {
  const RecordFilter of_group{.mission = filter.mission, .method = filter.method};
  return read<ModuleFrequency>(
      store,
      "SELECT mission, method, module, avg_occurrences, occurrence_rate, avg_reachable,"
      " reachable_rate FROM v_module_frequency" +
          where(of_group) + " ORDER BY mission, method, module",
      [](const Cells& row) {
        ModuleFrequency frequency{
            .mission = row[0].text, .method = row[1].text, .module = row[2].text, .counts = {}};
        if (!row[3].is_null()) {
          frequency.counts = ModuleCounts{.average_occurrences = row[3].real(),
                                          .occurrence_rate = row[4].real(),
                                          .average_reachable = row[5].real(),
                                          .reachable_rate = row[6].real()};
        }
        return frequency;
      });
}

Expected<std::vector<RaceCell>> race_cells(StoreReader& store, DesignId design,
                                           std::int64_t iteration) {
  auto cells =
      read<RaceCell>(store,
                     fmt::format("SELECT step, pair, candidate, score, rank FROM v_race_matrix"
                                 " WHERE design = {} AND iteration = {} ORDER BY step, candidate",
                                 design.value, iteration),
                     [](const Cells& row) {
                       return RaceCell{.step = row[0].integer(),
                                       .pair = row[1].integer(),
                                       .candidate = {row[2].integer()},
                                       .score = row[3].maybe_real(),
                                       .rank = row[4].maybe_real()};
                     });
  if (!cells) return cells;
  if (auto judged = judge_cells(store, design, *cells); !judged) return Unexpected(judged.error());
  return cells;
}

std::string search_of(StoreReader& store, DesignId design) {
  const auto names = read<std::string>(
      store,
      fmt::format("SELECT j.value FROM v_designs AS d JOIN v_campaigns AS c ON c.campaign = "
                  "d.campaign JOIN json_each(nullif(c.deciding, '')) AS j ON j.key = 'method.' || "
                  "d.method || '.search' WHERE d.design = {}",
                  design.value),
      [](const Cells& row) { return row[0].text; });
  // Stores with old schemas, which only know races, lack a part of this.
  std::string name = !names || names->empty() ? "" : names->front();
  std::erase(name, '"');
  return name;
}

Expected<std::vector<IterationRecord>> iterations(StoreReader& store, DesignId design) {
  return read<IterationRecord>(
      store,
      fmt::format("SELECT iteration, planned, budget, configurations, postselection"
                  " FROM v_iterations WHERE design = {} ORDER BY iteration",
                  design.value),
      [](const Cells& row) {
        return IterationRecord{.iteration = row[0].integer(),
                               .planned = row[1].integer(),
                               .budget = row[2].integer(),
                               .configurations = row[3].integer(),
                               .postselection = row[4].integer() != 0};
      });
}

Expected<std::vector<SampledRecord>> candidates(StoreReader& store, DesignId design) {
  return read<SampledRecord>(
      store,
      fmt::format("SELECT candidate, iteration, runs, mean FROM v_candidates WHERE design = {}"
                  " ORDER BY candidate",
                  design.value),
      [](const Cells& row) {
        return SampledRecord{.candidate = {row[0].integer()},
                             .iteration = row[1].integer(),
                             .runs = row[2].integer(),
                             .mean = row[3].maybe_real()};
      });
}

Expected<std::vector<StepRecord>> race_steps(StoreReader& store, DesignId design,
                                             std::int64_t iteration) {
  return read<StepRecord>(
      store,
      fmt::format("SELECT s.step, s.iteration, s.pair, p.instance, p.seed, s.marker,"
                  " s.alive_before, s.alive_after, s.best, s.mean_best, s.used, s.statistic,"
                  " s.p_value FROM v_race_steps AS s LEFT JOIN pair AS p ON p.design = s.design"
                  " AND p.purpose = 0 AND p.number = s.pair"
                  " WHERE s.design = {} AND s.iteration = {} ORDER BY s.step",
                  design.value, iteration),
      [](const Cells& row) {
        return StepRecord{.step = row[0].integer(),
                          .iteration = row[1].integer(),
                          .pair = row[2].integer(),
                          .instance = maybe_integer(row[3]),
                          .seed = maybe_integer(row[4]),
                          .marker = row[5].text,
                          .alive_before = row[6].integer(),
                          .alive_after = row[7].integer(),
                          .best = maybe_candidate(row[8]),
                          .mean_best = row[9].real(),
                          .used = row[10].integer(),
                          .statistic = row[11].maybe_real(),
                          .p_value = row[12].maybe_real()};
      });
}

Expected<std::int64_t> last_raced_iteration(StoreReader& store, DesignId design) {
  const auto last = read<std::int64_t>(
      store, fmt::format("SELECT max(iteration) FROM v_race_steps WHERE design = {}", design.value),
      [](const Cells& row) { return row[0].integer(); });
  if (!last) return Unexpected(last.error());
  return last->front();
}

Expected<std::vector<EliminationRecord>> eliminations(StoreReader& store, DesignId design,
                                                      std::int64_t iteration) {
  return read<EliminationRecord>(
      store,
      fmt::format("SELECT candidate, iteration, step, reason FROM v_eliminations"
                  " WHERE design = {} AND iteration = {} ORDER BY step, candidate",
                  design.value, iteration),
      [](const Cells& row) {
        return EliminationRecord{.candidate = {row[0].integer()},
                                 .iteration = row[1].integer(),
                                 .step = row[2].integer(),
                                 .reason = row[3].text};
      });
}

Expected<std::vector<ParameterRecord>> parameters(StoreReader& store, DesignId design,
                                                  const std::vector<CandidateId>& candidates) {
  std::string among;
  for (const CandidateId candidate : candidates)
    among += fmt::format("{}{}", among.empty() ? "" : ",", candidate.value);
  if (!among.empty()) among = " AND candidate IN (" + among + ")";
  return read<ParameterRecord>(
      store,
      fmt::format("SELECT candidate, iteration, parameter, value FROM v_parameters"
                  " WHERE design = {}{}",
                  design.value, among),
      [](const Cells& row) {
        return ParameterRecord{
            .candidate = {row[0].integer()},
            .iteration = row[1].integer(),
            .parameter = row[2].text,
            .value = row[3].text,
            .is_number = row[3].type == Cell::Type::Integer || row[3].type == Cell::Type::Real};
      });
}

Expected<std::string> csv_of_rows(StoreReader& store, const std::string& sql) {
  std::string text;
  std::vector<std::string> texts;
  const auto end = store.query(
      sql, kRecordLimits,
      [&](const std::vector<std::string>& columns) { text += csv_line(columns); },
      [&](const std::vector<StoreReader::Cell>& cells) {
        texts.clear();
        for (const StoreReader::Cell& cell : cells)
          texts.push_back(cell.text);
        text += csv_line(texts);
      });
  if (!end) return Unexpected(end.error());
  if (end->truncated) return bad_input("reading took over 600 s", sql);
  return text;
}

}  // namespace swarmsmith
