#include "cli/dashboard/live_answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <utility>

#include "analysis/records/records.h"
#include "base/id.h"
#include "cli/output/stored_quarantine.h"
#include "cli/output/stored_stages.h"
#include "storage/rows.h"

namespace swarmsmith::cli {
namespace {

using LiveCell = StoreReader::Cell;

/// A version moves with all that pages show of a design: its steps, its state, its tests, what
/// people asked of it. The last step may be of the iteration before: its survivors are not those
/// who race now.
constexpr const char* kDesigns =
    "SELECT d.design AS id, d.mission, d.method, d.repetition, d.state, d.used, d.budget, "
    "d.iteration, "
    "coalesce((SELECT s.alive_after FROM race_step AS s WHERE s.design = d.design AND s.iteration "
    "= "
    "d.iteration ORDER BY s.step DESC LIMIT 1), (SELECT i.configurations FROM iteration AS i WHERE "
    "i.design = d.design AND i.number = d.iteration)) AS alive, "
    "d.best_candidate AS best, d.best_mean, "
    "d.state NOT IN ('finished', 'stopped') AND coalesce((SELECT c.kind FROM v_commands AS c WHERE "
    "c.design = d.design AND c.kind IN ('pause', 'resume') ORDER BY c.number DESC LIMIT 1), '') = "
    "'pause' AS paused, "
    "coalesce((SELECT max(s.step) FROM race_step AS s WHERE s.design = d.design), 0) + d.iteration "
    "+ "
    "(d.state = 'testing') + 2 * (d.state IN ('finished', 'stopped')) + "
    "(SELECT count(*) FROM v_commands AS c WHERE c.design = d.design) AS version, "
    "CASE WHEN (SELECT count(*) FROM v_campaigns) > 1 THEN (SELECT c.name FROM v_campaigns AS c "
    "WHERE c.campaign = d.campaign) ELSE '' END AS campaign "
    "FROM v_designs AS d ORDER BY d.design";

/// A campaign that nobody runs does not run.
void correct_states(Rows& rows) {
  const auto state = std::ranges::find(rows.columns, "state") - rows.columns.begin();
  for (auto& cells : rows.cells) {
    std::string& text = cells[static_cast<std::size_t>(state)].text;
    if (text == "running" || text == "racing" || text == "testing") text = "interrupted";
  }
}

LiveCell& live_cell(Rows& rows, std::size_t row, std::string_view column) {
  const auto at = std::ranges::find(rows.columns, column) - rows.columns.begin();
  return rows.cells[row][static_cast<std::size_t>(at)];
}

LiveCell integer_cell(std::int64_t value) {
  return {LiveCell::Type::Integer, std::to_string(value)};
}

/// What the coordinator's memory knows better.
void update(Rows& designs, std::size_t row, const DesignStatus& now) {
  live_cell(designs, row, "state") = {LiveCell::Type::Text, std::string(word_of(now.state))};
  live_cell(designs, row, "used") = integer_cell(now.used);
  live_cell(designs, row, "budget") = integer_cell(now.budget);
  live_cell(designs, row, "paused") = integer_cell(now.paused ? 1 : 0);
  if (now.best == 0) return;
  live_cell(designs, row, "best") = integer_cell(now.best);
  live_cell(designs, row, "best_mean") = {LiveCell::Type::Real, json_number(now.best_mean)};
}

JsonObject design_json(Rows& designs, std::size_t row, const DesignStatus* now) {
  if (now != nullptr) update(designs, row, *now);
  JsonObject object;
  for (std::size_t column = 0; column < designs.columns.size(); ++column) {
    const std::string& name = designs.columns[column];
    const LiveCell& cell = designs.cells[row][column];
    if (name == "paused") {
      object.add(name, cell.text == "1");
    } else if (name == "id" || name == "best") {
      const char* letter = name == "id" ? "d" : "c";
      object.add(name, cell.type == LiveCell::Type::Null ? std::nullopt
                                                         : std::optional(letter + cell.text));
    } else if ((name != "stage" && name != "search" && name != "campaign") || !cell.text.empty()) {
      object.add(name, cell_as_json(cell));
    }
  }
  if (now != nullptr && !now->search.empty())
    object.add("stage", now->stage).add("search", now->search);
  return object;
}

/// Merged stores hold several campaigns: their names, and the state of those that are not finished.
struct Head {
  std::string name;
  std::string state;
};

Head head_of(const StoredCampaignState& state) {
  Head head;
  Rows heads = state.campaign;
  for (std::size_t i = 0; i < heads.cells.size(); ++i) {
    head.name += (i == 0 ? "" : ", ") + live_cell(heads, i, "name").text;
    if (i == 0 || head.state == "finished") head.state = live_cell(heads, i, "state").text;
  }
  return head;
}

const DesignStatus* find_design(const CampaignStatus* now, const std::string& id) {
  if (now == nullptr) return nullptr;
  const auto found = std::ranges::find(now->designs, std::atoll(id.c_str()), &DesignStatus::id);
  return found == now->designs.end() ? nullptr : &*found;
}

/// "1 worker", "2 workers".
std::string counted(std::int64_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

struct CauseText {
  IdleCause cause;
  const char* why;
  const char* todo;
};

/// As docs/observability.md, shorter.
constexpr std::array<CauseText, kIdleCauses> kCauseTexts{{
    {IdleCause::StartUp, "new workers get what they must know", "It passes by itself."},
    {IdleCause::Barrier, "races wait for the last results of a step",
     "Run more designs at the same time, or use fewer slots."},
    {IdleCause::Credit, "workers ask for less than they have slots for",
     "They drain, or have many results that are not acknowledged: look at their silence below."},
    {IdleCause::Alone, "workers are kept free for a task that may have killed one",
     "It passes when that task has run alone."},
    {IdleCause::Commit, "the store cannot write as fast, or not at all",
     "Look at the disk of the store: space, speed."},
    {IdleCause::Held, "what is wanted is of paused designs, or the coordinator ends",
     "Resume the paused designs."},
    {IdleCause::Network, "tasks and results are on their way",
     "Short evaluations, slow connections, or worker hosts whose processors are taken by others."},
}};

}  // namespace

std::vector<Look> looks_of(const LiveStatus& status) {
  std::vector<Look> looks;
  const auto say = [&](bool is_so, const std::string& text, const char* page = "fleet") {
    if (is_so) looks.push_back({text, page});
  };
  const auto some = [&](std::int64_t count, std::string_view what, const char* then,
                        const char* page = "fleet") {
    say(count > 0, counted(count, what) + then, page);
  };
  say(!status.trouble.empty(), status.trouble);
  some(status.conflicts, "conflict", ": two results of one evaluation differ in their bits");
  say(status.insecure_plaintext, "other hosts can connect without keys");
  for (const QuarantineStatus& one : status.quarantine)
    say(true, quarantine_line(one));
  say(status.workers == 0, "no worker is connected");
  some(status.lost_workers, "worker", " lost");
  some(status.rejected, "evaluation", " rejected", "c1");
  some(status.failed, "attempt", " failed", "c1");
  some(status.malformed, "frame", " dropped as malformed");
  return looks;
}

std::vector<Look> looks_of(const std::string& c, const StoredCampaignState& state,
                           const CampaignStatus* now) {
  std::vector<Look> looks;
  const Head head = head_of(state);
  if (now != nullptr && !now->trouble.empty())
    looks.push_back({head.name + ": " + now->trouble, c});
  if (now == nullptr && state.rejected > 0)
    looks.push_back({counted(state.rejected, "evaluation") + " rejected", c});
  if (head.state == "interrupted")
    looks.push_back({head.name + " is not finished, and no process runs it", c});
  for (const QuarantineStatus& one : state.quarantine)
    looks.push_back({quarantine_line(one), "fleet"});
  Rows designs = state.designs;
  for (std::size_t i = 0; i < designs.cells.size(); ++i) {
    const std::string id = live_cell(designs, i, "id").text;
    const DesignStatus* live = find_design(now, id);
    const std::string word =
        live != nullptr ? std::string(word_of(live->state)) : live_cell(designs, i, "state").text;
    if (word == "stopped") looks.push_back({"d" + id + " has stopped", c + "/d" + id});
  }
  return looks;
}

JsonPiece looks_json(const std::vector<Look>& looks) {
  return json_list(looks, [](const Look& look) {
    return JsonObject().add("text", look.text).add("page", look.page);
  });
}

JsonObject causes_json() {
  return std::move(
      JsonObject().add("v", 1).add("causes", json_list(kCauseTexts, [](const CauseText& text) {
                                     return JsonObject()
                                         .add("name", name_of(text.cause))
                                         .add("why", text.why)
                                         .add("todo", text.todo);
                                   })));
}

namespace {

/// Columns `stage` and `search`, empty for iterated races.
Expected<void> add_stages(StoreReader& store, Rows& designs) {
  const auto stages = StoredStages::read(store);
  if (!stages) return Unexpected(stages.error());
  if (stages->empty()) return {};
  for (std::size_t i = 0; i < designs.cells.size(); ++i) {
    const std::string id = live_cell(designs, i, "id").text;
    const SearchOptions* search = stages->search(id);
    const std::string name(search == nullptr ? "" : name_of(search->kind));
    const std::string stage =
        search == nullptr ? "" : stages->stage(id, live_cell(designs, i, "iteration").text);
    designs.cells[i].push_back({LiveCell::Type::Text, stage});
    designs.cells[i].push_back({LiveCell::Type::Text, name});
  }
  designs.columns.insert(designs.columns.end(), {"stage", "search"});
  return {};
}

}  // namespace

Expected<StoredCampaignState> read_campaign_state(StoreReader& store, bool is_written,
                                                  bool stages) {
  StoredCampaignState state;
  auto campaign = select(store,
                         "SELECT c.name, c.digest, c.state, "
                         "(SELECT coalesce(sum(d.used), 0) FROM v_designs AS d WHERE d.campaign = "
                         "c.campaign) AS used, "
                         "(SELECT coalesce(sum(CASE WHEN d.state IN ('finished', 'stopped') THEN "
                         "d.used ELSE d.budget END), 0) FROM v_designs AS d WHERE d.campaign = "
                         "c.campaign) AS budget FROM v_campaigns AS c ORDER BY c.campaign",
                         kRecordLimits);
  if (!campaign) return Unexpected(campaign.error());
  auto designs = select(store, kDesigns, kRecordLimits);
  if (!designs) return Unexpected(designs.error());
  const auto event = select(store,
                            "SELECT coalesce(max(seq), 0), coalesce(sum(kind = 'evaluation "
                            "rejected'), 0) FROM event",
                            kRecordLimits);
  if (!event) return Unexpected(event.error());
  state.campaign = std::move(*campaign);
  state.designs = std::move(*designs);
  state.last_event = event->cells.front()[0].text;
  state.rejected = std::atoll(event->cells.front()[1].text.c_str());
  if (stages) {
    if (auto added = add_stages(store, state.designs); !added) return Unexpected(added.error());
  }
  if (is_written) return state;
  auto quarantine = stored_quarantine(store);
  if (!quarantine) return Unexpected(quarantine.error());
  state.quarantine = *std::move(quarantine);
  correct_states(state.campaign);
  correct_states(state.designs);
  return state;
}

JsonObject campaign_json(const std::string& c, const std::filesystem::path& file,
                         const StoredCampaignState& state, const CampaignStatus* now, double left_s,
                         bool may_act) {
  const Head head = head_of(state);
  Rows heads = state.campaign;
  Rows designs = state.designs;
  std::int64_t used = 0;
  std::int64_t budget = 0;
  for (std::size_t i = 0; i < heads.cells.size(); ++i) {
    used += std::atoll(live_cell(heads, i, "used").text.c_str());
    budget += std::atoll(live_cell(heads, i, "budget").text.c_str());
  }
  if (now != nullptr) {
    used = now->used;
    budget = now->budget;
  }
  std::string list;
  for (std::size_t i = 0; i < designs.cells.size(); ++i) {
    const DesignStatus* live = find_design(now, live_cell(designs, i, "id").text);
    list += (i == 0 ? "" : ",") + design_json(designs, i, live).text();
  }
  const bool moves = now != nullptr && left_s >= 0;
  return std::move(
      JsonObject()
          .add("c", c)
          .add("name", head.name)
          .add("store", file.string())
          .add("digest", heads.cells.size() == 1 ? live_cell(heads, 0, "digest").text : "")
          .add("state", head.state)
          .add("used", used)
          .add("budget", budget)
          .add("eta_s", moves ? std::optional(left_s) : std::nullopt)
          .add("trouble", now != nullptr ? now->trouble : std::string())
          .add("last_event", JsonPiece{state.last_event})
          .add("may_act", may_act && heads.cells.size() == 1 && head.state != "imported")
          .add("designs", JsonPiece{"[" + list + "]"}));
}

void History::add(const LiveStatus& status, Time now) {
  const double at = std::chrono::duration<double>(now.time_since_epoch()).count();
  for (Ring& ring : rings_) {
    const bool first = ring.samples.empty();
    const double span = first ? 0 : at - ring.samples.back().at_s;
    if (!first && span < ring.apart_s) continue;
    Sample sample{.at_s = at,
                  .evaluations_per_s = status.evaluations_per_s,
                  .times = {},
                  .slots = status.slots,
                  .ready = status.ready,
                  .uncommitted = status.uncommitted};
    const SlotTimes& times = status.slot_times;
    const double all = times.slots - ring.before.slots;
    if (!first && all > 0) {
      sample.times.busy = (times.busy - ring.before.busy) / all;
      for (std::size_t i = 0; i < kIdleCauses; ++i)
        sample.times.idle[i] = (times.idle[i] - ring.before.idle[i]) / all;
      sample.evaluations_per_s = static_cast<double>(status.done - ring.done_before) / span;
    }
    ring.before = times;
    ring.done_before = status.done;
    ring.samples.push_back(sample);
    if (ring.samples.size() > ring.most) ring.samples.pop_front();
  }
}

JsonObject History::json(double after_s) const {
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
  std::vector<const Sample*> shown;
  // As it was told: else a sample would come again after its own time. The coarse rings until the
  // finer ones begin.
  for (std::size_t i = rings_.size(); i-- > 0;) {
    const double until = i == 0 || rings_[i - 1].samples.empty()
                             ? std::numeric_limits<double>::infinity()
                             : rings_[i - 1].samples.front().at_s;
    for (const Sample& sample : rings_[i].samples)
      if (rounded(sample.at_s) > after_s && sample.at_s < until) shown.push_back(&sample);
  }
  const auto column = [&](const auto& of) {
    return json_list(shown, [&](const Sample* sample) { return of(*sample); });
  };
  JsonObject object;
  object.add("v", 1)
      .add("t_s", column([&](const Sample& s) { return rounded(s.at_s); }))
      .add("evaluations_per_s",
           column([&](const Sample& s) { return rounded(s.evaluations_per_s); }))
      .add("busy", column([&](const Sample& s) { return rounded(s.times.busy); }));
  for (std::size_t i = 0; i < kIdleCauses; ++i) {
    std::string name(name_of(static_cast<IdleCause>(i)));
    std::ranges::replace(name, '-', '_');
    object.add(name, column([&](const Sample& s) { return rounded(s.times.idle[i]); }));
  }
  return std::move(object.add("slots", column([](const Sample& s) { return s.slots; }))
                       .add("ready", column([](const Sample& s) { return s.ready; }))
                       .add("uncommitted", column([](const Sample& s) { return s.uncommitted; })));
}

}  // namespace swarmsmith::cli
