#include "storage/internal/row_sums.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "storage/internal/columns.h"

namespace swarmsmith {
namespace {

using sqlite::Statement;

constexpr std::string_view kKey = "row_sums";
constexpr std::size_t kAlwaysSummed = 14;  ///< number of tables in the first version with sums

struct Summed {
  std::string_view table;
  std::string cells;
  std::string_view rest = "";
};

template <std::size_t N>
Summed all_of(const TableColumns<N>& columns) {
  return {columns.table, columns.names()};
}

/// The cells of each table, in the order of RowSums::Table. Rows that are written once count with
/// all their columns.
const Summed& summed(std::size_t table) {
  static const std::array<Summed, RowSums::kTables> kSummed{{
      all_of(kCandidateColumns),
      {"phrase", "id, machine, parameters, modules"},
      {"source", "id, name"},
      all_of(kPairColumns),
      all_of(kEvaluationColumns),
      {"evaluation", "candidate, purpose, pair, iteration", " WHERE iteration IS NOT NULL"},
      all_of(kIterationColumns),
      all_of(kRaceStepColumns),
      all_of(kEliminationColumns),
      all_of(kEliteColumns),
      all_of(kTotalsColumns),
      all_of(kDesignStateColumns),
      {"campaign", "id, state"},
      all_of(kCommandColumns),
      {"real_run", "*"},
      {"real_score", "*"},
      {"real_override", "*"},
  }};
  return kSummed[table];
}

/// The hash of the first `columns` columns.
std::uint64_t hash_of(const Statement& row, int columns) {
  RowHash hash;
  for (int column = 0; column < columns; ++column) {
    switch (sqlite3_column_type(row.handle(), column)) {
      case SQLITE_NULL:
        hash.add(std::nullopt);
        break;
      case SQLITE_INTEGER:
        hash.add(row.integer(column));
        break;
      case SQLITE_FLOAT:
        hash.add(row.real(column));
        break;
      default: {
        const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row.handle(), column));
        const int size = sqlite3_column_bytes(row.handle(), column);
        hash.add(std::string_view(bytes == nullptr ? "" : bytes, static_cast<std::size_t>(size)));
      }
    }
  }
  return hash.value();
}

}  // namespace

RowHash& RowHash::add(std::string_view text) {
  add(4, text.size());
  for (std::size_t at = 0; at < text.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data() + at, std::min(sizeof word, text.size() - at));
    add(5, word);
  }
  return *this;
}

std::string cells_of_rows(RowSums::Table table) {
  const Summed& all = summed(static_cast<std::size_t>(table));
  return fmt::format("SELECT {} FROM {}{}", all.cells, all.table, all.rest);
}

std::uint64_t hash_of(const Statement& row) {
  return hash_of(row, sqlite3_column_count(row.handle()));
}

std::optional<RowSums> RowSums::stored(const sqlite::Connection& connection) {
  Statement row(connection, "SELECT value FROM meta WHERE key = ?");
  row.bind(kKey);
  if (!row.step()) return std::nullopt;
  const std::string text = row.text(0);
  RowSums sums;
  const char* at = text.data();
  const char* const end = at + text.size();
  // "1200 8f2a... 17 90ab...": a number of rows and a sum, table by table.
  sums.known_ = 0;
  for (Sum& sum : sums.sums_) {
    if (at == end && sums.known_ >= kAlwaysSummed) break;
    const auto rows = std::from_chars(at, end, sum.rows);
    if (rows.ec != std::errc() || rows.ptr == end) return RowSums();
    const auto hash = std::from_chars(rows.ptr + 1, end, sum.sum, 16);
    if (hash.ec != std::errc()) return RowSums();
    at = hash.ptr == end ? end : hash.ptr + 1;
    ++sums.known_;
  }
  return sums;
}

RowSums RowSums::found(const sqlite::Connection& connection) {
  RowSums sums;
  for (std::size_t i = 0; i < kTables; ++i)
    sums.count(connection, static_cast<Table>(i));
  return sums;
}

void RowSums::count(const sqlite::Connection& connection, Table table) {
  of(table) = {};
  Statement row(connection, cells_of_rows(table));
  while (row.step())
    add(table, hash_of(row));
}

void RowSums::write(const sqlite::Connection& connection) const {
  std::string text;
  for (const Sum& sum : sums_)
    text += fmt::format("{}{} {:016x}", text.empty() ? "" : " ", sum.rows, sum.sum);
  Statement(connection, "INSERT OR REPLACE INTO meta VALUES (?,?)").run(kKey, text);
}

std::string RowSums::differences(const RowSums& found) const {
  std::string text;
  for (std::size_t i = 0; i < known_; ++i) {
    if (sums_[i] == found.sums_[i]) continue;
    if (i == static_cast<std::size_t>(Table::Used) && text.find("evaluation") != std::string::npos)
      continue;
    text += fmt::format("{}{} (", text.empty() ? "" : ", ", summed(i).table);
    text += sums_[i].rows == found.sums_[i].rows
                ? "other values)"
                : fmt::format("{} for {})", counted(found.sums_[i].rows, "row"), sums_[i].rows);
  }
  return text;
}

bool RowSums::has_other_values(Table table, const RowSums& found) const {
  return static_cast<std::size_t>(table) < known_ && of(table).rows == found.of(table).rows &&
         of(table).sum != found.of(table).sum;
}

std::int64_t remove_changed_evaluations(sqlite::Connection& connection) {
  using Key = std::array<std::int64_t, 3>;
  std::vector<Key> changed;
  std::string checked = fmt::format("(candidate - 1) % {}", kCandidatesPerDesign);
  for (const StoredColumn& column : kEvaluationColumns.columns)
    if (column.is_checked && column.name != "candidate") checked += ", " + std::string(column.name);
  Statement row(connection, "SELECT " + checked +
                                ", row_check, candidate FROM evaluation"
                                " WHERE row_check IS NOT NULL");
  while (row.step()) {
    const int last = sqlite3_column_count(row.handle()) - 1;
    if (half(hash_of(row, last - 1)) != row.integer(last - 1))
      changed.push_back({row.integer(last), row.integer(1), row.integer(2)});
  }
  Statement removal(connection,
                    "DELETE FROM evaluation WHERE candidate = ? AND purpose = ? AND pair = ?");
  for (const auto& [candidate, purpose, pair] : changed)
    removal.run(candidate, purpose, pair);
  return static_cast<std::int64_t>(changed.size());
}

std::string changed_rows(const sqlite::Connection& connection) {
  const auto stored = RowSums::stored(connection);
  if (!stored) return {};
  const std::string differences = stored->differences(RowSums::found(connection));
  if (differences.empty()) return {};
  return "its rows are not those that were committed last: " + differences +
         "; another program has changed them, or the file is a copy that was made while a campaign "
         "wrote the store (`swarmsmith backup` makes whole ones)";
}

}  // namespace swarmsmith
