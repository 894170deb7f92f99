#include "cli/dashboard/snapshot.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "base/base64.h"
#include "base/text/gzip.h"
#include "base/text/json.h"
#include "cli/dashboard/dashboard.h"
#include "cli/output/query_output.h"
#include "coordinator/service/http_site.h"
#include "storage/store.h"
#include "web/pages.h"

namespace swarmsmith::cli {
namespace {

constexpr std::size_t kMostCode = std::size_t{4} << 20U;
/// Number of runs per winner; each is simulated again and takes some 20 kB.
constexpr int kTestRuns = 3;
constexpr int kRaceRuns = 1;

using Parameters = std::vector<std::pair<std::string, std::string>>;

struct Path {
  std::string path;  ///< below api/v1/
  Parameters parameters{};
};

/// Encoded as in the pages (encodeURIComponent).
std::string encoded(std::string_view text) {
  constexpr std::string_view kPlain = "-_.!~*'()";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string result;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    const bool plain = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
                       (letter >= 'A' && letter <= 'Z') ||
                       kPlain.find(letter) != std::string_view::npos;
    if (plain) {
      result += letter;
    } else {
      result += '%';
      result += kDigits[code >> 4U];
      result += kDigits[code & 15U];
    }
  }
  return result;
}

std::string key_of(const Path& path) {
  std::string key = path.path;
  for (std::size_t i = 0; i < path.parameters.size(); ++i)
    key +=
        (i == 0 ? "?" : "&") + path.parameters[i].first + "=" + encoded(path.parameters[i].second);
  return key;
}

/// The questions of the pages, in the order in which they are asked.
class Paths {
 public:
  explicit Paths(StoreReader& store) : store_(store) {}

  /// Questions about the store as a whole.
  Expected<void> add_store() {
    for (const char* path :
         {"live", "workers", "c1", "c1/events", "c1/convergence", "c1/scores", "c1/leaderboard",
          "c1/modules", "c1/real-runs", "c1/comparison/matrix"})
      add({path});
    add_figure("convergence", {});
    const auto missions = column("SELECT DISTINCT mission FROM v_designs ORDER BY mission");
    if (!missions) return Unexpected(missions.error());
    std::vector<std::string> shown = *missions;
    shown.insert(shown.begin(), "");
    for (const std::string& mission : shown) {
      for (const char* kind : {"box", "ranks", "scores"}) {
        for (const char* by : {"method", "source"})
          add_figure(kind, with_mission({{"by", by}}, mission));
      }
      for (const char* by : {"method", "source"})
        add({"c1/comparison/pairs.csv", with_mission({{"by", by}}, mission)});
      for (const char* kind : {"training", "gap", "modules"})
        add_figure(kind, with_mission({}, mission));
    }
    const auto pairs = select(store_, "SELECT DISTINCT mission, method FROM v_designs");
    if (!pairs) return Unexpected(pairs.error());
    for (const auto& cells : pairs->cells)
      add_figure("modules", {{"mission", cells[0].text}, {"method", cells[1].text}});
    return {};
  }

  Expected<void> add_design(DesignId design) {
    const std::string id = to_string(design);
    const std::string number = std::to_string(design.value);
    const std::string base = "c1/designs/" + id;
    add({base});
    add({base + "/steps"});
    add({base + "/parameters", {{"sample", "1000"}}});
    add({"c1/convergence", {{"design", id}}});
    const auto iterations =
        column("SELECT iteration FROM v_iterations WHERE design = " + number + " ORDER BY 1");
    if (!iterations) return Unexpected(iterations.error());
    for (const std::string& iteration : *iterations)
      add({base + "/race", {{"iteration", iteration}}});
    for (const char* kind : {"convergence", "sampling", "parallel", "importance"})
      add_figure(kind, {{"design", id}});
    return add_best(number);
  }

  std::vector<Path> take() { return std::move(paths_); }

 private:
  static Parameters with_mission(Parameters parameters, const std::string& mission) {
    if (!mission.empty()) parameters.emplace_back("mission", mission);
    return parameters;
  }

  void add(Path path) {
    if (known_.insert(key_of(path)).second) paths_.push_back(std::move(path));
  }
  void add_figure(const std::string& kind, const Parameters& parameters) {
    add({"c1/figures/" + kind + ".svg", parameters});
    add({"c1/figures/" + kind + ".csv", parameters});
  }

  /// The first column of the result.
  Expected<std::vector<std::string>> column(const std::string& sql) const {
    const auto rows = select(store_, sql);
    if (!rows) return Unexpected(rows.error());
    std::vector<std::string> texts;
    for (const auto& cells : rows->cells)
      texts.push_back(cells.front().text);
    return texts;
  }

