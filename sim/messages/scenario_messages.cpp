#include "sim/messages/scenario_messages.h"

#include "proto/scenario.pb.h"
#include "sim/messages/mission_messages.h"
#include "sim/messages/profile_messages.h"

namespace swarmsmith {

std::string to_bytes(const WorkerScenario& scenario) {
  pb::Scenario message;
  message.set_campaign_digest(scenario.campaign_digest);
  message.set_engine_version(scenario.engine_version);
  for (const Mission& mission : scenario.missions)
    to_message(mission, *message.add_missions());
  for (const std::string& flavour : scenario.flavours)
    message.add_methods()->set_flavour(flavour);
  to_message(scenario.profile, *message.mutable_profile());
  return message.SerializeAsString();
}

Expected<WorkerScenario> scenario_from_bytes(std::string_view bytes) {
  pb::Scenario message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return bad_input("bytes that are no scenario");
  }
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
  for (const pb::Method& method : message.methods())
    scenario.flavours.push_back(method.flavour());
  Expected<Profile> profile = from_message(message.profile());
  if (!profile) return bad_input(profile.error().message, "profile." + profile.error().where);
  scenario.profile = std::move(*profile);
  return scenario;
}

}  // namespace swarmsmith
