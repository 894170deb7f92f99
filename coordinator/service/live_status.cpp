#include "coordinator/service/live_status.h"

#include <concepts>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>
#include <utility>

namespace swarmsmith {
namespace {

template <class T, class Of>
concept Like = std::same_as<std::remove_const_t<T>, Of>;

// Each of these functions visits the fields with their JSON names, for both writing and reading.

template <class Visit>
void each_field(Like<WorkerStatus> auto& worker, const Visit& visit) {
  visit("number", worker.number);
  visit("state", worker.state);
  visit("host", worker.host);
  visit("job", worker.job);
  visit("client", worker.client);
  visit("slots", worker.slots);
  visit("held", worker.held);
  visit("running", worker.running);
  visit("done", worker.done);
  visit("failed", worker.failed);
  visit("connections", worker.connections);
  visit("done_per_s", worker.done_per_s);
  visit("busy", worker.busy);
  visit("last_heard_s", worker.last_heard_s);
}

/// Leaves out the state, which depends on the campaign's state, and the fields that an iterated
/// race does not have.
template <class Visit>
void each_field(Like<DesignStatus> auto& design, const Visit& visit) {
  visit("id", design.id.value);
  visit("mission", design.mission);
  visit("method", design.method);
  visit("repetition", design.repetition);
  visit("used", design.used);
  visit("in_step", design.in_step);
  visit("budget", design.budget);
  visit("iteration", design.iteration);
  visit("best", design.best.value);
  visit("best_mean", design.best_mean);
  visit("test_mean", design.test_mean);
  visit("test_runs", design.test_runs);
  visit("paused", design.paused);
  visit("reason", design.reason);
}

template <class Visit>
void each_field(Like<QuarantineStatus> auto& quarantine, const Visit& visit) {
  visit("who", quarantine.who);
  visit("reason", quarantine.reason);
  visit("since", quarantine.since);
  visit("worker", quarantine.worker);
  visit("workers", quarantine.workers);
}

template <class Visit>
void each_field(Like<LauncherStatus> auto& launcher, const Visit& visit) {
  visit("name", launcher.name);
  visit("wanted", launcher.wanted);
  visit("running", launcher.running);
  visit("pending", launcher.pending);
  visit("waits_for", launcher.waits_for);
  visit("note", launcher.note);
}

/// Leaves out the sums and the designs.
template <class Visit>
void each_field(Like<CampaignStatus> auto& campaign, const Visit& visit) {
  visit("name", campaign.name);
  visit("state", campaign.state);
  visit("trouble", campaign.trouble);
  visit("queued_units", campaign.queued_units);
  visit("wal_bytes", campaign.wal_bytes);
  visit("max_time", campaign.max_time);
  visit("costs", campaign.costs);
}

template <class Visit>
void each_field(Like<LiveStatus> auto& status, const Visit& visit) {
  visit("running", status.running);
  visit("workers", status.workers);
  visit("slots", status.slots);
  visit("ready", status.ready);
  visit("leased", status.leased);
  visit("credit", status.credit);
  visit("done", status.done);
  visit("rejected", status.rejected);
  visit("failed", status.failed);
  visit("requeued", status.requeued);
  visit("expired", status.expired);
  visit("duplicates", status.duplicates);
  visit("conflicts", status.conflicts);
  visit("unknown", status.unknown);
  visit("unleased", status.unleased);
  visit("rulings", status.rulings);
  visit("referee_queue", status.referee_queue);
  visit("audits", status.audits);
  visit("quarantined", status.quarantined);
  visit("lost_workers", status.lost_workers);
  visit("reconnects", status.reconnects);
  visit("malformed", status.malformed);
  visit("malformed_by", status.malformed_by);
  visit("over_budget", status.over_budget);
  visit("uncommitted", status.uncommitted);
  visit("bytes_in", status.bytes_in);
  visit("bytes_out", status.bytes_out);
  visit("gone_workers", status.gone_workers);
  visit("uptime_s", status.uptime_s);
  visit("evaluations_per_s", status.evaluations_per_s);
  visit("used_per_s", status.used_per_s);
  visit("trouble", status.trouble);
  visit("insecure_plaintext", status.insecure_plaintext);
  visit("refused", status.refused);
}

template <class Status>
JsonObject object_of(const Status& status) {
  JsonObject object;
  each_field(status, [&](const char* name, const auto& value) { object.add(name, value); });
  return object;
}

/// Fields that an earlier version does not write keep their values.
template <class Status>
void read(const nlohmann::json& json, Status& status) {
  each_field(status, [&](const char* name, auto& value) {
    if (const auto found = json.find(name); found != json.end()) found->get_to(value);
  });
}

template <class Status>
std::vector<Status> list_of(const nlohmann::json& json, const char* name) {
  std::vector<Status> list;
  for (const nlohmann::json& one : json.at(name))
    read(one, list.emplace_back());
  return list;
}

JsonObject json_of_times(const SlotTimes& times) {
  JsonObject idle;
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    idle.add(name_of(static_cast<IdleCause>(i)), times.idle[i]);
  return std::move(
      JsonObject().add("slots_s", times.slots).add("busy_s", times.busy).add("idle_s", idle));
}

SlotTimes slot_times_of(const nlohmann::json& json) {
  SlotTimes times{.slots = json.at("slots_s"), .busy = json.at("busy_s")};
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    times.idle[i] = json.at("idle_s").at(std::string(name_of(static_cast<IdleCause>(i))));
  return times;
}

JsonObject json_of_campaign(const CampaignStatus& campaign) {
  const CampaignTotals totals = campaign.totals();
  JsonObject object = object_of(campaign);
  object.add("designs_finished", totals.finished)
      .add("designs_stopped", totals.stopped)
      .add("designs_paused", totals.paused)
      .add("used", totals.used)
      .add("in_step", totals.in_step)
      .add("budget", totals.budget)
      .add("left", totals.left)
      .add("designs", json_list(campaign.designs, [&](const DesignStatus& design) {
             JsonObject of_design = object_of(design);
             of_design.add("left", design.left()).add("state", campaign.word_of_design(design));
             if (!design.search.empty())
               of_design.add("stage", design.stage).add("search", design.search);
             return of_design;
           }));
  return object;
}

CampaignStatus campaign_of(const nlohmann::json& json) {
  CampaignStatus campaign;
  read(json, campaign);
  campaign.designs = list_of<DesignStatus>(json, "designs");
  for (std::size_t i = 0; i < campaign.designs.size(); ++i) {
    const nlohmann::json& one = json.at("designs")[i];
    DesignStatus& design = campaign.designs[i];
    // The name of a state that only another version knows is read as Waiting.
    design.state =
        design_state_of(one.at("state").get<std::string>()).value_or(DesignState::Waiting);
    design.stage = one.value("stage", "");
    design.search = one.value("search", "");
  }
  return campaign;
}

}  // namespace

std::string quarantine_line(const QuarantineStatus& status) {
  std::string text = status.who;
  if (status.worker != 0) text += ", worker " + std::to_string(status.worker);
  text += " is in quarantine";
  if (!status.since.empty()) text += " since " + status.since;
  if (status.workers > 1) text += " (" + std::to_string(status.workers) + " workers)";
  return text + (status.reason.empty() ? "" : ": " + status.reason);
}

std::string sentence_of_forgiven(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text + (names.size() > 1 ? " are" : " is") +
         " no longer in quarantine: the first results are checked like those of new workers; "
         "restart "
         "workers that were turned away";
}

Expected<std::string> not_in_quarantine(const std::string& word,
                                        const std::vector<std::string>& known) {
  std::string text = kNotInQuarantine + std::string("; ");
  text += known.empty() ? "nothing is" : "these are: ";
  for (std::size_t i = 0; i < known.size(); ++i)
    text += (i == 0 ? "" : ", ") + known[i];
  return unexpected(ErrorKind::NotFound, text, word);
}

std::string_view CampaignStatus::word_of_design(const DesignStatus& design) const {
  const bool at_work = design.state == DesignState::Racing || design.state == DesignState::Testing;
  return at_work && state == "interrupted" ? "interrupted" : word_of(design.state);
}

double seconds_left(const LiveStatus& status) {
  if (!status.campaigns) return -1;
  std::int64_t left = 0;
  for (const CampaignStatus& campaign : *status.campaigns) {
    const CampaignTotals totals = campaign.totals();
    if (campaign.max_time > 0 && !totals.are_over()) return -1;
    left += totals.left;
  }
  if (left == 0) return 0;
  return status.used_per_s > 0 ? static_cast<double>(left) / status.used_per_s : -1;
}

JsonObject head_json(const LiveStatus& status) {
  const double left = seconds_left(status);
  JsonObject object;
  object.add("v", 2);
  each_field(status, [&](const char* name, const auto& value) { object.add(name, value); });
  object.add("eta_s", left < 0 ? std::nullopt : std::optional(left))
      .add("slot_times", json_of_times(status.slot_times))
      .add("slot_times_last_minute", json_of_times(status.slot_times_last_minute))
      .add("launcher", object_of(status.launcher))
      .add("quarantine", quarantine_json(status.quarantine));
  return object;
}

JsonPiece quarantine_json(const std::vector<QuarantineStatus>& quarantine) {
  return json_list(quarantine, object_of<QuarantineStatus>);
}

JsonPiece fleet_json(const LiveStatus& status) {
  return status.fleet ? json_list(*status.fleet, object_of<WorkerStatus>) : JsonPiece{"[]"};
}

JsonObject to_json(const LiveStatus& status) {
  return std::move(head_json(status)
                       .add("campaigns", status.campaigns
                                             ? json_list(*status.campaigns, json_of_campaign)
                                             : JsonPiece{"[]"})
                       .add("fleet", fleet_json(status)));
}

Expected<LiveStatus> live_status_of(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    LiveStatus status;
    read(json, status);
    read(json.at("launcher"), status.launcher);
    if (json.contains("quarantine"))
      status.quarantine = list_of<QuarantineStatus>(json, "quarantine");
    status.slot_times = slot_times_of(json.at("slot_times"));
    status.slot_times_last_minute = slot_times_of(json.at("slot_times_last_minute"));
    std::vector<CampaignStatus> campaigns;
    for (const nlohmann::json& one : json.at("campaigns"))
      campaigns.push_back(campaign_of(one));
    status.campaigns = std::make_shared<const std::vector<CampaignStatus>>(std::move(campaigns));
    status.fleet =
        std::make_shared<const std::vector<WorkerStatus>>(list_of<WorkerStatus>(json, "fleet"));
    return status;
  } catch (const nlohmann::json::exception& error) {
    return unexpected(ErrorKind::Corrupt, std::string("no status: ") + error.what(),
                      "the coordinator's answer");
  }
}

}  // namespace swarmsmith
