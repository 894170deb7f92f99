#include "cli/output/stored_stages.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"

namespace swarmsmith::cli {
namespace {

std::int64_t number(std::string_view text) {
  if (text.starts_with('d')) text.remove_prefix(1);
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The key is the campaign and the name of the method.
using MethodSearches = std::map<std::pair<std::string, std::string>, SearchOptions>;

Expected<MethodSearches> method_searches(StoreReader& store) {
  MethodSearches searches;
  const auto files = select(store, "SELECT campaign, file FROM v_campaigns");
  if (!files) return Unexpected(files.error());
  for (const auto& cells : files->cells) {
    // Campaign files with races only do not contain this key.
    if (cells[1].text.find("search") == std::string::npos) continue;
    const auto campaign = parse_campaign(cells[1].text, "the store's campaign file");
    if (!campaign) continue;
    for (const Method& method : campaign->methods) {
      if (kind_of(method.search) != SearchKind::Irace && method.baseline.empty())
        searches.emplace(std::pair(cells[0].text, method.name), method.search);
    }
  }
  return searches;
}

std::optional<std::size_t> place_of(const Rows& rows, std::string_view column) {
  const auto found = std::ranges::find(rows.columns, column);
  if (found == rows.columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.columns.begin());
}

/// `own` is a condition on the column design, or empty. It is inserted here because SQLite does not
/// push it into the subquery with GROUP BY.
std::string iterations_of(const std::string& own) {
  return "SELECT i.design, i.iteration, i.planned, i.postselection, i.configurations, i.budget, "
         "s.step, s.used, (SELECT alive_after FROM v_race_steps AS l WHERE l.design = i.design AND "
         "l.step = s.step) FROM (SELECT * FROM v_iterations" +
         own +
         ") AS i LEFT JOIN (SELECT design, iteration, max(step) AS step, max(used) AS used FROM "
         "v_race_steps" +
         own +
         " GROUP BY design, iteration) AS s ON s.design = i.design AND s.iteration = i.iteration "
         "ORDER BY i.design, i.iteration";
}

}  // namespace

Expected<StoredStages> StoredStages::read(StoreReader& store, std::optional<DesignId> only) {
  StoredStages stages;
  const auto searches = method_searches(store);
  if (!searches || searches->empty()) return stages;
  const std::string own = only ? " WHERE design = " + std::to_string(only->value) : "";
  const auto designs = select(
      store, "SELECT design, campaign, method, budget, used, iteration FROM v_designs" + own);
  if (!designs) return Unexpected(designs.error());
  for (const auto& cells : designs->cells) {
    const auto search = searches->find({cells[1].text, cells[2].text});
    if (search == searches->end()) continue;
    Design design{.search = search->second, .now = {}, .iterations = {}};
    design.now = {.iteration = number(cells[5].text),
                  .used = number(cells[4].text),
                  .budget = number(cells[3].text)};
    stages.designs_.emplace(number(cells[0].text), std::move(design));
  }
  const auto iterations = select(store, iterations_of(own), {.rows = 10'000'000});
  if (!iterations) return Unexpected(iterations.error());
  for (const auto& cells : iterations->cells) {
    const auto found = stages.designs_.find(number(cells[0].text));
    if (found == stages.designs_.end()) continue;
    Design& design = found->second;
    const SearchPoint before =
        design.iterations.empty() ? SearchPoint{} : design.iterations.rbegin()->second;
    SearchPoint point{.iteration = number(cells[1].text),
                      .iterations = number(cells[2].text),
                      .finals = before.finals + (before.is_final ? 1 : 0),
                      .is_final = cells[3].text == "1",
                      .configurations = number(cells[4].text),
                      .alive = number(cells[8].text),
                      .runs_wanted = number(cells[5].text),
                      .step = std::max(before.step, number(cells[6].text)),
                      .used = std::max(before.used, number(cells[7].text)),
                      .budget = design.now.budget};
    point.runs = point.used - before.used;
    if (point.alive == 0) point.alive = point.configurations;
    design.iterations.emplace(point.iteration, point);
    if (point.iteration == design.now.iteration) design.now = point;
  }
  return stages;
}

const StoredStages::Design* StoredStages::find(std::string_view design) const {
  const auto found = designs_.find(number(design));
  return found == designs_.end() ? nullptr : &found->second;
}

const SearchOptions* StoredStages::search(std::string_view design) const {
  const Design* known = find(design);
  return known == nullptr ? nullptr : &known->search;
}

std::string StoredStages::stage(std::string_view design, std::string_view iteration) const {
  const Design* known = find(design);
  if (known == nullptr) return iteration == "0" ? "" : "iteration " + std::string(iteration);
  return stage_text(known->search, known->now);
}

std::string StoredStages::part(std::string_view design, std::int64_t iteration,
                               bool with_size) const {
  const Design* known = find(design);
  if (known == nullptr) return "iteration " + std::to_string(iteration);
  const auto found = known->iterations.find(iteration);
  const SearchPoint point = found == known->iterations.end()
                                ? SearchPoint{.iteration = iteration, .budget = known->now.budget}
                                : found->second;
  return with_size ? swarmsmith::round_line(known->search, point)
                   : round_name(known->search, point);
}

std::string StoredStages::round(std::string_view design, std::string_view iteration) const {
  return part(design, number(iteration), false);
}

std::string StoredStages::round(std::string_view design) const {
  const Design* known = find(design);
  return known == nullptr ? "" : round_name(known->search, known->now);
}

std::string StoredStages::round_line(std::string_view design, std::int64_t iteration) const {
  return part(design, iteration, true);
}

bool StoredStages::is_final(std::string_view design, std::int64_t iteration) const {
  const Design* known = find(design);
  if (known == nullptr) return false;
  const auto found = known->iterations.find(iteration);
  return found != known->iterations.end() && found->second.is_final;
}

void StoredStages::tell(Rows& rows) const {
  const auto design = place_of(rows, "design");
  const auto iteration = place_of(rows, "iteration");
  if (empty() || !design || !iteration) return;
  const auto state = place_of(rows, "state");
  const auto reason = place_of(rows, "reason");
  rows.columns[*iteration] = "stage";
  for (auto& cells : rows.cells) {
    const std::string id = cells[*design].text;
    cells[*iteration] = {StoreReader::Cell::Type::Text, stage(id, cells[*iteration].text)};
    const SearchOptions* known = search(id);
    if (known != nullptr && state && cells[*state].text == "racing")
      cells[*state].text = words_of(*known).at_work;
    // The limit that ends a single race was not set by the user, so another reason is shown.
    if (known != nullptr && kind_of(*known) == SearchKind::FRace && reason &&
        cells[*reason].text == "limit of iterations") {
      cells[*reason].text = find(id)->now.alive == 1 ? "one configuration is left"
                                                     : "the next task does not fit into the budget";
    }
  }
}

void remove_column(Rows& rows, std::string_view name) {
  const auto place = place_of(rows, name);
  if (!place) return;
  const auto at = static_cast<std::ptrdiff_t>(*place);
  rows.columns.erase(rows.columns.begin() + at);
  for (auto& cells : rows.cells)
    cells.erase(cells.begin() + at);
}

void rename_column(Rows& rows, std::string_view from, std::string_view to) {
  if (const auto place = place_of(rows, from)) rows.columns[*place] = to;
}

}  // namespace swarmsmith::cli
