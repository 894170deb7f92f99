#include "coordinator/service/live_status.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace swarmsmith {

// For nlohmann, which finds them by their names.
inline void to_json(nlohmann::json& json, DesignState state) {
  json = std::string(word_of(state));
}
inline void from_json(const nlohmann::json& json, DesignState& state) {
  // A word of another version says nothing.
  state = design_state_of(json.get<std::string>()).value_or(DesignState::Waiting);
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WorkerStatus, number, state, host, job, client, slots, held,
                                   running, done, failed, connections, done_per_s, busy,
                                   last_heard_s)

template <class Json, class Design, class Visit>
void each_design_field(Json& json, Design& design, const Visit& visit) {
  visit(json, "id", design.id);
  visit(json, "mission", design.mission);
  visit(json, "method", design.method);
  visit(json, "repetition", design.repetition);
  visit(json, "state", design.state);
  visit(json, "used", design.used);
  visit(json, "budget", design.budget);
  visit(json, "iteration", design.iteration);
  visit(json, "best", design.best);
  visit(json, "best_mean", design.best_mean);
  visit(json, "paused", design.paused);
}
inline void to_json(nlohmann::json& json, const DesignStatus& design) {
  each_design_field(json, design,
                    [](auto& out, const char* name, const auto& value) { out[name] = value; });
  if (design.search.empty()) return;
  json["stage"] = design.stage;
  json["search"] = design.search;
}
inline void from_json(const nlohmann::json& json, DesignStatus& design) {
  each_design_field(json, design, [](const auto& in, const char* name, auto& value) {
    in.at(name).get_to(value);
  });
  design.stage = json.value("stage", "");
  design.search = json.value("search", "");
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(QuarantineStatus, who, reason, since, worker, workers)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LauncherStatus, name, wanted, running, pending, waits_for, note)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CampaignStatus, name, trouble, used, budget, queued_units,
                                   wal_bytes, designs)

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const SlotTimes& times) {
  ordered_json idle = ordered_json::object();
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    idle[std::string(name_of(static_cast<IdleCause>(i)))] = times.idle[i];
  return {{"slots_s", times.slots}, {"busy_s", times.busy}, {"idle_s", idle}};
}

SlotTimes slot_times_of(const nlohmann::json& json) {
  SlotTimes times{.slots = json.at("slots_s"), .busy = json.at("busy_s")};
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    times.idle[i] = json.at("idle_s").at(std::string(name_of(static_cast<IdleCause>(i))));
  return times;
}

template <class Json, class Status, class Visit>
void each_field(Json& json, Status& status, const Visit& visit) {
  visit(json, "workers", status.workers);
  visit(json, "slots", status.slots);
  visit(json, "ready", status.ready);
  visit(json, "leased", status.leased);
  visit(json, "credit", status.credit);
  visit(json, "done", status.done);
  visit(json, "rejected", status.rejected);
  visit(json, "failed", status.failed);
  visit(json, "requeued", status.requeued);
  visit(json, "expired", status.expired);
  visit(json, "duplicates", status.duplicates);
  visit(json, "conflicts", status.conflicts);
  visit(json, "unknown", status.unknown);
  visit(json, "unleased", status.unleased);
  visit(json, "rulings", status.rulings);
  visit(json, "referee_queue", status.referee_queue);
  visit(json, "audits", status.audits);
  visit(json, "quarantined", status.quarantined);
  visit(json, "lost_workers", status.lost_workers);
  visit(json, "reconnects", status.reconnects);
  visit(json, "malformed", status.malformed);
  visit(json, "malformed_by", status.malformed_by);
  visit(json, "over_budget", status.over_budget);
  visit(json, "uncommitted", status.uncommitted);
  visit(json, "bytes_in", status.bytes_in);
  visit(json, "bytes_out", status.bytes_out);
  visit(json, "gone_workers", status.gone_workers);
  visit(json, "uptime_s", status.uptime_s);
  visit(json, "evaluations_per_s", status.evaluations_per_s);
  visit(json, "used_per_s", status.used_per_s);
  visit(json, "trouble", status.trouble);
  visit(json, "insecure_plaintext", status.insecure_plaintext);
  visit(json, "refused", status.refused);
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
         " in quarantine no longer: its first results are checked as those of a new worker; one "
         "that was turned away has to be started again";
}

Expected<std::string> not_in_quarantine(const std::string& word,
                                        const std::vector<std::string>& known) {
  std::string text = kNotInQuarantine + std::string("; ");
  text += known.empty() ? "nothing is" : "these are: ";
  for (std::size_t i = 0; i < known.size(); ++i)
    text += (i == 0 ? "" : ", ") + known[i];
  return unexpected(ErrorKind::NotFound, text, word);
}

double seconds_left(const LiveStatus& status) {
  if (!status.campaigns) return -1;
  std::int64_t left = 0;
  for (const CampaignStatus& campaign : *status.campaigns)
    left += std::max<std::int64_t>(0, campaign.budget - campaign.used);
  if (left == 0) return 0;
  return status.used_per_s > 0 ? static_cast<double>(left) / status.used_per_s : -1;
}

namespace {

ordered_json head_of(const LiveStatus& status) {
  ordered_json json{{"v", 1}};
  each_field(json, status,
             [](ordered_json& out, const char* name, const auto& value) { out[name] = value; });
  const double left = seconds_left(status);
  json["eta_s"] = left < 0 ? ordered_json() : ordered_json(left);
  json["slot_times"] = json_of(status.slot_times);
  json["slot_times_last_minute"] = json_of(status.slot_times_last_minute);
  json["launcher"] = nlohmann::json(status.launcher);
  json["quarantine"] = nlohmann::json(status.quarantine);
  return json;
}

ordered_json fleet_of(const LiveStatus& status) {
  return status.fleet ? ordered_json(nlohmann::json(*status.fleet)) : ordered_json::array();
}

/// Texts of other processes need not be UTF-8.
std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string to_json(const LiveStatus& status) {
  ordered_json json = head_of(status);
  json["campaigns"] = ordered_json::array();
  if (status.campaigns) json["campaigns"] = nlohmann::json(*status.campaigns);
  json["fleet"] = fleet_of(status);
  return text_of(json);
}

std::string head_json(const LiveStatus& status) {
  return text_of(head_of(status));
}

std::string fleet_json(const LiveStatus& status) {
  return text_of(fleet_of(status));
}

Expected<LiveStatus> live_status_of(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    LiveStatus status;
    each_field(json, status, [](const nlohmann::json& in, const char* name, auto& value) {
      in.at(name).get_to(value);
    });
    json.at("launcher").get_to(status.launcher);
    // Earlier coordinators do not say it.
    status.quarantine = json.value("quarantine", std::vector<QuarantineStatus>{});
    status.slot_times = slot_times_of(json.at("slot_times"));
    status.slot_times_last_minute = slot_times_of(json.at("slot_times_last_minute"));
    status.campaigns = std::make_shared<const std::vector<CampaignStatus>>(
        json.at("campaigns").get<std::vector<CampaignStatus>>());
    status.fleet = std::make_shared<const std::vector<WorkerStatus>>(
        json.at("fleet").get<std::vector<WorkerStatus>>());
    return status;
  } catch (const nlohmann::json::exception& error) {
    return unexpected(ErrorKind::Corrupt, std::string("no status: ") + error.what(),
                      "the coordinator's answer");
  }
}

}  // namespace swarmsmith
