#include "tests/support/hostile_peer.h"

#include <google/protobuf/arena.h>

#include <algorithm>
#include <utility>

#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith::cluster {
namespace {

/// Frames and tasks that it remembers.
constexpr std::size_t kMemory = 200;
/// Results under one id of a peer that changes it.
constexpr int kResultsOfAName = 4;
constexpr int kFlood = 100;
constexpr int kTrueAtFirst = 12;

void remember(std::deque<std::string>& frames, const std::string& frame) {
  frames.push_back(frame);
  if (frames.size() > kMemory) frames.pop_front();
}

std::string random_id(Rng& rng) {
  std::string id(kWorkerIdBytes, '\0');
  for (char& letter : id)
    letter = static_cast<char>(rng.below(256));
  return id;
}

}  // namespace

const char* name_of(Misdeed misdeed) {
  switch (misdeed) {
    case Misdeed::Lies:
      return "lies";
    case Misdeed::LiesLater:
      return "lies later";
    case Misdeed::Rejects:
      return "rejects";
    case Misdeed::Fails:
      return "fails";
    case Misdeed::Guesses:
      return "guesses";
    case Misdeed::Replays:
      return "replays";
    case Misdeed::Floods:
      return "floods";
    case Misdeed::Renames:
      return "renames";
    case Misdeed::LeavesWithLeases:
      return "leaves with leases";
    case Misdeed::LeavesAlone:
      return "leaves alone";
    case Misdeed::ClaimsLeases:
      return "claims leases";
    case Misdeed::TalksNonsense:
      return "talks nonsense";
    case Misdeed::TalksAtRandom:
      return "talks at random";
  }
  return "";
}

HostilePeer::HostilePeer(Misdeed misdeed, Rng rng, Oracle oracle)
    : misdeed_(misdeed), rng_(std::move(rng)), oracle_(std::move(oracle)) {}

void HostilePeer::overhear(const std::string& frame) {
  remember(overheard_, frame);
  google::protobuf::Arena arena;
  const auto message = decode_to_coordinator(frame, arena);
  if (!message || !(*message)->has_hello() || knows_the_words()) return;
  hello_ = (*message)->hello();
  hello_.clear_holds();
  hello_.set_worker_id(random_id(rng_));
  hello_.set_slots(static_cast<std::uint32_t>(rng_.uniform_int(1, 4)));
  if (rng_.bernoulli(0.5)) hello_.set_host("elsewhere");
}

void HostilePeer::on_connected() {
  held_.clear();
  frames_.clear();
  hangs_up_ = false;
  const bool changes_its_name =
      misdeed_ == Misdeed::Renames || (misdeed_ == Misdeed::LeavesAlone && rng_.bernoulli(0.8));
  if (changes_its_name) {
    hello_.set_worker_id(random_id(rng_));
    incarnation_ = 0;
    answered_ = 0;
  }
  say_hello(misdeed_ == Misdeed::ClaimsLeases);
}

void HostilePeer::on_frame(std::string_view frame) {
  google::protobuf::Arena arena;
  const auto message = decode_to_worker(frame, arena);
  if (!message) return;
  if ((*message)->has_welcome()) {
    scenario_ = (*message)->welcome().scenario();
    hello_.set_scenario(scenario_);
    // Who claims holds as much as it was given.
    if (misdeed_ != Misdeed::ClaimsLeases) say_credit(misdeed_ == Misdeed::LeavesAlone ? 1 : 8);
  } else if ((*message)->has_who_are_you()) {
    if (rng_.bernoulli(0.5)) say_hello();
  } else if ((*message)->has_tasks()) {
    on_tasks((*message)->tasks());
  }
}

void HostilePeer::on_tasks(const pb::Tasks& tasks) {
  for (const pb::Task& task : tasks.tasks()) {
    held_.push_back(task);
    if (held_.size() > kMemory) held_.pop_front();
  }
  switch (misdeed_) {
    case Misdeed::Lies:
    case Misdeed::LiesLater:
    case Misdeed::Rejects:
    case Misdeed::Fails:
    case Misdeed::Renames:
    case Misdeed::Replays:
      return answer(tasks);
    case Misdeed::LeavesWithLeases:
      ++acts_;
      return hang_up();
    case Misdeed::LeavesAlone:
      if (tasks.tasks_size() > 1) return give_back(tasks);
      if (rng_.bernoulli(0.7)) say_began(tasks.tasks(0));
      ++acts_;
      return hang_up();
    case Misdeed::Guesses:
    case Misdeed::Floods:
    case Misdeed::ClaimsLeases:
    case Misdeed::TalksNonsense:
    case Misdeed::TalksAtRandom:
      return;
  }
}

