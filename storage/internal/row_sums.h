#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "storage/internal/columns.h"
#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A hash of the cells of a row in order, by type and value. It finds damage, but is no protection
/// against changes on purpose.
class RowHash {
 public:
  RowHash& add(std::int64_t value) { return add(1, static_cast<std::uint64_t>(value)); }
  RowHash& add(std::uint64_t value) { return add(1, value); }
  RowHash& add(int value) { return add(static_cast<std::int64_t>(value)); }
  RowHash& add(bool value) { return add(static_cast<std::int64_t>(value)); }
  RowHash& add(double value) { return add(2, std::bit_cast<std::uint64_t>(value + 0.0)); }
  RowHash& add(const double* value) { return value != nullptr ? add(*value) : add(std::nullopt); }
  RowHash& add(std::nullopt_t) { return add(3, 0); }
  RowHash& add(std::string_view text);
  RowHash& add(const std::string& text) { return add(std::string_view(text)); }
  template <class T>
  RowHash& add(const std::optional<T>& value) {
    return value ? add(*value) : add(std::nullopt);
  }
  std::uint64_t value() const { return state_; }

  template <class... Cells>
  static std::uint64_t of(const Cells&... cells) {
    RowHash hash;
    (hash.add(cells), ...);
    return hash.value();
  }

 private:
  RowHash& add(std::uint64_t type, std::uint64_t bits) {
    state_ = mix64((state_ ^ bits) + type * 0x9e3779b97f4a7c15U);
    return *this;
  }

  std::uint64_t state_ = 0x243f6a8885a308d3U;
};

/// For each table of the answer, the number of its rows and a sum over them. Each commit writes
/// them, so if the rows of a file agree with them, its writer has committed this state: no other
/// program has changed, added or removed rows, and it is not a copy with some pages older than
/// others. SQLite's own checks find neither.
class RowSums {
 public:
  /// `Used`: the iterations of evaluations, which may change later.
  enum class Table {
    Candidate,
    Phrase,
    Source,
    Pair,
    Evaluation,
    Used,
    Iteration,
    RaceStep,
    Elimination,
    Elite,
    Totals,
    Design,
    Campaign,
    Command,
    RealRun,
    RealScore,
    RealOverride,
  };
  static constexpr std::size_t kTables = 17;
  /// Tables that are written when the store is at rest: they are counted again each time.
  static constexpr std::array kOfRealRuns{Table::RealRun, Table::RealScore, Table::RealOverride};

  void add(Table table, std::uint64_t hash) {
    ++of(table).rows;
    of(table).sum += hash;
  }
  void remove(Table table, std::uint64_t hash) {
    --of(table).rows;
    of(table).sum -= hash;
  }
  void replace(Table table, std::uint64_t old_hash, std::uint64_t hash) {
    of(table).sum += hash - old_hash;
  }

  /// The sums that the last commit wrote; empty in a store of a version without sums. A version
  /// with fewer tables has no sums for the others. Throws SqliteError.
  static std::optional<RowSums> stored(const sqlite::Connection& connection);
  /// The sums over the existing rows.
  static RowSums found(const sqlite::Connection& connection);
  /// Counts one table again.
  void count(const sqlite::Connection& connection, Table table);
  void write(const sqlite::Connection& connection) const;

  /// "evaluation (1190 rows, 1200 were committed), elite (other values)": how `found` differs from
  /// these sums; empty when they agree.
  std::string differences(const RowSums& found) const;

  /// Whether `found` has the same number of rows, but another sum.
  bool has_other_values(Table table, const RowSums& found) const;

  friend bool operator==(const RowSums&, const RowSums&) = default;

 private:
  struct Sum {
    std::int64_t rows = 0;
    std::uint64_t sum = 0;
    friend bool operator==(const Sum&, const Sum&) = default;
  };
  Sum& of(Table table) { return sums_[static_cast<std::size_t>(table)]; }
  const Sum& of(Table table) const { return sums_[static_cast<std::size_t>(table)]; }

  std::array<Sum, kTables> sums_{};
  std::size_t known_ = kTables;  ///< number of tables for which there are sums
};

inline std::int64_t half(std::uint64_t hash) {
  return static_cast<std::int64_t>(hash >> 32U);
}

/// An evaluation's column `row_check`: half of a hash of its cells, the columns of
/// kEvaluationColumns: what was evaluated, and its result.
template <class... Cells>
std::int64_t row_check(std::int64_t candidate, const Cells&... cells) {
  static_assert(sizeof...(cells) + 1 == kEvaluationColumns.size());
  RowHash hash;
  hash.add((candidate - 1) % kCandidatesPerDesign);
  std::size_t column = 1;
  ((kEvaluationColumns.columns[column++].is_checked ? void(hash.add(cells)) : void()), ...);
  return half(hash.value());
}
/// Removes evaluations that were changed after they were written. Returns how many.
std::int64_t remove_changed_evaluations(sqlite::Connection& connection);

/// The cells that the sum of a table covers: a SELECT without a condition.
std::string cells_of_rows(RowSums::Table table);
/// The hash of the current row of a statement of `cells_of_rows`.
std::uint64_t hash_of(const sqlite::Statement& row);

/// The end of a sentence about rows that are not the committed ones; empty when all are, or when
/// the store has no sums. Throws SqliteError.
std::string changed_rows(const sqlite::Connection& connection);

}  // namespace swarmsmith
