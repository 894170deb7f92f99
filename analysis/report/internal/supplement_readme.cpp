#include "analysis/report/internal/supplement_readme.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/plain_text.h"
#include "base/shown_text.h"

namespace swarmsmith {
namespace {

/// A description of files whose paths have this beginning and end; `pattern` is their name in the
/// README.
struct Kind {
  std::string_view pattern;
  std::string_view begin;
  std::string_view end;
  std::string_view meaning;
};

constexpr Kind kKinds[] = {
    {"report.html", "report.html", "",
     "results, statistics, modules, winners, races, what was asked, provenance; opens in any "
     "browser, offline"},
    {"dashboard.html", "dashboard.html", "",
     "the dashboard with all races, machines, parameters and some runs of the winners; opens in "
     "any "
     "browser, offline"},
    {"designs/*.html", "designs/", ".html",
     "one page per design: its winner, race, elites, parameters"},
    {"results.csv", "results.csv", "",
     "one row per score that a winner got after its race: design, mission, method, repetition, "
     "candidate, source (the simulator's profile, `real`, ...), purpose, instance, seed, score"},
    {"p-values.csv", "p-values.csv", "",
     "one row per pair of sources or methods of a mission: the test, n, statistic, p value, the p "
     "value "
     "by Holm, effect size, difference of means with its bootstrap interval"},
    {"ranks.csv", "ranks.csv", "",
     "mean ranks of sources and methods over missions, with Friedman's test"},
    {"designs.csv", "designs.csv", "", "one row per design: budget, seed, winner, why it ended"},
    {"leaderboard.csv", "leaderboard.csv", "", "the winners, ranked by mission"},
    {"modules.csv", "modules.csv", "",
     "how often the winners of a mission and method have each module, in all states and in those "
     "that can be reached"},
    {"campaign*.toml", "campaign", ".toml",
     "what was asked: the campaign file, with all keys written out"},
    {"instances/*-starts.csv", "instances/", "-starts.csv",
     "where each robot started in each seed of a mission: metres, radians; `evaluate --starts` "
     "reads it"},
    {"instances/*-patches.csv", "instances/", "-patches.csv",
     "where the coloured patches lay in each seed: metres; `evaluate --patches` reads it"},
    {"controllers/*.txt", "controllers/", ".txt",
     "each design's winner as text: of AutoMoDe's grammar, a network's weights, or the switches of "
     "a program"},
    {"controllers/*.json", "controllers/", ".json", "the same with parameters, modules and scores"},
    {"controllers/*.svg", "controllers/", ".svg", "the same as a drawing"},
    {"controllers/*.csv", "controllers/", ".csv", "the same as a table"},
    {"controllers/*.dot", "controllers/", ".dot", "the same for Graphviz"},
    {"controllers/*.tex", "controllers/", ".tex", "the same as TikZ, for \\input"},
    {"figures/*.svg", "figures/", ".svg", "figures, fonts as text"},
    {"figures/*.csv", "figures/", ".csv", "the numbers that the figure of the same name shows"},
};

bool has(const std::vector<SupplementFile>& files, const Kind& kind) {
  return std::ranges::any_of(files, [&](const SupplementFile& file) {
    return file.path.starts_with(kind.begin) && file.path.ends_with(kind.end);
  });
}

std::string file_list(const std::vector<SupplementFile>& files, const SupplementOptions& options) {
  std::string text = "| file | is |\n| --- | --- |\n";
  for (const Kind& kind : kKinds) {
    if (!has(files, kind)) continue;
    text += fmt::format("| `{}` | {} |\n", kind.pattern, kind.meaning);
    if (options.with_pdfs && kind.end == ".svg") {
      const std::string_view stem = kind.pattern.substr(0, kind.pattern.size() - kind.end.size());
      text += fmt::format("| `{}.pdf` | the same as PDF |\n", stem);
    }
  }
  return text + "| `SHA256SUMS` | checksums of all other files |\n";
}

/// A campaign's name, escaped for Markdown.
std::string markdown_text(std::string_view text) {
  constexpr std::string_view kMarks = "\\`*_{}[]<>()#+-.!|&~";
  std::string marked;
  for (const char letter : as_shown(text, Layout::Escaped)) {
    if (kMarks.find(letter) != std::string_view::npos) marked += '\\';
    marked += letter;
  }
  return marked;
}

/// The versions of the engine that made the scores, by campaign.
std::string engine_versions(StoreReader& store) {
  std::vector<std::string> versions;
  const auto end = store.query(
      "SELECT DISTINCT json_extract(deciding, '$.\"engine.version\"') FROM v_campaigns"
      " WHERE json_extract(deciding, '$.\"engine.version\"') IS NOT NULL ORDER BY 1",
      {}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) { versions.push_back(cells[0].text); });
  if (!end || versions.empty()) return "";
  return fmt::format("Version of the engine that made the scores: {}.\n\n",
                     fmt::join(versions, ", "));
}

/// What `swarmsmith run` alone does not repeat: commands of users that are part of the answer, and
/// the rest of campaigns that were not finished.
std::string exceptions(StoreReader& store) {
  std::string text;
  for (const StoredCampaign& campaign : store.campaigns()) {
    if (campaign.state == "finished" || campaign.state == "imported") continue;
    text += fmt::format(
        "The campaign {} was not finished when this supplement was written ({}): the same command "
        "runs it to its end, so its results go beyond the ones here.\n",
        markdown_text(campaign.row.name), campaign.state);
  }
  std::vector<std::string> given;
  for (const CommandRow& command : store.commands()) {
    if (!command.step || !is_of_race(command.kind)) continue;
    const std::string design = command.design ? to_string(command.design) : "all designs";
    const std::string more =
        command.kind == CommandKind::Extend ? " by " + counted(command.budget, "experiment") : "";
    given.push_back(fmt::format("- `{}` {}{}, after step {} of the race\n", word_of(command.kind),
                                design, more, *command.step));
  }
  if (given.empty()) return text;
  return text + fmt::format(
                    "Users changed designs while they ran. The results depend on these commands, "
                    "and a run "
                    "without them gives other races and scores:\n\n{}\n",
                    fmt::join(given, ""));
}

}  // namespace

