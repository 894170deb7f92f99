#include "proto/task_messages.h"

#include <tuple>

#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith {

std::optional<PackedKey> pack(const pb::Key& key) {
  if (!is_valid_key(key.candidate(), key.purpose(), key.pair())) return std::nullopt;
  if (key.campaign() >= kMaxCampaigns) return std::nullopt;
  return pack(key.candidate(), key.purpose(), key.pair(), key.campaign());
}

void unpack(PackedKey packed, pb::Key& key) {
  key.set_campaign(campaign_of(packed));
  key.set_candidate(candidate_of(packed));
  key.set_pair(static_cast<std::int64_t>(packed >> 3U & 0xfffffU));
  key.set_purpose(static_cast<std::int32_t>(packed & 7U));
}

LeasedTask task_of(const pb::Task& message) {
  return {{.mission = message.mission(),
           .method = message.method(),
           .profile = message.profile(),
           .instance = message.instance(),
           .seed = message.seed(),
           .machine = message.machine(),
           .bound = message.bound(),
           .alive = {message.alive().begin(), message.alive().end()}},
          *pack(message.key()),
          message.attempt(),
          message.signature(),
          message.alone()};
}

void write(const LeasedTask& task, pb::Task& message) {
  unpack(task.key, *message.mutable_key());
  message.set_attempt(task.attempt);
  message.set_signature(task.signature);
  message.set_alone(task.alone);
  message.set_mission(task.mission);
  message.set_method(task.method);
  message.set_profile(task.profile);
  message.set_instance(task.instance);
  message.set_seed(task.seed);
  message.set_machine(task.machine);
  message.set_bound(task.bound);
  message.mutable_alive()->Assign(task.alive.begin(), task.alive.end());
}

Result result_of(const pb::Result& message) {
  Measured measured;
  measured_fields(measured) =
      std::tuple(message.score() + 0.0, message.state_digest(), message.wall_us(), message.time());
  return {.key = *pack(message.key()),
          .attempt = message.attempt(),
          .measured = measured,
          .rejected = message.rejected(),
          .failure = message.failure(),
          .details = {message.command(), message.output(), message.errors()},
          .signature = message.signature()};
}

void write(const Result& result, pb::Result& message) {
  unpack(result.key, *message.mutable_key());
  message.set_attempt(result.attempt);
  message.set_signature(result.signature);
  const auto& [score, state_digest, wall_us, time] = result.measured;
  message.set_score(score);
  message.set_state_digest(state_digest);
  message.set_wall_us(wall_us);
  message.set_time(time);
  message.set_rejected(result.rejected);
  if (result.failure.empty()) return;
  message.set_failure(clipped_text(result.failure));
  message.set_command(clipped_text(result.details.command));
  message.set_output(clipped_text(result.details.output));
  message.set_errors(clipped_text(result.details.errors));
}

}  // namespace swarmsmith
