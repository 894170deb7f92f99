#include "sim/messages/scenario_messages.h"

#include "proto/key.h"
#include "proto/scenario.pb.h"
#include "sim/messages/mission_messages.h"
#include "sim/messages/profile_messages.h"
#include "sim/messages/target_messages.h"

namespace swarmsmith {
namespace {

void write(const WorkerMethod& method, pb::Method& out) {
  out.set_flavour(method.flavour);
  const bool cycles = method.turn_clock == TurnClock::Cycles;
  out.set_turn_clock(cycles ? pb::Method::TURN_CLOCK_CYCLES : pb::Method::TURN_CLOCK_SECONDS);
}

Expected<WorkerMethod> read(const pb::Method& message) {
  if (message.turn_clock() != pb::Method::TURN_CLOCK_CYCLES &&
      message.turn_clock() != pb::Method::TURN_CLOCK_SECONDS) {
    return bad_input("a clock of turns that this program does not know", "turn_clock");
  }
  const bool cycles = message.turn_clock() == pb::Method::TURN_CLOCK_CYCLES;
  return WorkerMethod{message.flavour(), cycles ? TurnClock::Cycles : TurnClock::Seconds};
}

void write(const WorkerScenario& scenario, pb::Scenario& message) {
  message.set_campaign_digest(scenario.campaign_digest);
  message.set_engine_version(scenario.engine_version);
  for (const Mission& mission : scenario.missions)
    to_message(mission, *message.add_missions());
  for (const WorkerMethod& method : scenario.methods)
    write(method, *message.add_methods());
  if (scenario.target) {
    to_message(*scenario.target, *message.mutable_target());
    for (const InstanceTexts& instances : scenario.instances)
      to_message(instances, *message.add_instances());
  } else {
    to_message(scenario.profile, *message.mutable_profile());
  }
}

Expected<WorkerScenario> read(const pb::Scenario& message) {
  WorkerScenario scenario;
  scenario.campaign_digest = message.campaign_digest();
  scenario.engine_version = message.engine_version();
  for (int i = 0; i < message.missions_size(); ++i) {
    Expected<Mission> mission = from_message(message.missions(i));
    if (!mission) {
      const std::string path = "missions[" + std::to_string(i) + "].";
      return bad_input(mission.error().message, path + mission.error().where);
    }
    scenario.missions.push_back(std::move(*mission));
  }
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
  Expected<Profile> profile = from_message(message.profile());
  if (!profile) return bad_input(profile.error().message, "profile." + profile.error().where);
  scenario.profile = std::move(*profile);
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
    return bad_input("bytes that are no scenarios");
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
      // The first one's parts go without its number: mostly there is only one.
      const std::string path = i == 0 ? "" : "campaigns[" + std::to_string(i) + "].";
      return bad_input(scenario.error().message, path + scenario.error().where);
    }
    scenarios.push_back(std::move(*scenario));
  }
  return scenarios;
}

}  // namespace swarmsmith
