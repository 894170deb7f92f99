#include "analysis/report/supplement.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "analysis/comparison/comparison.h"
#include "analysis/comparison/comparison_tables.h"
#include "analysis/figures/figure.h"
#include "analysis/records/records.h"
#include "analysis/report/internal/draft.h"
#include "analysis/report/internal/supplement_readme.h"
#include "analysis/report/report.h"

namespace swarmsmith {
namespace {

using Files = std::vector<SupplementFile>;

/// Kinds that show one design; the other kinds compare designs.
constexpr std::array<std::string_view, 4> kOfOneDesign = {"race", "sampling", "parallel",
                                                          "importance"};
constexpr std::string_view kMachineKind = "machine";

/// "d3-aggregation-watermelon-1"; characters that are unsuitable for file names become "_".
std::string file_name_of(const DesignRecord& design) {
  std::string name = fmt::format("{}-{}-{}-{}", to_string(design.design), design.mission,
                                 design.method, design.repetition);
  for (char& letter : name) {
    const bool is_plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                          (letter >= '0' && letter <= '9') || letter == '.' || letter == '-';
    if (!is_plain) letter = '_';
  }
  return name;
}

/// One JSON object, made by SQLite from the views.
Expected<std::string> machine_json(StoreReader& store, const DesignRecord& design) {
  std::string text;
  const auto end = store.query(
      fmt::format(
          "SELECT json_object('design', 'd' || d.design, 'mission', d.mission, 'method', d.method, "
          "'repetition', d.repetition, 'candidate', 'c' || c.candidate, 'flavour', d.flavour, "
          "'mean_in_race', c.mean, 'runs_in_race', c.runs, 'fsm_config', c.fsm_config, "
          "'parameters', json(iif(c.parameters = '', '{{}}', c.parameters)), "
          "'modules', json(iif(c.modules = '', '{{}}', c.modules))) FROM v_designs AS d "
          "JOIN v_candidates AS c ON c.candidate = d.best_candidate WHERE d.design = {}",
          design.design.value),
      {}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) { text = cells.front().text; });
  if (!end) return Unexpected(end.error());
  return text + "\n";
}

/// Adds the figure and its numbers, if the store has data for it.
Expected<void> add_figure(Files& files, StoreReader& store, const FigureKind& kind,
                          const FigureOptions& options, const std::string& path,
                          const SupplementOptions& asked) {
  if (asked.progress) asked.progress(files.size());
  const auto figure = kind.make(store, options);
  if (!figure) {
    const ErrorKind error = figure.error().kind;
    if (error == ErrorKind::NotFound || error == ErrorKind::BadInput) return {};
    return Unexpected(figure.error());
  }
  files.push_back({path + ".svg", figure->svg});
  if (!figure->csv.empty()) files.push_back({path + ".csv", figure->csv});
  if (!figure->tex.empty()) files.push_back({path + ".tex", figure->tex});
  if (!figure->dot.empty()) files.push_back({path + ".dot", figure->dot});
  return {};
}

Expected<void> add_controllers(Files& files, StoreReader& store, const SupplementOptions& asked,
                               const std::vector<DesignRecord>& all) {
  const FigureKind* drawn = find_figure_kind(kMachineKind);
  for (const DesignRecord& design : all) {
    const std::string path = "controllers/" + file_name_of(design);
    auto text = asked.machine_file(*design.best);
    if (!text) return Unexpected(text.error());
    files.push_back({path + ".txt", std::move(*text)});
    auto json = machine_json(store, design);
    if (!json) return Unexpected(json.error());
    files.push_back({path + ".json", std::move(*json)});
    if (drawn == nullptr || design.flavour.empty()) continue;
    const FigureOptions options{.width_mm = kWholeWidth, .candidate = design.best};
    if (auto added = add_figure(files, store, *drawn, options, path, asked); !added) return added;
  }
  return {};
}

Expected<void> add_figures(Files& files, StoreReader& store, const SupplementOptions& asked,
                           const std::vector<DesignRecord>& all) {
  std::set<std::string> missions;
  for (const DesignRecord& design : all)
    missions.insert(design.mission);
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name == kMachineKind) continue;
    const std::string path = "figures/" + std::string(kind.name);
    if (std::ranges::find(kOfOneDesign, kind.name) != kOfOneDesign.end()) {
      for (const DesignRecord& design : all) {
        const FigureOptions options{.filter = {.design = design.design}, .width_mm = kWholeWidth};
        const std::string name = path + "-" + file_name_of(design);
        if (auto added = add_figure(files, store, kind, options, name, asked); !added) return added;
      }
      continue;
    }
    if (auto added = add_figure(files, store, kind, {.width_mm = kWholeWidth}, path, asked); !added)
      return added;
    if (missions.size() < 2) continue;
    for (const std::string& mission : missions) {
      const FigureOptions options{.filter = {.mission = mission}, .width_mm = kColumnWidth};
      if (refused_option(kind, options)) continue;
      if (auto added = add_figure(files, store, kind, options, path + "-" + mission, asked); !added)
        return added;
    }
  }
  return {};
}

