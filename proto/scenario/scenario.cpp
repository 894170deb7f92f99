#include "proto/scenario/scenario.h"

#include <utility>

#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "proto/key.h"
#include "proto/scenario.pb.h"
#include "proto/scenario/target_message.h"
#include "sim/control/flavour_file.h"
#include "sim/control/flavour_text.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

void write(const WorkerMethod& method, pb::Method& out) {
  out.set_flavour(method.flavour);
  const bool cycles = method.turn_clock == TurnClock::Cycles;
  if (method.own_flavour != nullptr) out.set_own_flavour(flavour_text(*method.own_flavour));
  out.set_turn_clock(cycles ? pb::Method::TURN_CLOCK_CYCLES : pb::Method::TURN_CLOCK_SECONDS);
}

Expected<WorkerMethod> read(const pb::Method& message) {
  if (message.turn_clock() != pb::Method::TURN_CLOCK_CYCLES &&
      message.turn_clock() != pb::Method::TURN_CLOCK_SECONDS) {
    return bad_input("a turn clock that this program does not know", "turn_clock");
  }
  const bool cycles = message.turn_clock() == pb::Method::TURN_CLOCK_CYCLES;
  WorkerMethod method{message.flavour(), cycles ? TurnClock::Cycles : TurnClock::Seconds};
  if (message.own_flavour().empty()) return method;
  auto own = parse_flavour(message.own_flavour(), message.flavour() + ".toml");
  if (!own) return bad_input(to_string(own.error().front()), "own_flavour");
  method.own_flavour = kept_flavour(std::move(*own));
  return method;
}

/// Missions and profile as in a campaign file, with every field, since another version may have
/// other defaults.
std::string simulation_text(const WorkerScenario& scenario) {
  std::vector<Section> sections;
  for (const Mission& mission : scenario.missions) {
    for (Section& section : mission_sections({.mission = mission}))
      sections.push_back(std::move(section));
  }
  for (Section& section : profile_sections(scenario.profile, "profile"))
    sections.push_back(std::move(section));
  for (const Profile& profile : scenario.test_profiles) {
    for (Section& section : profile_sections(profile, "test_profile", true))
      sections.push_back(std::move(section));
  }
  return text_of(sections);
}

Expected<void> read_simulation(const std::string& text, WorkerScenario& scenario) {
  constexpr const char* kName = "simulation";  // name of the field in error messages
  const auto document = parse_document(text, kName);
  if (!document) return Unexpected(document.error());
  Complaints complaints(kName);
  TableReader root(*document, "", complaints);
  for (MissionEntry& entry : read_sent_missions(root))
    scenario.missions.push_back(std::move(entry.mission));
  if (auto profile = root.table("profile")) {
    scenario.profile = read_profile_table(*profile);
  } else if (!root.has("profile")) {
    root.complain("profile", "a simulation needs a [profile]");
  }
  for (TableReader& profile : root.tables("test_profile"))
    scenario.test_profiles.push_back(read_profile_table(profile));
  root.finish();
  if (complaints.empty()) return {};
  return Unexpected(complaints.take().front());
}

void write(const WorkerScenario& scenario, pb::Scenario& message) {
  message.set_campaign_digest(scenario.campaign_digest);
  message.set_engine_version(scenario.engine_version);
  for (const WorkerMethod& method : scenario.methods)
    write(method, *message.add_methods());
  if (!scenario.target) return message.set_simulation(simulation_text(scenario));
  to_message(*scenario.target, *message.mutable_target());
  for (const InstanceTexts& instances : scenario.instances)
    to_message(instances, *message.add_instances());
}

Expected<WorkerScenario> read(const pb::Scenario& message) {
  WorkerScenario scenario;
  scenario.campaign_digest = message.campaign_digest();
  scenario.engine_version = message.engine_version();
  for (int i = 0; i < message.methods_size(); ++i) {
    Expected<WorkerMethod> method = read(message.methods(i));
    if (!method) {
      const std::string path = "methods[" + std::to_string(i) + "].";
      return bad_input(method.error().message, path + method.error().where);
    }
    scenario.methods.push_back(std::move(*method));
  }
  for (const pb::InstanceTexts& texts : message.instances()) {
    Expected<InstanceTexts> instances = from_message(texts);
    if (!instances) return bad_input(instances.error().message, "instances");
    scenario.instances.push_back(std::move(*instances));
  }
  if (message.has_target()) {
    Expected<Target> target = from_message(message.target());
    if (!target) return bad_input(target.error().message, "target." + target.error().where);
    scenario.target = std::move(*target);
    return scenario;
  }
  const Expected<void> simulation = read_simulation(message.simulation(), scenario);
  if (!simulation) return Unexpected(simulation.error());
  return scenario;
}

}  // namespace

std::string to_bytes(const PoolScenario& scenarios) {
  pb::PoolScenario message;
  for (const WorkerScenario& scenario : scenarios)
    write(scenario, *message.add_campaigns());
  return message.SerializeAsString();
}

Expected<PoolScenario> scenarios_from_bytes(std::string_view bytes) {
  pb::PoolScenario message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return bad_input("bytes that are not scenarios");
  }
  const int count = message.campaigns_size();
  if (count < 1 || count > static_cast<int>(kMaxCampaigns)) {
    return bad_input("scenarios of " + std::to_string(count) + " campaigns; wanted 1 to " +
                         std::to_string(kMaxCampaigns),
                     "campaigns");
  }
  PoolScenario scenarios;
  for (int i = 0; i < count; ++i) {
    Expected<WorkerScenario> scenario = read(message.campaigns(i));
    if (!scenario) {
      // The path for the first scenario has no index, since there is usually only one.
      const std::string path = i == 0 ? "" : "campaigns[" + std::to_string(i) + "].";
      return bad_input(scenario.error().message, path + scenario.error().where);
    }
    scenarios.push_back(std::move(*scenario));
  }
  return scenarios;
}

}  // namespace swarmsmith
