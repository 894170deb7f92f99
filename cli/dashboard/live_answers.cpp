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
#include "base/plain_text.h"
#include "cli/output/query_output.h"
#include "cli/output/stored_campaigns.h"
#include "cli/output/stored_quarantine.h"
#include "storage/rows.h"

namespace swarmsmith::cli {
namespace {

/// The version of a design changes with everything that the pages show of it: its steps, its state,
/// its tests, users' commands. The last step may belong to the previous iteration; its survivors
/// are not the candidates of the current race.
constexpr const char* kDesigns =
    "SELECT d.design, d.campaign, "
    "coalesce((SELECT s.alive_after FROM race_step AS s WHERE s.design = d.design AND s.iteration "
    "= "
    "d.iteration ORDER BY s.step DESC LIMIT 1), (SELECT i.configurations FROM iteration AS i WHERE "
    "i.design = d.design AND i.number = d.iteration)) AS alive, "
    "coalesce((SELECT max(s.step) FROM race_step AS s WHERE s.design = d.design), 0) + d.iteration "
    "+ (d.state = 'testing') + 2 * (d.state IN ('finished', 'stopped')) + "
    "(SELECT count(*) FROM v_commands AS c WHERE c.design = d.design) AS version "
    "FROM v_designs AS d ORDER BY d.design";

/// Names of the campaigns in a merged store, and the states of the unfinished ones.
struct Head {
  std::string name;
  std::string state;
};

Head head_of(const StoredCampaignState& state) {
  Head head;
  for (const CampaignStatus& campaign : state.campaigns) {
    const bool is_first = head.name.empty();
    head.name += (is_first ? "" : ", ") + campaign.name;
    if (is_first || head.state == "finished") head.state = campaign.state;
  }
  return head;
}

JsonObject design_json(const CampaignStatus& campaign, const DesignStatus& design,
                       const StoredDesign& stored, bool is_merged) {
  const bool has_best = static_cast<bool>(design.best);
  JsonObject object;
  object.add("id", design.id)
      .add("mission", design.mission)
      .add("method", design.method)
      .add("repetition", design.repetition)
      .add("state", campaign.word_of_design(design))
      .add("used", design.used)
      .add("budget", design.budget)
      .add("left", design.left())
      .add("iteration", design.iteration)
      .add("alive", stored.alive)
      .add("best", design.best)
      .add("best_mean", has_best ? std::optional(design.best_mean) : std::nullopt)
      .add("test_mean", design.is_tested() ? std::optional(design.test_mean) : std::nullopt)
      .add("test_runs", design.is_tested() ? design.test_runs : 0)
      .add("paused", design.paused)
      .add("version", stored.version);
  if (is_merged) object.add("campaign", campaign.name);
  if (!design.search.empty()) object.add("stage", design.stage).add("search", design.search);
  return object;
}

struct CauseText {
  IdleCause cause;
  const char* why;
  const char* todo;
};

/// A short form of the texts in docs/observability.md.
constexpr std::array<CauseText, kIdleCauses> kCauseTexts{{
    {IdleCause::StartUp, "new workers receive the campaign", "It passes by itself."},
    {IdleCause::Barrier, "races wait for the last results of a step",
     "Run more designs at the same time, or use fewer slots."},
    {IdleCause::Credit, "workers ask for fewer tasks than they have slots",
     "They drain, or have many results that are not acknowledged: look at their silence below."},
    {IdleCause::Alone, "a worker is held free to run a suspect task alone",
     "It passes when that task has run alone."},
    {IdleCause::Commit, "the store cannot write as fast, or not at all",
     "Look at the disk of the store: space, speed."},
    {IdleCause::Held, "only paused designs have work left, or the coordinator is shutting down",
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

std::vector<Look> looks_of(const std::string& c, const StoredCampaignState& state) {
  std::vector<Look> looks;
  const Head head = head_of(state);
  for (const CampaignStatus& campaign : state.campaigns) {
    if (!campaign.trouble.empty()) looks.push_back({campaign.name + ": " + campaign.trouble, c});
  }
  if (!state.is_live && state.rejected > 0)
    looks.push_back({counted(state.rejected, "evaluation") + " rejected", c});
  if (head.state == "interrupted")
    looks.push_back({head.name + " is not finished, and no process runs it", c});
  for (const QuarantineStatus& one : state.quarantine)
    looks.push_back({quarantine_line(one), "fleet"});
  for (const CampaignStatus& campaign : state.campaigns) {
    for (const DesignStatus& design : campaign.designs) {
      const std::string id = to_string(design.id);
      if (design.state == DesignState::Stopped)
        looks.push_back({id + " has stopped", c + "/" + id});
    }
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

Expected<StoredCampaignState> read_campaign_state(StoreReader& store, bool is_written,
                                                  const CampaignStatus* now) {
  StoredCampaignState state;
  state.is_live = now != nullptr;
  if (state.is_live) {
    state.campaigns = {*now};
  } else {
    auto campaigns = stored_campaigns(store, is_written);
    if (!campaigns) return Unexpected(campaigns.error());
    state.campaigns = std::move(*campaigns);
  }
  const auto heads = select(store, "SELECT digest FROM v_campaigns", kRecordLimits);
  if (!heads) return Unexpected(heads.error());
  if (heads->cells.size() == 1) state.digest = heads->cells.front()[0].text;
  const auto designs = select(store, kDesigns, kRecordLimits);
  if (!designs) return Unexpected(designs.error());
  for (const auto& cells : designs->cells) {
    StoredDesign& design = state.designs[cells[0].id<DesignId>()];
    if (!cells[2].is_null()) design.alive = cells[2].integer();
    design.version = cells[3].integer();
  }
  const auto event = select(store,
                            "SELECT coalesce(max(seq), 0), coalesce(sum(kind = 'evaluation "
                            "rejected'), 0) FROM event",
                            kRecordLimits);
  if (!event) return Unexpected(event.error());
  state.last_event = event->cells.front()[0].integer();
  state.rejected = event->cells.front()[1].integer();
  if (is_written) return state;
  auto quarantine = stored_quarantine(store);
  if (!quarantine) return Unexpected(quarantine.error());
  state.quarantine = *std::move(quarantine);
  return state;
}

JsonObject campaign_json(const std::string& c, const std::filesystem::path& file,
                         const StoredCampaignState& state, double left_s, bool may_act) {
  const Head head = head_of(state);
  const bool is_merged = state.campaigns.size() > 1;
  CampaignTotals totals;
  std::string trouble;
  std::map<DesignId, JsonPiece> designs;
  for (const CampaignStatus& campaign : state.campaigns) {
    trouble = campaign.trouble;
    for (const DesignStatus& design : campaign.designs) {
      totals.add(design);
      const auto stored = state.designs.find(design.id);
      const StoredDesign of_store = stored == state.designs.end() ? StoredDesign{} : stored->second;
      designs[design.id] = {design_json(campaign, design, of_store, is_merged).text()};
    }
  }
  return std::move(
      JsonObject()
          .add("c", c)
          .add("name", head.name)
          .add("store", file.string())
          .add("digest", state.digest)
          .add("state", head.state)
          .add("used", totals.used)
          .add("budget", totals.budget)
          .add("left", totals.left)
          .add("eta_s", state.is_live && left_s >= 0 ? std::optional(left_s) : std::nullopt)
          .add("trouble", trouble)
          .add("last_event", state.last_event)
          .add("may_act", may_act && !is_merged && head.state != "imported")
          .add("designs", json_list(designs, [](const auto& design) { return design.second; })));
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
  // Compares the rounded time that was sent; otherwise the last sample would be sent again. Coarser
  // rings are used only for the time before the finer ones begin.
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
