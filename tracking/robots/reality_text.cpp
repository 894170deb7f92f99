#include "tracking/robots/reality_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

namespace swarmsmith {
namespace {

std::string gain_text(const Gain& gain) {
  if (!gain.gain) return "unknown";
  return fmt::format("{:.1f} % +- {:.1f} %", 100 * *gain.gain, 100 * gain.error);
}

JsonObject gain_json(const Gain& gain) {
  return JsonObject()
      .add("gain", gain.gain)
      .add("error", gain.gain ? std::optional(gain.error) : std::nullopt)
      .add("seconds", gain.seconds)
      .add("reason", gain.reason);
}

}  // namespace

std::string reality_text(const Reality& reality) {
  std::string text = fmt::format("of what is commanded it drives {} and turns {}",
                                 gain_text(reality.slip.way), gain_text(reality.slip.turn));
  const NeighboursSeen& neighbours = reality.neighbours;
  if (neighbours.is_told()) {
    text += fmt::format("; it misses {:.1f} % +- {:.1f} % of {} neighbours",
                        100 * neighbours.miss_rate(), 100 * neighbours.error, neighbours.there);
  }
  if (!reality.states_s.empty()) text += "; time by state:";
  for (const auto& [state, seconds] : reality.states_s)
    text += fmt::format(" {} {:.1f} s", state, seconds);
  return text;
}

JsonObject reality_json(const Reality& reality) {
  const NeighboursSeen& neighbours = reality.neighbours;
  const bool is_told = neighbours.is_told();
  return JsonObject()
      .add("way", gain_json(reality.slip.way))
      .add("turn", gain_json(reality.slip.turn))
      .add("neighbours",
           JsonObject()
               .add("miss_rate", is_told ? std::optional(neighbours.miss_rate()) : std::nullopt)
               .add("error", is_told ? std::optional(neighbours.error) : std::nullopt)
               .add("there", neighbours.there)
               .add("seen", neighbours.seen)
               .add("phantoms", neighbours.phantoms)
               .add("reason", neighbours.reason))
      .add("delays_s", reality.delays_s)
      .add("period_s", reality.period_s)
      .add("states", json_list(reality.states_s, [](const std::pair<int, double>& state) {
             return JsonObject().add("state", state.first).add("seconds", state.second);
           }));
}

NeighboursSeen neighbours_in_report(const std::string& report, const std::string& robot) {
  const NeighboursSeen unknown{
      .reason =
          "the store does not keep a log's neighbours, and this run was scored before they "
          "were counted; `rescore` it with --run, where its logs are"};
  const auto json = nlohmann::json::parse(report, nullptr, false);
  if (!json.is_object() || !json.contains("robots")) return unknown;
  try {
    for (const auto& one : json.at("robots")) {
      if (one.value("robot", "") != robot || !one.contains("reality")) continue;
      if (one.at("reality").is_null()) continue;
      const auto& seen = one.at("reality").at("neighbours");
      NeighboursSeen neighbours{.there = seen.at("there").get<std::int64_t>(),
                                .seen = seen.at("seen").get<std::int64_t>(),
                                .phantoms = seen.at("phantoms").get<std::int64_t>()};
      neighbours.reason = seen.at("reason").get<std::string>();
      if (seen.at("error").is_number()) neighbours.error = seen.at("error").get<double>();
      return neighbours;
    }
  } catch (const nlohmann::json::exception&) {
    return unknown;  // the user wrote the report
  }
  return unknown;
}

}  // namespace swarmsmith