/// Tests of sources and of methods, below one header.
Expected<void> add_comparisons(Files& files, StoreReader& store) {
  const auto scores = design_scores(store, {});
  if (!scores) return Unexpected(scores.error());
  const Comparison sources = compare(*scores, {.by = CompareBy::Source});
  const Comparison methods = compare(*scores, {.by = CompareBy::Method});
  const std::string of_methods = pairs_csv(methods);
  std::vector<ComparedRanks> ranks = sources.ranks;
  ranks.insert(ranks.end(), methods.ranks.begin(), methods.ranks.end());
  files.push_back(
      {"p-values.csv", pairs_csv(sources) + of_methods.substr(of_methods.find('\n') + 1)});
  files.push_back({"ranks.csv", ranks_csv(ranks)});
  return {};
}

std::string page_of(const DesignRecord& design) {
  return "designs/" + file_name_of(design) + ".html";
}

/// The report, and the pages of designs to which it links.
Expected<void> add_report(Files& files, StoreReader& store, const SupplementOptions& asked,
                          const std::vector<DesignRecord>& all) {
  const ReportOptions options{.program = asked.program,
                              .runs_from_above = asked.runs_from_above,
                              .progress = {},
                              .page_of_design = page_of};
  auto report = html_report(store, options);
  if (!report) return Unexpected(report.error());
  files.push_back({"report.html", std::move(*report)});
  for (const DesignRecord& design : all) {
    if (asked.progress) asked.progress(files.size());
    auto page = design_page(store, design, options);
    if (!page) return Unexpected(page.error());
    files.push_back({page_of(design), std::move(*page)});
  }
  return {};
}

/// A complete table of the store.
struct TableFile {
  const char* path;
  const char* sql;
};
constexpr std::array<TableFile, 4> kTables = {{
    {"results.csv", "SELECT * FROM v_design_scores ORDER BY design, purpose, source, pair"},
    {"designs.csv", "SELECT * FROM v_designs ORDER BY design"},
    {"leaderboard.csv", "SELECT * FROM v_leaderboard ORDER BY mission, rank, design"},
    {"modules.csv", "SELECT * FROM v_module_frequency ORDER BY mission, method, module"},
}};

}  // namespace

Expected<std::vector<SupplementFile>> supplement(StoreReader& store,
                                                 const SupplementOptions& options) {
  auto all = designs(store, {});
  if (!all) return Unexpected(all.error());
  std::erase_if(*all, [](const DesignRecord& design) { return !design.best; });
  if (all->empty()) {
    return unexpected(
        ErrorKind::NotFound,
        "no design of the store has a best machine yet; `swarmsmith status` shows how "
        "far it is");
  }
  Files files;
  for (const TableFile& table : kTables) {
    auto text = csv_of_rows(store, table.sql);
    if (!text) return Unexpected(text.error());
    files.push_back({table.path, std::move(*text)});
  }
  if (auto added = add_comparisons(files, store); !added) return Unexpected(added.error());
  if (auto added = add_controllers(files, store, options, *all); !added)
    return Unexpected(added.error());
  if (auto added = add_figures(files, store, options, *all); !added)
    return Unexpected(added.error());
  if (auto added = add_report(files, store, options, *all); !added)
    return Unexpected(added.error());
  const auto asked = campaigns(store);
  if (!asked) return Unexpected(asked.error());
  for (const CampaignRecord& campaign : *asked) {
    const std::string number = asked->size() == 1 ? "" : fmt::format("-{}", campaign.campaign);
    // Imported results have no campaign file.
    if (!campaign.file.empty()) files.push_back({"campaign" + number + ".toml", campaign.file});
  }
  if (options.instance_tables) {
    auto tables = options.instance_tables();
    if (!tables) return Unexpected(tables.error());
    std::ranges::move(*tables, std::back_inserter(files));
  }
  if (options.dashboard) {
    auto page = options.dashboard();
    if (!page) return Unexpected(page.error());
    files.push_back({"dashboard.html", std::move(*page)});
  }
  files.push_back({"README.md", supplement_readme(files, *asked, store, options)});
  std::ranges::sort(files, {}, &SupplementFile::path);
  return files;
}

}  // namespace swarmsmith