std::string supplement_readme(const std::vector<SupplementFile>& files,
                              const std::vector<CampaignRecord>& campaigns, StoreReader& store,
                              const SupplementOptions& options) {
  std::vector<std::string> names;
  std::string again;
  for (const CampaignRecord& campaign : campaigns) {
    names.push_back(markdown_text(campaign.name));
    if (campaign.file.empty()) continue;
    again += fmt::format("    swarmsmith run campaign{}.toml\n",
                         campaigns.size() == 1 ? "" : fmt::format("-{}", campaign.campaign));
  }
  std::string text = fmt::format(
      "# Supplement: {}\n\nWritten from a campaign's store by {} with `swarmsmith supplement STORE "
      "-o FOLDER`; the same store gives the same bytes. In every file a higher score is better.\n\n"
      "{}## Files\n\n{}\nFiles of controllers and figures have the design's number, mission, "
      "method "
      "and repetition in their names.\n\n## Check\n\n    sha256sum -c SHA256SUMS\n\nThe digest of "
      "the store's answer (`swarmsmith digest STORE`) is `{}`.\n\n",
      fmt::join(names, ", "), options.program, engine_versions(store), file_list(files, options),
      store.digest());
  if (again.empty()) return text;
  text += fmt::format(
      "## Again\n\n{}\nruns it again, with any number of workers, on any machine, to the same "
      "races and scores.\n",
      again);
  text += exceptions(store);
  const bool is_simulated = std::ranges::any_of(
      files, [](const SupplementFile& file) { return file.path.starts_with("instances/"); });
  if (is_simulated)
    text +=
        "`swarmsmith evaluate controllers/NAME.txt` gives a controller's scores of the tests "
        "again, "
        "with `--seeds 1-10` those on other seeds.\n";
  return text;
}

}  // namespace swarmsmith
