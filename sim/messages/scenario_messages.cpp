#include "sim/messages/scenario_messages.h"

#include <cmath>

#include "proto/scenario.pb.h"
#include "sim/messages/mission_messages.h"

namespace swarmsmith {
namespace {

void write(const Profile& profile, pb::Profile& out) {
  out.set_name(profile.name);
  out.set_proximity_range_m(profile.proximity.range_m);
  out.set_proximity_sd_m(profile.proximity.sd_m);
  out.set_ground_color_sd(profile.ground_color.sd);
  switch (profile.contacts) {
    case ContactModel::Exact:
      out.set_contacts(pb::Profile::CONTACTS_EXACT);
      break;
    case ContactModel::Box2d:
      out.set_contacts(pb::Profile::CONTACTS_BOX2D);
      break;
  }
}

Expected<Profile> read(const pb::Profile& message) {
  Profile profile;
  profile.name = message.name();
  profile.proximity.range_m = message.proximity_range_m();
  profile.proximity.sd_m = message.proximity_sd_m();
  profile.ground_color.sd = message.ground_color_sd();
  for (const double number :
       {profile.proximity.range_m, profile.proximity.sd_m, profile.ground_color.sd}) {
    if (!std::isfinite(number) || number < 0) {
      return bad_input("a number of the profile is negative or not finite", "profile");
    }
  }
  if (message.contacts() != pb::Profile::CONTACTS_EXACT &&
      message.contacts() != pb::Profile::CONTACTS_BOX2D) {
    return bad_input("a contact model that this program does not know", "profile.contacts");
  }
  const bool exact = message.contacts() == pb::Profile::CONTACTS_EXACT;
  profile.contacts = exact ? ContactModel::Exact : ContactModel::Box2d;
  return profile;
}

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

}  // namespace

std::string to_bytes(const WorkerScenario& scenario) {
  pb::Scenario message;
  message.set_campaign_digest(scenario.campaign_digest);
  message.set_engine_version(scenario.engine_version);
  for (const Mission& mission : scenario.missions)
    to_message(mission, *message.add_missions());
  for (const WorkerMethod& method : scenario.methods)
    write(method, *message.add_methods());
  write(scenario.profile, *message.mutable_profile());
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
  for (int i = 0; i < message.methods_size(); ++i) {
    Expected<WorkerMethod> method = read(message.methods(i));
    if (!method) {
      const std::string path = "methods[" + std::to_string(i) + "].";
      return bad_input(method.error().message, path + method.error().where);
    }
    scenario.methods.push_back(std::move(*method));
  }
  Expected<Profile> profile = read(message.profile());
  if (!profile) return Unexpected(profile.error());
  scenario.profile = std::move(*profile);
  return scenario;
}

}  // namespace swarmsmith
