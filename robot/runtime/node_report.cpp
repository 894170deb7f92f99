// What a node says of itself and its run: its state, and the head of its log.

#include <chrono>

#include "robot/runtime/node.h"
#include "sim/control/flavour_file.h"

namespace swarmsmith {

NodeState RobotNode::state(const Now& now) const {
  NodeState state{.robot = settings_.robot,
                  .phase = phase_,
                  .run = run_,
                  .cycle = cycle_,
                  .machine_digest = machine_digest_,
                  .flavour = flavour_->name,
                  .own_robot = own_robot_,
                  .turn_clock = std::string(name_of(flavour_->exploration.turn_clock)),
                  .seed = is_on() ? seed_ : settings_.seed,
                  .robot_index = settings_.robot_index,
                  .version = settings_.version,
                  .scheduling = settings_.scheduling,
                  .age_ms = {},
                  .held = held_,
                  .skipped = skipped_,
                  .battery = battery_,
                  .verdict = verdict_,
                  .reasons = reasons_,
                  .not_ready = not_ready(now.clock),
                  .log_trouble = log_trouble_,
                  .log_open = log_open_,
                  .order = order_,
                  .refused = refused_,
                  .start_unix_s = is_on() ? start_unix_s_ : 0,
                  .clock_s = seconds_of(now.clock.time_since_epoch()),
                  .unix_s = now.unix_s};
  using Milliseconds = std::chrono::duration<double, std::milli>;
  for (const Feed feed : kAllFeeds) {
    if (!needed_[index_of(feed)]) continue;
    const auto age = feeds_.age(feed, now.clock);
    state.age_ms[index_of(feed)] = age ? Milliseconds(*age).count() : -1;
  }
  return state;
}

void RobotNode::note_driver(RunEnd& end) const {
  end.driven = driver_.is_told();
  if (!*end.driven) return;
  // This is the verdict on the driver alone; the tracker reads it from the log, next to the run's
  // own.
  if (by_driver_.cycles > 0 || !driver_.doubts().empty()) end.driver = RunVerdict::Degraded;
  if (driver_failed_) end.driver = RunVerdict::Invalid;
  end.driver_off_s = seconds_of(driver_.longest_off());
}

LogHead RobotNode::head() const {
  LogHead head{.run = run_,
               .robot = settings_.robot,
               .robot_index = settings_.robot_index,
               .machine = machine_text_,
               .machine_digest = machine_digest_,
               .flavour = flavour_->name,
               .own_flavour = own_flavour_text(*flavour_),
               .own_robot = own_robot_,
               .turn_clock = std::string(name_of(flavour_->exploration.turn_clock)),
               .seed = seed_,
               .lock_step = lock_step_,
               .period_s = seconds_of(settings_.period),
               .seconds = seconds_,
               .max_mps = settings_.max_mps,
               .program = settings_.version,
               .host = settings_.host,
               .scheduling = settings_.scheduling,
               .topics = settings_.topics,
               .start_clock_s = clock_ ? seconds_of(clock_->start().time_since_epoch()) : 0,
               .start_unix_s = start_unix_s_,
               .clock_offset_s = clock_offset_s_,
               .end = {}};
  if (phase_ == Phase::Ended || phase_ == Phase::Stopped || phase_ == Phase::Failed) {
    head.end = RunEnd{.state = std::string(name_of(phase_)),
                      .verdict = verdict_,
                      .reasons = reasons_,
                      .stepped = stepped_,
                      .held = held_,
                      .skipped = skipped_};
    if (!lock_step_) note_driver(*head.end);
  }
  return head;
}

}  // namespace swarmsmith
