#include "analysis/records/records.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace swarmsmith {
namespace {

using Cell = StoreReader::Cell;
using Cells = std::vector<Cell>;

double real(const Cell& cell) {
  double value = 0;
  std::from_chars(cell.text.data(), cell.text.data() + cell.text.size(), value);
  return value;
}

std::int64_t integer(const Cell& cell) {
  std::int64_t value = 0;
  std::from_chars(cell.text.data(), cell.text.data() + cell.text.size(), value);
  return value;
}

bool is_null(const Cell& cell) {
  return cell.type == Cell::Type::Null;
}

std::optional<double> maybe_real(const Cell& cell) {
  return is_null(cell) ? std::nullopt : std::optional(real(cell));
}

std::optional<CandidateId> maybe_candidate(const Cell& cell) {
  return is_null(cell) ? std::nullopt : std::optional(CandidateId{integer(cell)});
}

/// " WHERE ..." over the columns mission, method and design of `table`.
std::string where(const RecordFilter& filter, std::string_view table = "") {
  std::vector<std::string> terms;
  if (!filter.mission.empty())
    terms.push_back(fmt::format("{}mission = {}", table, sql_text(filter.mission)));
  if (!filter.method.empty())
    terms.push_back(fmt::format("{}method = {}", table, sql_text(filter.method)));
  if (filter.design) terms.push_back(fmt::format("{}design = {}", table, filter.design->value));
  return terms.empty() ? "" : fmt::format(" WHERE {}", fmt::join(terms, " AND "));
}

/// What stands for the flavour of a design `d`: stores of a schema before 4 do not have it.
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

}  // namespace

Expected<std::vector<CampaignRecord>> campaigns(StoreReader& store) {
  return read<CampaignRecord>(
      store,  // An imported one has no file that could be run.
      "SELECT campaign, name, seed, digest, iif(state = 'imported', '', file) FROM v_campaigns "
      "ORDER BY campaign",
      [](const Cells& row) {
        return CampaignRecord{.campaign = integer(row[0]),
                              .name = row[1].text,
                              .seed = integer(row[2]),
                              .digest = row[3].text,
                              .file = row[4].text};
      });
}

Expected<std::vector<DesignScore>> design_scores(StoreReader& store, const RecordFilter& filter) {
  auto scores = read<DesignScore>(store,
                                  "SELECT design, mission, method, repetition, candidate, source, "
                                  "purpose, pair, instance, seed,"
                                  " score FROM v_design_scores" +
                                      where(filter) + " ORDER BY design, purpose, source, pair",
                                  [](const Cells& row) {
                                    return DesignScore{.design = {integer(row[0])},
                                                       .mission = row[1].text,
                                                       .method = row[2].text,
                                                       .repetition = integer(row[3]),
                                                       .candidate = {integer(row[4])},
                                                       .source = row[5].text,
                                                       .purpose = row[6].text,
                                                       .pair = integer(row[7]),
                                                       .instance = integer(row[8]),
                                                       .seed = integer(row[9]),
                                                       .score = real(row[10])};
                                  });
  if (!scores) return scores;
  // No program writes such a score; no axis and no bin could hold it.
  const auto wrong = std::ranges::find_if(
      *scores, [](const DesignScore& score) { return !std::isfinite(score.score); });
  if (wrong == scores->end()) return scores;
  return unexpected(ErrorKind::Corrupt,
                    fmt::format("the score of {} on pair {} ({}) is not finite: the store was "
                                "changed by something else",
                                to_string(wrong->candidate), wrong->pair, wrong->purpose));
}

