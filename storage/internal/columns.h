#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <tuple>

#include "storage/internal/schema.h"

namespace swarmsmith {

/// The columns of the tables of the answer, one list for each table, which the code that writes,
/// reads, sums and checks rows uses. tests/storage/columns_test.cpp compares them with the tables
/// of each schema.

struct StoredColumn {
  std::string_view name;
  std::int64_t since = 1;  ///< the schema that added it: NULL in stores of earlier ones
  /// Part of an evaluation's `row_check`, which covers the experiment and its result, but not the
  /// numbers that merging changes.
  bool is_checked = false;
};

template <std::size_t N>
struct TableColumns {
  std::string_view table;
  std::array<StoredColumn, N> columns;

  static constexpr std::size_t size() { return N; }

  /// The index of a column in the list; an unknown name does not compile.
  consteval int at(std::string_view name) const {
    for (std::size_t i = 0; i < N; ++i)
      if (columns[i].name == name) return static_cast<int>(i);
    throw "no such column";
  }

  /// "candidate, purpose, NULL": for a SELECT from a store of the given schema.
  std::string names(std::int64_t schema = kSchemaVersion) const {
    std::string text;
    for (const StoredColumn& column : columns) {
      if (!text.empty()) text += ", ";
      text += column.since <= schema ? column.name : "NULL";
    }
    return text;
  }

  /// "INSERT INTO pair (design, number) VALUES (?,?)", with further columns of the table.
  std::string insert(std::initializer_list<std::string_view> further = {}) const {
    std::string all = names();
    std::string marks = "?";
    for (std::size_t i = 1; i < N + further.size(); ++i)
      marks += ",?";
    for (const std::string_view column : further)
      all += ", " + std::string(column);
    return "INSERT INTO " + std::string(table) + " (" + all + ") VALUES (" + marks + ")";
  }
};

template <std::size_t N>
TableColumns(std::string_view, std::array<StoredColumn, N>) -> TableColumns<N>;

inline constexpr TableColumns kCandidateColumns{"candidate",
                                                std::to_array<StoredColumn>({{"id"},
                                                                             {"iteration"},
                                                                             {"parent"},
                                                                             {"states"},
                                                                             {"transitions"},
                                                                             {"modules"},
                                                                             {"machine"},
                                                                             {"parameters"},
                                                                             {"code", 4},
                                                                             {"module_code", 4}})};

inline constexpr TableColumns kPairColumns{
    "pair",
    std::to_array<StoredColumn>({{"design"}, {"purpose"}, {"number"}, {"instance"}, {"seed"}})};

/// Without `iteration`, which may change later, and `row_check`.
inline constexpr TableColumns kEvaluationColumns{
    "evaluation", std::to_array<StoredColumn>({{.name = "candidate", .is_checked = true},
                                               {.name = "purpose", .is_checked = true},
                                               {.name = "pair", .is_checked = true},
                                               {.name = "status", .is_checked = true},
                                               {.name = "score", .is_checked = true},
                                               {.name = "state_digest", .is_checked = true},
                                               {.name = "source"},
                                               {.name = "wall_us", .is_checked = true},
                                               {.name = "worker"},
                                               {.name = "attempt", .is_checked = true},
                                               {.name = "time", .since = 2, .is_checked = true},
                                               {.name = "bound", .since = 2, .is_checked = true}})};

/// The cells of these columns. `source` is the number of the row's source.
inline auto cells_of(const EvaluationRow& row, std::int64_t source) {
  const auto& [score, state_digest, wall_us, time] = row.measured;
  const std::tuple cells(row.key.candidate.value, static_cast<std::int64_t>(row.key.purpose),
                         row.key.pair, static_cast<std::int64_t>(row.status),
                         row.status == EvaluationStatus::Ok ? &score : nullptr, state_digest,
                         source, wall_us, row.worker, row.attempt, time == 0 ? nullptr : &time,
                         row.bound == 0 ? nullptr : &row.bound);
  static_assert(std::tuple_size_v<decltype(cells)> == kEvaluationColumns.size());
  return cells;
}

/// What was measured, in a row of these columns.
inline Measured measured_at(const sqlite::Statement& row) {
  constexpr auto& kAll = kEvaluationColumns;
  Measured measured;
  measured_fields(measured) =
      std::tuple(row.real(kAll.at("score")), row.bits(kAll.at("state_digest")),
                 row.integer(kAll.at("wall_us")), row.real(kAll.at("time")));
  return measured;
}

inline constexpr TableColumns kIterationColumns{
    "iteration", std::to_array<StoredColumn>({{"design"},
                                              {"number"},
                                              {"planned"},
                                              {"budget"},
                                              {"configurations"},
                                              {"elites"},
                                              {"soft_restart"},
                                              {"model_digest"},
                                              {"postselection", 2}})};

inline constexpr TableColumns kRaceStepColumns{"race_step",
                                               std::to_array<StoredColumn>({{"design"},
                                                                            {"step"},
                                                                            {"iteration"},
                                                                            {"pair"},
                                                                            {"marker"},
                                                                            {"evaluated"},
                                                                            {"alive_before"},
                                                                            {"alive_after"},
                                                                            {"best"},
                                                                            {"mean_best"},
                                                                            {"used"},
                                                                            {"statistic"},
                                                                            {"p_value"},
                                                                            {"kendall_w"},
                                                                            {"spearman_rho"},
                                                                            {"qvar"},
                                                                            {"digest"},
                                                                            {"bound", 2}})};

inline constexpr TableColumns kEliminationColumns{
    "elimination", std::to_array<StoredColumn>(
                       {{"candidate"}, {"iteration"}, {"step"}, {"rank_sum"}, {"reason"}})};

inline constexpr TableColumns kEliteColumns{
    "elite", std::to_array<StoredColumn>(
                 {{"design"}, {"iteration"}, {"rank"}, {"candidate"}, {"mean"}, {"runs"}})};

inline constexpr TableColumns kTotalsColumns{
    "candidate_totals",
    std::to_array<StoredColumn>({{"candidate"}, {"runs"}, {"score_sum"}, {"score_squares"}})};

/// The columns that the design's search updates; the others are written once.
inline constexpr TableColumns kDesignStateColumns{
    "design",
    std::to_array<StoredColumn>(
        {{"id"}, {"state"}, {"used"}, {"iteration"}, {"best"}, {"best_mean"}, {"reason"}})};

inline constexpr TableColumns kCommandColumns{
    "command",
    std::to_array<StoredColumn>(
        {{"number", 3}, {"kind", 3}, {"design", 3}, {"step", 3}, {"budget", 3}, {"who", 3}})};

}  // namespace swarmsmith