void HostilePeer::answer(const pb::Tasks& tasks) {
  pb::ToCoordinator message;
  message.mutable_results()->set_scenario(scenario_);
  for (const pb::Task& task : tasks.tasks()) {
    pb::Result result = result_of(task);
    if (misdeed_ == Misdeed::Rejects) {
      result.set_rejected(true);
      ++acts_;
    } else if (misdeed_ == Misdeed::Fails) {
      result.set_failure("because");
      ++acts_;
    } else if (is_honest_now()) {
      const Truth truth = oracle_(task);
      result.set_score(truth.score);
      result.set_state_digest(truth.state_digest);
      if (truth.kind != Truth::Kind::Score) result.set_failure("planted");
    } else {
      lie(result);
      ++acts_;
    }
    *message.mutable_results()->add_results() = std::move(result);
  }
  say(std::move(message));
  answered_ += tasks.tasks_size();
  if (misdeed_ == Misdeed::Renames && answered_ >= kResultsOfAName) hang_up();
}

/// Those that come to their evil deeds later, and those that replay what was true.
bool HostilePeer::is_honest_now() {
  if (!oracle_) return false;
  ++truths_;
  if (misdeed_ == Misdeed::LiesLater) return truths_ <= kTrueAtFirst || rng_.bernoulli(0.3);
  return misdeed_ == Misdeed::Replays;
}

