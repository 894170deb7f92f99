#include "coordinator/service/log_row.h"

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/log.h"
#include "base/overloaded.h"

namespace swarmsmith {
namespace {

/// Fields with room for their keys.
using Fields = std::vector<std::pair<std::string, LogValue>>;

LogLevel level_of(const std::string& severity) {
  if (severity == "error") return LogLevel::Error;
  return severity == "warning" ? LogLevel::Warning : LogLevel::Info;
}

/// On a terminal, `run` says most of it in its own words.
LogLevel shown_as(LogLevel level) {
  return log_is_asked_for() ? level : LogLevel::Debug;
}

void write(LogLevel level, std::string_view event, const Fields& fields) {
  std::vector<LogField> views;
  views.reserve(fields.size());
  for (const auto& [key, value] : fields)
    views.push_back({key, value});
  log_event(shown_as(level), "coordinator", event, views);
}

/// The event's own text is a JSON object of numbers and strings.
Fields fields_of(const EventRow& event) {
  Fields fields;
  const auto json = nlohmann::ordered_json::parse(event.text, nullptr, false);
  if (!json.is_object()) return {{"details", event.text}};
  for (const auto& [key, value] : json.items()) {
    if (value.is_number_integer()) {
      fields.emplace_back(key, value.get<std::int64_t>());
    } else if (value.is_string()) {
      fields.emplace_back(key, value.get<std::string>());
    } else {
      fields.emplace_back(key, value.dump());
    }
  }
  return fields;
}

/// Empty for none.
template <class Id>
std::string name_or_nothing(Id id) {
  return id ? to_string(id) : std::string();
}

std::string state_text(DesignState state) {
  static constexpr std::array<const char*, 5> kNames = {"waiting", "racing", "testing", "finished",
                                                        "stopped"};
  return kNames[static_cast<std::size_t>(state)];
}

void write_worker(const WorkerRow& row) {
  write(LogLevel::Info, "worker " + row.state,
        {{"worker", row.id},
         {"host", row.host},
         {"pid", row.pid},
         {"slots", row.slots},
         {"job", row.job},
         {"client", row.client},
         {"connections", row.connections},
         {"done", row.done},
         {"failed", row.failed}});
}

void write_step(const std::string& campaign, const RaceStepRow& row) {
  write(LogLevel::Debug, "race step",
        {{"campaign", campaign},
         {"design", to_string(row.design)},
         {"step", row.step},
         {"iteration", row.iteration},
         {"alive", row.alive_after},
         {"best", name_or_nothing(row.best)},
         {"mean", row.mean_best},
         {"used", row.used}});
}

void write_attempt(const std::string& campaign, const AttemptRow& row) {
  write(LogLevel::Debug, "attempt ended",
        {{"campaign", campaign},
         {"candidate", to_string(row.key.candidate)},
         {"pair", row.key.pair},
         {"attempt", row.attempt},
         {"worker", row.worker},
         {"held_ms", row.held_ms},
         {"outcome", row.outcome}});
}

}  // namespace

void RowLog::add(std::optional<std::size_t> campaign, const std::string& name, const Row& row) {
  std::visit(Overloaded{
                 [&](const EventRow& event) {
                   Fields fields = fields_of(event);
                   if (campaign) fields.emplace(fields.begin(), "campaign", name);
                   write(level_of(event.severity), event.kind, fields);
                 },
                 [&](const WorkerRow& worker) {
                   // Of a lost one there is an event.
                   if (worker.state != "lost") write_worker(worker);
                 },
                 [&](const DesignStateRow& state) {
                   const auto [known, is_new] =
                       states_.try_emplace({campaign.value_or(0), state.design}, state.state);
                   if (!is_new && known->second == state.state) return;
                   known->second = state.state;
                   write(LogLevel::Info, "design " + state_text(state.state),
                         {{"campaign", name},
                          {"design", to_string(state.design)},
                          {"used", state.used},
                          {"best", name_or_nothing(state.best)},
                          {"mean", state.best_mean},
                          {"reason", state.reason}});
                 },
                 [&](const IterationRow& iteration) {
                   write(LogLevel::Info, "iteration begun",
                         {{"campaign", name},
                          {"design", to_string(iteration.design)},
                          {"iteration", iteration.number},
                          {"of", iteration.of},
                          {"budget", iteration.budget},
                          {"configurations", iteration.configurations}});
                 },
                 [&](const RaceStepRow& step) { write_step(name, step); },
                 [&](const AttemptRow& attempt) { write_attempt(name, attempt); },
                 [&](const CommandRow& command) {
                   write(LogLevel::Info, "command",
                         {{"campaign", name},
                          {"kind", command.kind},
                          {"design", name_or_nothing(command.design)},
                          {"budget", command.budget},
                          {"who", command.who}});
                 },
                 [&](const CampaignStateRow& state) {
                   write(LogLevel::Info, "campaign " + state.state, {{"campaign", name}});
                 },
                 [](const auto&) {},
             },
             row);
}

}  // namespace swarmsmith