Expected<std::vector<DesignRecord>> designs(StoreReader& store, const RecordFilter& filter) {
  const auto flavour = flavour_column(store);
  if (!flavour) return Unexpected(flavour.error());
  return read<DesignRecord>(
      store,
      "SELECT d.design, d.mission, d.method, d.repetition, d.state, d.budget, d.used, d.iteration,"
      " d.best_candidate, d.best_mean, "  // a LEFT JOIN would make all rows of v_candidates
      "coalesce((SELECT c.fsm_config FROM v_candidates AS c WHERE c.candidate = d.best_candidate),"
      " ''), " +
          *flavour + " FROM v_designs AS d" + where(filter, "d.") + " ORDER BY d.design",
      [](const Cells& row) {
        return DesignRecord{.design = {integer(row[0])},
                            .mission = row[1].text,
                            .method = row[2].text,
                            .repetition = integer(row[3]),
                            .state = row[4].text,
                            .budget = integer(row[5]),
                            .used = integer(row[6]),
                            .iteration = integer(row[7]),
                            .best = maybe_candidate(row[8]),
                            .best_mean = maybe_real(row[9]),
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
        return MachineRecord{.candidate = {integer(row[0])},
                             .design = {integer(row[1])},
                             .mission = row[2].text,
                             .method = row[3].text,
                             .repetition = integer(row[4]),
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
        return EliteRecord{.design = {integer(row[0])},
                           .iteration = integer(row[1]),
                           .rank = integer(row[2]),
                           .candidate = {integer(row[3])},
                           .mean = real(row[4]),
                           .runs = integer(row[5]),
                           .experiments_used = integer(row[6])};
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
        if (!is_null(row[3])) {
          frequency.counts = ModuleCounts{.average_occurrences = real(row[3]),
                                          .occurrence_rate = real(row[4]),
                                          .average_reachable = real(row[5]),
                                          .reachable_rate = real(row[6])};
        }
        return frequency;
      });
}

Expected<std::vector<RaceCell>> race_cells(StoreReader& store, DesignId design,
                                           std::int64_t iteration) {
  return read<RaceCell>(
      store,
      fmt::format("SELECT step, pair, instance, seed, candidate, score, rank FROM v_race_matrix"
                  " WHERE design = {} AND iteration = {} ORDER BY step, candidate",
                  design.value, iteration),
      [](const Cells& row) {
        return RaceCell{.step = integer(row[0]),
                        .pair = integer(row[1]),
                        .instance = integer(row[2]),
                        .seed = integer(row[3]),
                        .candidate = {integer(row[4])},
                        .score = maybe_real(row[5]),
                        .rank = maybe_real(row[6])};
      });
}

std::string search_of(StoreReader& store, DesignId design) {
  const auto names = read<std::string>(
      store,
      fmt::format("SELECT j.value FROM v_designs AS d JOIN v_campaigns AS c ON c.campaign = "
                  "d.campaign JOIN json_each(nullif(c.deciding, '')) AS j ON j.key = 'method.' || "
                  "d.method || '.search' WHERE d.design = {}",
                  design.value),
      [](const Cells& row) { return row[0].text; });
  // Stores of old schemas, which know of races alone, miss some of it.
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
        return IterationRecord{.iteration = integer(row[0]),
                               .planned = integer(row[1]),
                               .budget = integer(row[2]),
                               .configurations = integer(row[3]),
                               .postselection = integer(row[4]) != 0};
      });
}

Expected<std::vector<SampledRecord>> candidates(StoreReader& store, DesignId design) {
  return read<SampledRecord>(
      store,
      fmt::format("SELECT candidate, iteration, runs, mean FROM v_candidates WHERE design = {}"
                  " ORDER BY candidate",
                  design.value),
      [](const Cells& row) {
        return SampledRecord{.candidate = {integer(row[0])},
                             .iteration = integer(row[1]),
                             .runs = integer(row[2]),
                             .mean = maybe_real(row[3])};
      });
}

Expected<std::vector<StepRecord>> race_steps(StoreReader& store, DesignId design) {
  return read<StepRecord>(
      store,
      fmt::format(
          "SELECT step, iteration, pair, marker, alive_before, alive_after, best, mean_best,"
          " used, statistic, p_value FROM v_race_steps WHERE design = {} ORDER BY step",
          design.value),
      [](const Cells& row) {
        return StepRecord{.step = integer(row[0]),
                          .iteration = integer(row[1]),
                          .pair = integer(row[2]),
                          .marker = row[3].text,
                          .alive_before = integer(row[4]),
                          .alive_after = integer(row[5]),
                          .best = maybe_candidate(row[6]),
                          .mean_best = real(row[7]),
                          .used = integer(row[8]),
                          .statistic = maybe_real(row[9]),
                          .p_value = maybe_real(row[10])};
      });
}

Expected<std::vector<EliminationRecord>> eliminations(StoreReader& store, DesignId design) {
  return read<EliminationRecord>(
      store,
      fmt::format("SELECT candidate, iteration, step, reason FROM v_eliminations"
                  " WHERE design = {} ORDER BY iteration, step, candidate",
                  design.value),
      [](const Cells& row) {
        return EliminationRecord{.candidate = {integer(row[0])},
                                 .iteration = integer(row[1]),
                                 .step = integer(row[2]),
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
            .candidate = {integer(row[0])},
            .iteration = integer(row[1]),
            .parameter = row[2].text,
            .value = row[3].text,
            .is_number = row[3].type == Cell::Type::Integer || row[3].type == Cell::Type::Real};
      });
}

}  // namespace swarmsmith
