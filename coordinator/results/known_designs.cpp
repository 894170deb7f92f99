#include "coordinator/results/known_designs.h"

#include <algorithm>
#include <utility>

#include "base/text/csv.h"

namespace swarmsmith {
namespace {

using Cells = std::vector<StoreReader::Cell>;

Expected<std::vector<Cells>> rows_of(StoreReader& store, const std::string& sql) {
  std::vector<Cells> rows;
  const auto end = store.query(
      sql, {}, [](const auto&) {}, [&](const Cells& cells) { rows.push_back(cells); });
  if (!end) return Unexpected(end.error());
  return rows;
}

/// Schema 4 added these columns.
Expected<bool> has_names(StoreReader& store) {
  std::vector<std::string> columns;
  const auto end = store.query(
      "SELECT * FROM v_designs LIMIT 0", {},
      [&](const std::vector<std::string>& names) { columns = names; }, [](const auto&) {});
  if (!end) return Unexpected(end.error());
  return std::ranges::find(columns, "name") != columns.end();
}

}  // namespace

Expected<std::vector<KnownDesign>> known_designs(StoreReader& store) {
  const auto named = has_names(store);
  if (!named) return Unexpected(named.error());
  const auto rows =
      rows_of(store, "SELECT design, mission, method, repetition, state, best_candidate, " +
                         std::string(*named ? "name, flavour, campaign" : "'', '', 1") +
                         " FROM v_designs ORDER BY design");
  if (!rows) return Unexpected(rows.error());
  std::vector<KnownDesign> designs;
  for (const Cells& row : *rows) {
    designs.push_back({.id = {row[0].integer()},
                       .mission = row[1].text,
                       .method = row[2].text,
                       .repetition = row[3].integer(),
                       .name = row[6].text,
                       .flavour = row[7].text,
                       .campaign = row[8].integer(),
                       .finished = row[4].text == "finished",
                       .best = {row[5].integer()}});
  }
  return designs;
}

Expected<std::vector<std::string>> imported_digests(StoreReader& store) {
  const auto rows =
      rows_of(store, "SELECT digest FROM campaign WHERE state = 'imported' ORDER BY id");
  if (!rows) return Unexpected(rows.error());
  std::vector<std::string> digests;
  for (const Cells& row : *rows)
    digests.push_back(row.front().text);
  return digests;
}

Expected<bool> has_candidate(StoreReader& store, CandidateId candidate) {
  const auto rows = rows_of(store, "SELECT candidate FROM v_candidates WHERE candidate = " +
                                       std::to_string(candidate.value));
  if (!rows) return Unexpected(rows.error());
  return !rows->empty();
}

}  // namespace swarmsmith
