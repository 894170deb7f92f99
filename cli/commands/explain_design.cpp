#include "cli/commands/explain_design.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/records/records.h"
#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "cli/output/progress_text.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_stages.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

/// A finished part of the search, and its best candidate. A walk of simulated annealing that the
/// final stage cut short has no best candidate.
struct StoryPart {
  std::string line;
  std::string name;
  std::optional<EliteRecord> best;
  std::int64_t spent = 0;  ///< experiments
  bool is_final = false;
};

struct Story {
  DesignRecord design;
  std::string search;  ///< "none" for machines that were given, drawn or imported
  std::vector<StoryPart> parts;
  std::optional<SampledRecord> winner;
  bool shows_costs = false;

  std::string mean(double score) const { return score_text(shows_costs ? to_cost(score) : score); }
};

Expected<Story> read_story(StoreReader& store, DesignRecord design, const StoredStages& stages) {
  const std::string name = to_string(design.design);
  const SearchOptions* search = stages.search(name);
  Story story{
      .design = std::move(design),
      .search = std::string(name_of(search != nullptr ? kind_of(*search) : SearchKind::Irace)),
      .shows_costs = is_of_programs(store)};
  if (story.design.budget == 0 && story.design.used == 0) story.search = "none";
  const DesignId id = story.design.design;
  const auto best = elites(store, {.design = id});
  if (!best) return Unexpected(best.error());
  const auto all = iterations(store, id);
  if (!all) return Unexpected(all.error());
  std::int64_t used = 0;
  for (const IterationRecord& begun : *all) {
    StoryPart part{.line = stages.round_line(name, begun.iteration),
                   .name = stages.round(name, std::to_string(begun.iteration)),
                   .is_final = stages.is_final(name, begun.iteration)};
    for (const EliteRecord& elite : *best) {
      if (elite.rank == 1 && elite.iteration == begun.iteration) part.best = elite;
    }
    // A part that has just begun has no result to show.
    if (!part.best && begun.iteration == all->back().iteration) continue;
    if (part.best) {
      part.spent = part.best->experiments_used - used;
      used = part.best->experiments_used;
    }
    // The experiments spent by the races add up to the experiments used by the design; their
    // budgets do not.
    if (search == nullptr)
      part.line +=
          fmt::format(": {}, {} of at most {}", counted(begun.configurations, "configuration"),
                      part.spent, counted(begun.budget, "experiment"));
    story.parts.push_back(std::move(part));
  }
  if (!story.design.best) return story;
  const auto sampled = candidates(store, id);
  if (!sampled) return Unexpected(sampled.error());
  const auto winner = std::ranges::find(*sampled, *story.design.best, &SampledRecord::candidate);
  if (winner != sampled->end()) story.winner = *winner;
  return story;
}

/// "0.6 less than the best mean before it, 3 of c2000047 in generation 22".
std::string difference(const Story& story, const EliteRecord& last, const StoryPart& before) {
  const double change = last.mean - before.best->mean;
  const double shown = story.shows_costs ? -change : change;
  const std::string text =
      shown == 0 ? "as much as"
                 : score_text(std::abs(shown)) + (shown < 0 ? " less than" : " more than");
  return fmt::format("{} the best mean before it, {} of {} in {}", text,
                     story.mean(before.best->mean), to_string(before.best->candidate), before.name);
}

/// The winner, where the search made it, and its result in the last part.
std::string sentence(const Story& story, const StoredStages& stages) {
  std::vector<const StoryPart*> ended;
  for (const StoryPart& part : story.parts) {
    if (part.best) ended.push_back(&part);
  }
  if (!story.winner || ended.empty()) return "";
  const std::string design = to_string(story.design.design);
  const StoryPart& last = *ended.back();
  std::string text = to_string(story.winner->candidate) + ", made in " +
                     stages.round(design, std::to_string(story.winner->iteration));
  if (last.best->candidate != story.winner->candidate) return text;
  text +=
      fmt::format("; mean {} over {} in {}", story.mean(last.best->mean),
                  counted(last.best->runs, "run"), last.is_final ? "the final stage" : last.name);
  const bool is_compared = last.is_final && ended.size() > 1 && !ended[ended.size() - 2]->is_final;
  if (is_compared) text += ", " + difference(story, *last.best, *ended[ended.size() - 2]);
  return text;
}

void write_text(Output& output, const Story& story, const StoredStages& stages) {
  const DesignRecord& design = story.design;
  const std::string id = to_string(design.design);
  const SearchOptions* search = stages.search(id);
  const bool is_searching = search != nullptr && design.state == "racing";
  output.out << "design " << id << "\n"
             << "what        " << as_shown(design.mission, Layout::Escaped) << ", "
             << as_shown(design.method, Layout::Escaped) << ", repetition " << design.repetition
             << "\n"
             << "search      " << story.search << "\n"
             << "state       "
             << (is_searching ? std::string(words_of(*search).at_work) : design.state);
  if (story.search != "none")
    output.out << ", " << design.used << " of " << counted(design.budget, "experiment") << " used";
  output.out << "\n";
  const std::string stage = search != nullptr ? stages.stage(id, "") : "";
  if (!stage.empty()) output.out << "stage       " << stage << "\n";
  const std::string winner = sentence(story, stages);
  if (!winner.empty())
    output.out << (design.state == "finished" ? "winner      " : "best        ") << winner << "\n";
  if (!story.parts.empty()) output.out << "\n";
  for (const StoryPart& part : story.parts) {
    output.out << part.line;
    if (part.best)
      output.out << "; best " << to_string(part.best->candidate) << ", mean "
                 << story.mean(part.best->mean) << " over " << counted(part.best->runs, "run");
    output.out << "\n";
  }
}

void write_json(Output& output, const Story& story, const StoredStages& stages) {
  std::string parts;
  for (const StoryPart& part : story.parts) {
    if (!part.best) continue;
    parts += (parts.empty() ? "" : ",") + JsonObject()
                                              .add("iteration", part.best->iteration)
                                              .add("stage", part.name)
                                              .add("best", part.best->candidate)
                                              .add("mean", part.best->mean)
                                              .add("runs", part.best->runs)
                                              .add("used", part.best->experiments_used)
                                              .add("spent", part.spent)
                                              .text();
  }
  output.out << JsonObject()
                    .add("v", 1)
                    .add("id", to_string(story.design.design))
                    .add("search", story.search)
                    .add("state", story.design.state)
                    .add("used", story.design.used)
                    .add("budget", story.design.budget)
                    .add("winner", sentence(story, stages))
                    .add("stages", JsonPiece{"[" + parts + "]"})
                    .text()
             << "\n";
}

}  // namespace

ExitCode explain_design(Output& output, StoreReader& store, const ThingId& id, bool is_written) {
  const DesignId design = design_of_thing(id);
  auto known = designs(store, {.design = design});
  if (!known) return fail(output, ExitCode::Store, known.error());
  if (known->empty())
    return fail(output, ExitCode::NoSuchId, "the store has no " + to_string(design));
  std::string& state = known->front().state;
  if (!is_written && (state == "racing" || state == "testing")) state = "interrupted";
  const auto stages = StoredStages::read(store);
  if (!stages) return fail(output, ExitCode::Store, stages.error());
  const auto story = read_story(store, std::move(known->front()), *stages);
  if (!story) return fail(output, ExitCode::Store, story.error());
  output.json ? write_json(output, *story, *stages) : write_text(output, *story, *stages);
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