pb::Result HostilePeer::result_of(const pb::Task& task) {
  pb::Result result;
  *result.mutable_key() = task.key();
  result.set_attempt(task.attempt());
  result.set_signature(task.signature());
  result.set_wall_us(rng_.uniform_int(1, 30'000));
  return result;
}

void HostilePeer::lie(pb::Result& result) {
  result.set_score(3 * rng_.uniform() + rng_.normal());
  result.set_state_digest(rng_.next());
}

/// Of a task that there may be: a neighbour of one that it was leased, or any early one.
pb::Key HostilePeer::guess() {
  pb::Key key;
  if (!held_.empty() && rng_.bernoulli(0.5)) {
    key = held_[rng_.below(held_.size())].key();
    key.set_candidate(std::max<std::int64_t>(1, key.candidate() + rng_.uniform_int(-3, 5)));
    key.set_pair(std::max<std::int64_t>(1, key.pair() + rng_.uniform_int(-1, 1)));
    return key;
  }
  const std::int64_t design = rng_.uniform_int(0, 1);
  key.set_candidate(design * 1'000'000 + rng_.uniform_int(1, 30));
  key.set_pair(rng_.uniform_int(1, 10));
  key.set_purpose(rng_.bernoulli(0.1) ? kTestPurpose : 0);
  return key;
}

void HostilePeer::guess_results() {
  pb::ToCoordinator message;
  message.mutable_results()->set_scenario(scenario_);
  for (int i = 0; i < 20; ++i) {
    pb::Result& result = *message.mutable_results()->add_results();
    // Another worker's task, as it was sent once, or one that was never sent.
    *result.mutable_key() = guess();
    result.set_attempt(rng_.uniform_int(0, 3));
    lie(result);
    if (rng_.bernoulli(0.2)) result.set_rejected(true);
    if (rng_.bernoulli(0.2)) result.set_failure("because");
    ++acts_;
  }
  say(std::move(message));
}

/// As it was said, and as if it were of this connection.
void HostilePeer::replay() {
  const std::deque<std::string>& from = rng_.bernoulli(0.5) ? overheard_ : said_;
  if (from.empty()) return;
  const std::string frame = from[rng_.below(from.size())];
  ++acts_;
  if (rng_.bernoulli(0.3)) return frames_.push_back(frame);
  google::protobuf::Arena arena;
  const auto message = decode_to_coordinator(frame, arena);
  if (!message || (*message)->has_goodbye()) return;
  say(**message);
}

void HostilePeer::give_back(const pb::Tasks& tasks) {
  pb::ToCoordinator message;
  for (const pb::Task& task : tasks.tasks())
    *message.mutable_returned()->add_keys() = task.key();
  say(std::move(message));
  say_credit(1);
}

/// Of its own leases and of others': that they run for ever, that it gives them back.
void HostilePeer::talk_nonsense() {
  ++acts_;
  const auto some_key = [&] {
    return held_.empty() || rng_.bernoulli(0.5) ? guess() : held_[rng_.below(held_.size())].key();
  };
  pb::ToCoordinator message;
  if (rng_.bernoulli(0.7)) {
    pb::Heartbeat& heartbeat = *message.mutable_heartbeat();
    heartbeat.set_credit(static_cast<std::uint32_t>(rng_.below(64)));
    heartbeat.set_held(static_cast<std::uint32_t>(rng_.below(64)));
    heartbeat.set_slot_us(rng_.below(std::uint64_t{1} << 50U));
    heartbeat.set_busy_us(rng_.below(std::uint64_t{1} << 50U));
    for (int i = 0; i < 8; ++i) {
      pb::Running& running = *heartbeat.add_running();
      *running.mutable_key() = some_key();
      running.set_elapsed_ms(rng_.bernoulli(0.5) ? 40'000 : rng_.uniform_int(0, 30'000));
    }
  } else {
    for (int i = 0; i < 8; ++i)
      *message.mutable_returned()->add_keys() = some_key();
  }
  say(std::move(message));
}

void HostilePeer::talk_at_random() {
  ++acts_;
  pb::ToCoordinator message;
  switch (rng_.below(9)) {
    case 0:
      return say_hello(rng_.bernoulli(0.5));
    case 1:
      return say_credit(static_cast<std::uint32_t>(rng_.below(5000)));
    case 2:
      return guess_results();
    case 3:
      return talk_nonsense();
    case 4:
      return replay();
    case 5:
      return hang_up();
    case 6:
      message.mutable_goodbye();
      break;
    case 7:
      message.mutable_want_scenario();
      break;
    default: {
      message.mutable_results()->set_scenario(scenario_);
      const std::size_t most = std::min<std::size_t>(held_.size(), 4);
      for (std::size_t i = 0; i < most; ++i) {
        pb::Result& result = *message.mutable_results()->add_results();
        result = result_of(held_[i]);
        if (rng_.bernoulli(0.5))
          result.set_rejected(true);
        else
          result.set_failure("because");
      }
    }
  }
  say(std::move(message));
}

void HostilePeer::on_tick() {
  switch (misdeed_) {
    case Misdeed::Guesses:
      return guess_results();
    case Misdeed::ClaimsLeases:
      // A connection that claims what it heard of, and one that answers it.
      if (rng_.bernoulli(0.3)) return hang_up();
      return guess_results();
    case Misdeed::Replays:
      return replay();
    case Misdeed::Floods:
      if (!rng_.bernoulli(0.1)) return;
      for (int i = 0; i < kFlood; ++i)
        talk_nonsense();
      return;
    case Misdeed::TalksNonsense:
      return talk_nonsense();
    case Misdeed::TalksAtRandom:
      return talk_at_random();
    case Misdeed::Lies:
    case Misdeed::LiesLater:
    case Misdeed::Rejects:
    case Misdeed::Fails:
    case Misdeed::Renames:
    case Misdeed::LeavesWithLeases:
    case Misdeed::LeavesAlone: {
      // These do their deeds when they are asked to work; this keeps them there.
      pb::ToCoordinator message;
      message.mutable_heartbeat()->set_credit(misdeed_ == Misdeed::LeavesAlone ? 1 : 8);
      return say(std::move(message));
    }
  }
}

void HostilePeer::say(pb::ToCoordinator message) {
  message.set_sequence(++sequence_);
  message.set_incarnation(incarnation_);
  frames_.push_back(encode(message));
  remember(said_, frames_.back());
}

void HostilePeer::say_hello(bool with_claims) {
  ++incarnation_;
  pb::ToCoordinator message;
  *message.mutable_hello() = hello_;
  for (int i = 0; with_claims && i < 30; ++i) {
    *message.mutable_hello()->add_holds() = guess();
    message.mutable_hello()->add_attempts(rng_.uniform_int(0, 3));
    message.mutable_hello()->add_signatures(rng_.next());
  }
  say(std::move(message));
}

void HostilePeer::say_credit(std::uint32_t tasks) {
  pb::ToCoordinator message;
  message.mutable_credit()->set_tasks(tasks);
  say(std::move(message));
}

void HostilePeer::say_began(const pb::Task& task) {
  pb::ToCoordinator message;
  *message.mutable_began()->mutable_key() = task.key();
  say(std::move(message));
}

void HostilePeer::hang_up() {
  hangs_up_ = true;
}

}  // namespace swarmsmith::cluster
