#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "analysis/comparison/comparison_tables.h"
#include "analysis/comparison/method_matrix.h"
#include "base/shown_text.h"
#include "base/text/csv.h"
#include "base/text/text_table.h"

namespace swarmsmith {
namespace {

/// The parts of a cell, each in its own column.
using Parts = std::array<std::string, 4>;

std::string shown(double value) {
  constexpr double kNoDecimalsFrom = 999.5;  // rounded to three digits, it has no decimals left
  return std::abs(value) < kNoDecimalsFrom ? fmt::format("{:.3g}", value)
                                           : fmt::format("{:.0f}", value);
}

Parts parts_of(const std::optional<MethodMatrix::Cell>& cell) {
  if (!cell) return {"-", "", "", ""};
  return {shown(cell->mean), cell->half_width ? "+- " + shown(*cell->half_width) : "",
          fmt::format("{:g}", cell->rank), cell->letters};
}

/// The cells of a mission, with their parts aligned below each other.
std::vector<std::string> column_of(const MethodMatrix& matrix, std::size_t mission) {
  std::vector<Parts> rows;
  std::array<std::size_t, 4> widths{};
  for (const MethodMatrix::Row& row : matrix.rows) {
    rows.push_back(parts_of(row.cells[mission]));
    for (std::size_t i = 0; i < widths.size(); ++i)
      widths[i] = std::max(widths[i], rows.back()[i].size());
  }
  std::vector<std::string> column = {matrix.missions[mission]};
  for (const Parts& parts : rows)
    column.push_back(padded(parts[0], widths[0], Align::Right) + " " +
                     padded(parts[1], widths[1], Align::Left) + " " +
                     padded(parts[2], widths[2], Align::Right) + " " + parts[3]);
  return column;
}

std::string csv_number(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

JsonPiece cell_json(const std::optional<MethodMatrix::Cell>& cell) {
  if (!cell) return {"null"};
  const double half = cell->half_width.value_or(0);
  const auto end = [&](double value) {
    return cell->half_width ? std::optional(value) : std::nullopt;
  };
  return {JsonObject()
              .add("n", cell->n)
              .add("runs", cell->runs)
              .add("mean", cell->mean)
              .add("low", end(cell->mean - half))
              .add("high", end(cell->mean + half))
              .add("rank", cell->rank)
              .add("letters", cell->letters)
              .add("behind", cell->behind)
              .add("p_behind", cell->p_behind)
              .text()};
}

}  // namespace

std::string matrices_text(const Comparison& comparison) {
  std::string text =
      fmt::format("Scores of the designs' winners, larger is better; {}.\n", comparison.said);
  for (const MethodMatrix& matrix : method_matrices(comparison)) {
    TextTable table{.aligns = std::vector<Align>(matrix.missions.size() + 2, Align::Left),
                    .rows = {{"method", "mean rank"}}};
    for (const MethodMatrix::Row& row : matrix.rows)
      table.rows.push_back(
          {row.method, row.mean_rank ? fmt::format("{:.2f}", *row.mean_rank) : "-"});
    for (std::size_t m = 0; m < matrix.missions.size(); ++m) {
      const auto column = column_of(matrix, m);
      for (std::size_t i = 0; i < column.size(); ++i)
        table.rows[i].push_back(column[i]);
    }
    text += fmt::format("\n{}\n{}", as_shown(matrix.source, Layout::Escaped),
                        aligned(std::move(table)));
  }
  text += fmt::format(
      "\nA cell: mean +- half its 95 % interval, rank, letters. Methods of a mission that share a "
      "letter do\nnot differ at 5 %: Wilcoxon rank-sum tests of its pairs, with Holm's correction. "
      "Each {} is a value.\n",
      name_of(comparison.unit));
  for (const std::string& note : matrix_notes(comparison))
    text += as_shown(note, Layout::Escaped) + "\n";
  return text;
}

std::string matrices_csv(const Comparison& comparison) {
  std::string csv =
      "source,mission,method,n,runs,mean,low,high,rank,mean_rank,letters,behind,p_behind\n";
  for (const MethodMatrix& matrix : method_matrices(comparison)) {
    for (std::size_t m = 0; m < matrix.missions.size(); ++m) {
      for (const MethodMatrix::Row& row : matrix.rows) {
        const auto& cell = row.cells[m];
        if (!cell) continue;
        const double half = cell->half_width.value_or(NAN);
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(matrix.source),
                           csv_field(matrix.missions[m]), csv_field(row.method), cell->n,
                           cell->runs, cell->mean, csv_number(cell->mean - half),
                           csv_number(cell->mean + half), cell->rank, csv_number(row.mean_rank),
                           cell->letters, cell->behind, csv_number(cell->p_behind));
      }
    }
  }
  return csv;
}

JsonPiece matrices_json(const Comparison& comparison) {
  return json_list(method_matrices(comparison), [](const MethodMatrix& matrix) {
    return JsonObject()
        .add("source", matrix.source)
        .add("missions", matrix.missions)
        .add("methods", json_list(matrix.rows, [](const MethodMatrix::Row& row) {
               return JsonObject()
                   .add("method", row.method)
                   .add("mean_rank", row.mean_rank)
                   .add("cells", json_list(row.cells, cell_json));
             }));
  });
}

}  // namespace swarmsmith
