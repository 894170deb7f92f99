#include "coordinator/service/log_row.h"

#include <cmath>
#include <variant>
#include <vector>

#include "base/log.h"
#include "base/overloaded.h"
#include "base/text/toml_text.h"

namespace swarmsmith {
namespace {

/// Log fields that own their keys.
using Fields = std::vector<std::pair<std::string, LogValue>>;

LogLevel level_of(const std::string& severity) {
  if (severity == "error") return LogLevel::Error;
  return severity == "warning" ? LogLevel::Warning : LogLevel::Info;
}

/// On a terminal, `run` shows most of this itself, so it is logged at debug level.
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

/// Whole numbers as integers, others as in the event's text.
LogValue log_value(double number) {
  constexpr double kMostExact = 1e15;
  if (std::abs(number) < kMostExact && number == std::floor(number))
    return static_cast<std::int64_t>(number);
  return number_text(number);
}

Fields fields_of(const EventRow& event) {
  Fields fields;
  for (const auto& [key, value] : event.fields) {
    fields.emplace_back(key,
                        std::visit(Overloaded{[](double number) { return log_value(number); },
                                              [](const auto& other) { return LogValue(other); }},
                                   value));
  }
  return fields;
}

/// The id as text; empty if there is no id.
template <class Id>
std::string name_or_nothing(Id id) {
  return id ? to_string(id) : std::string();
}

void write_worker(const WorkerRow& row) {
  write(LogLevel::Info, "worker " + std::string(word_of(row.state)),
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

void write_step(const std::string& campaign, const RaceStepRow& row, bool is_race) {
  write(LogLevel::Debug, is_race ? "race step" : "search step",
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
         {"outcome", std::string(word_of(row.outcome))}});
}

}  // namespace

const SearchWords& RowLog::words_of_design(std::optional<std::size_t> campaign,
                                           DesignId design) const {
  const std::size_t index = campaign.value_or(0);
  if (index >= searches_.size()) return words_of(SearchKind::Irace);
  const auto search = searches_[index].find(design);
  return words_of(search == searches_[index].end() ? SearchKind::Irace : kind_of(search->second));
}

void RowLog::add(std::optional<std::size_t> campaign, const std::string& name, const Row& row) {
  std::visit(Overloaded{
                 [&](const EventRow& event) {
                   Fields fields = fields_of(event);
                   if (campaign) fields.emplace(fields.begin(), "campaign", name);
                   write(level_of(event.severity), event.kind, fields);
                 },
                 [&](const WorkerRow& worker) {
                   // A lost worker already has an event.
                   if (worker.state != WorkerState::Lost) write_worker(worker);
                 },
                 [&](const DesignStateRow& state) {
                   const auto [known, is_new] =
                       states_.try_emplace({campaign.value_or(0), state.design}, state.state);
                   if (!is_new && known->second == state.state) return;
                   known->second = state.state;
                   const std::string_view word =
                       state.state == DesignState::Racing
                           ? words_of_design(campaign, state.design).at_work
                           : word_of(state.state);
                   write(LogLevel::Info, "design " + std::string(word),
                         {{"campaign", name},
                          {"design", to_string(state.design)},
                          {"used", state.used},
                          {"best", name_or_nothing(state.best)},
                          {"mean", state.best_mean},
                          {"reason", state.reason}});
                 },
                 [&](const IterationRow& iteration) {
                   const SearchWords& words = words_of_design(campaign, iteration.design);
                   const std::string round(
                       iteration.postselection && !words.has_tests ? words.where : words.round);
                   write(LogLevel::Info, round + " begun",
                         {{"campaign", name},
                          {"design", to_string(iteration.design)},
                          {"iteration", iteration.number},
                          {"of", iteration.of},
                          {"budget", iteration.budget},
                          {"configurations", iteration.configurations}});
                 },
                 [&](const RaceStepRow& step) {
                   write_step(name, step, words_of_design(campaign, step.design).has_tests);
                 },
                 [&](const AttemptRow& attempt) { write_attempt(name, attempt); },
                 [&](const CommandRow& command) {
                   write(LogLevel::Info, "command",
                         {{"campaign", name},
                          {"kind", std::string(word_of(command.kind))},
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