  /// The winner, the last elites and their ancestors, and some runs of the winner.
  Expected<void> add_best(const std::string& design) {
    const auto candidates = column(
        "WITH RECURSIVE best(candidate) AS (SELECT best_candidate FROM v_designs WHERE design = " +
        design +
        " AND best_candidate IS NOT NULL UNION SELECT candidate FROM v_convergence WHERE design "
        "= " +
        design +
        " AND iteration = (SELECT max(iteration) FROM v_convergence WHERE design = " + design +
        ")), family(candidate, far) AS (SELECT candidate, 0 FROM best UNION SELECT c.parent, far + "
        "1 FROM family AS f JOIN v_candidates AS c ON c.candidate = f.candidate WHERE c.parent IS "
        "NOT NULL AND far < 20) SELECT DISTINCT candidate FROM family ORDER BY 1");
    if (!candidates) return Unexpected(candidates.error());
    for (const std::string& candidate : *candidates) {
      add({"c1/candidates/c" + candidate});
      add_figure("machine", {{"candidate", "c" + candidate}});
    }
    const auto best =
        column("SELECT coalesce(best_candidate, 0) FROM v_designs WHERE design = " + design);
    if (!best) return Unexpected(best.error());
    for (const auto& [purpose, count] : {std::pair("test", kTestRuns), {"race", kRaceRuns}}) {
      // The number itself is in the statement so that SQLite finds the candidate's rows by an
      // index.
      const auto runs = column("SELECT id FROM v_evaluations WHERE candidate = " + best->front() +
                               " AND purpose = '" + purpose +
                               "' AND status = 'ok' ORDER BY pair LIMIT " + std::to_string(count));
      if (!runs) return Unexpected(runs.error());
      for (const std::string& run : *runs) {
        add({"c1/runs/" + run + "/trajectory"});
        if (std::string_view(purpose) == "race") add({"c1/evaluations/" + run});
      }
    }
    const auto real = column("SELECT id FROM v_real_runs WHERE design = " + design);
    if (!real) return {};  // the store is older than real runs
    for (const std::string& run : *real)
      add({"c1/runs/" + run + "/trajectory"});
    return {};
  }

  StoreReader& store_;
  std::vector<Path> paths_;
  std::set<std::string> known_;
};

/// {"live":{...},"c1/figures/box.svg":"<svg ..."}
std::string answers_of(HttpSite& site, const std::vector<Path>& paths,
                       const SnapshotOptions& options) {
  std::string text = "{";
  std::int64_t made = 0;
  for (const Path& path : paths) {
    SiteRequest request{.path = "/api/v1/" + path.path};
    for (const auto& [name, value] : path.parameters)
      request.parameters[name] = value;
    SiteAnswer answer = site.answer(request);
    if (text.size() > 1) text += ',';
    text += json_text(key_of(path)) + ":";
    const bool is_json = answer.type == "application/json";
    while (is_json && answer.body.ends_with('\n'))
      answer.body.pop_back();
    text += is_json ? answer.body : json_text(answer.body);
    if (options.progress) options.progress(++made, static_cast<std::int64_t>(paths.size()));
  }
  return text + "}";
}

std::string file_named(std::string_view path) {
  for (const PageFile& file : page_files())
    if (file.path == path) return gunzip(file.packed, kMostCode).value_or("");
  return "";
}

/// Code inside a page must not close its own element.
std::string inlined(std::string code) {
  for (std::size_t at = 0; (at = code.find("</", at)) != std::string::npos; at += 3)
    code.replace(at, 2, "<\\/");
  return code;
}

bool replace(std::string& text, std::string_view what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) return false;
  text.replace(at, what.size(), by);
  return true;
}

}  // namespace

Expected<std::string> snapshot_page(const std::filesystem::path& store,
                                    const SnapshotOptions& options) {
  std::string page = file_named("/");
  if (page.empty()) {
    return unexpected(ErrorKind::Conflict,
                      "this program was built without its pages (esbuild, node-preact and zopfli)");
  }
  auto reader = StoreReader::open(store);
  if (!reader) return Unexpected(reader.error());
  std::vector<DesignId> designs = options.designs;
  const std::vector<DesignRow> known = (*reader)->designs();
  for (const DesignId design : designs) {
    if (std::ranges::find(known, design, &DesignRow::id) == known.end())
      return unexpected(ErrorKind::NotFound, "the store has no design " + to_string(design),
                        "--design");
  }
  if (designs.empty()) std::ranges::transform(known, std::back_inserter(designs), &DesignRow::id);
  Paths paths(**reader);
  if (auto added = paths.add_store(); !added) return Unexpected(added.error());
  for (const DesignId design : designs) {
    if (auto added = paths.add_design(design); !added) return Unexpected(added.error());
  }
  const auto site = make_dashboard(
      {.stores = {{store, std::nullopt, true}}, .version = options.version, .is_snapshot = true});
  const std::string data = base64_text(gzip(answers_of(*site, paths.take(), options), 9));
  const bool whole =
      replace(page, "<link rel=\"icon\" href=\"favicon.svg\">",
              "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
              "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:\">\n"
              "<link rel=\"icon\" href=\"data:image/svg+xml;base64," +
                  base64_text(file_named("/favicon.svg")) + "\">") &&
      replace(page, "<link rel=\"stylesheet\" href=\"style.css\">",
              "<style>" + file_named("/style.css") + "</style>") &&
      replace(page, "<script src=\"main.js\"></script>",
              "<script id=\"snapshot\" type=\"text/plain\">" + data + "</script>\n<script>" +
                  inlined(file_named("/main.js")) + "</script>");
  if (whole) return page;
  return unexpected(ErrorKind::Corrupt, "the page does not name its code and style as expected",
                    "web/src/index.html");
}

}  // namespace swarmsmith::cli
