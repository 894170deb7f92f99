#include "robot/runtime/node_state.h"

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/text/json.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 7> kPhases = {"idle",  "ready",   "armed", "running",
                                                     "ended", "stopped", "failed"};

/// Takes the keys of a state; what is missing or of another type keeps its default.
struct Reader {
  const nlohmann::json& json;

  const nlohmann::json* find(const char* key) const {
    const auto found = json.find(key);
    return found == json.end() ? nullptr : &*found;
  }
  void read(const char* key, std::string& value) const {
    if (const auto* found = find(key); found && found->is_string()) value = *found;
  }
  void read(const char* key, bool& value) const {
    if (const auto* found = find(key); found && found->is_boolean()) value = *found;
  }
  void read(const char* key, std::int64_t& value) const {
    if (const auto* found = find(key); found && found->is_number_integer()) value = *found;
  }
  void read(const char* key, double& value) const {
    if (const auto* found = find(key); found && found->is_number()) value = *found;
  }
  void read(const char* key, std::optional<double>& value) const {
    if (const auto* found = find(key); found && found->is_number()) value = found->get<double>();
  }
  void read(const char* key, std::vector<std::string>& values) const {
    const auto* found = find(key);
    if (!found || !found->is_array()) return;
    for (const auto& item : *found) {
      if (item.is_string()) values.push_back(item.get<std::string>());
    }
  }
};

}  // namespace

std::string_view name_of(Phase phase) {
  return kPhases[static_cast<std::size_t>(phase)];
}

std::optional<Phase> phase_from(std::string_view name) {
  for (std::size_t i = 0; i < kPhases.size(); ++i) {
    if (kPhases[i] == name) return static_cast<Phase>(i);
  }
  return std::nullopt;
}

std::string state_text(const NodeState& state) {
  JsonObject ages;
  for (const Feed feed : kAllFeeds) {
    if (const auto age = state.age_ms[index_of(feed)]) ages.add(name_of(feed), *age);
  }
  return JsonObject()
      .add("robot", state.robot)
      .add("state", name_of(state.phase))
      .add("run", state.run)
      .add("cycle", state.cycle)
      .add("machine", state.machine_digest)
      .add("flavour", state.flavour)
      .add("turn_clock", state.turn_clock)
      .add("seed", state.seed)
      .add("robot_index", state.robot_index)
      .add("version", state.version)
      .add("scheduling", state.scheduling)
      .add("age_ms", ages)
      .add("held", state.held)
      .add("skipped", state.skipped)
      .add("battery", state.battery)
      .add("verdict", name_of(state.verdict))
      .add("reasons", state.reasons)
      .add("not_ready", state.not_ready)
      .add("log_trouble", state.log_trouble)
      .add("log_open", state.log_open)
      .add("order", state.order)
      .add("refused", state.refused)
      .add("start_unix_s", state.start_unix_s)
      .add("clock_s", state.clock_s)
      .add("unix_s", state.unix_s)
      .text();
}

Expected<NodeState> parse_state(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return bad_input("a node's state is a JSON object");
  const Reader reader{json};
  NodeState state;
  reader.read("robot", state.robot);
  std::string phase;
  reader.read("state", phase);
  const auto known = phase_from(phase);
  if (!known) return bad_input("there is no state `" + phase + "`");
  state.phase = *known;
  reader.read("run", state.run);
  reader.read("cycle", state.cycle);
  reader.read("machine", state.machine_digest);
  reader.read("flavour", state.flavour);
  reader.read("turn_clock", state.turn_clock);
  reader.read("seed", state.seed);
  reader.read("robot_index", state.robot_index);
  reader.read("version", state.version);
  reader.read("scheduling", state.scheduling);
  if (const auto* ages = reader.find("age_ms"); ages && ages->is_object()) {
    for (const Feed feed : kAllFeeds)
      Reader{*ages}.read(std::string(name_of(feed)).c_str(), state.age_ms[index_of(feed)]);
  }
  reader.read("held", state.held);
  reader.read("skipped", state.skipped);
  reader.read("battery", state.battery);
  std::string verdict;
  reader.read("verdict", verdict);
  state.verdict = run_verdict_from(verdict).value_or(RunVerdict::Invalid);
  reader.read("reasons", state.reasons);
  reader.read("not_ready", state.not_ready);
  reader.read("log_trouble", state.log_trouble);
  reader.read("log_open", state.log_open);
  reader.read("order", state.order);
  reader.read("refused", state.refused);
  reader.read("start_unix_s", state.start_unix_s);
  reader.read("clock_s", state.clock_s);
  reader.read("unix_s", state.unix_s);
  return state;
}

}  // namespace swarmsmith
