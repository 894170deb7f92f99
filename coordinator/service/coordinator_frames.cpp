// What peers send: who may say what, and who is not listened to any more.

#include <algorithm>

#include "coordinator/service/coordinator.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMaxFaults = 10'000;

}  // namespace

bool Coordinator::is_refused(PeerId peer, TimePoint now) {
  if (faults_.empty()) return false;
  const auto fault = faults_.find(peer);
  if (fault == faults_.end() || fault->second.count < options_.malformed_limit) return false;
  if (now < fault->second.refused_until) return true;
  faults_.erase(fault);
  return false;
}

void Coordinator::on_malformed(const Peer& peer, const Error& error, TimePoint now) {
  ++malformed_[error.where];
  ++malformed_count_;
  if (error.kind == ErrorKind::Conflict) {
    send(peer.id, frame_of(SendReject{peer.id, 0, RejectReason::Protocol, error.message}));
  }
  // Connections come and go; the memory of their faults is bounded.
  if (faults_.size() >= kMaxFaults) faults_.clear();
  Fault& fault = faults_[peer.id];
  if (++fault.count < options_.malformed_limit) return;
  fault.refused_until = now + options_.refuse_for;
  Noted noted{
      .campaign = std::nullopt,
      .row = {.severity = "warning",
              .kind = "peer refused",
              .text = event_text({{"frames", std::int64_t{fault.count}}, {"last", error.message}})},
      .source = principal_of(
          WorkerHello{.client = std::string(peer.client), .address = std::string(peer.address)})};
  put_event(noted, now);
  scheduler_.on_refused(peer.id, now);
}

void Coordinator::on_frame(const Peer& peer, std::string_view frame, TimePoint now) {
  if (is_refused(peer.id, now)) {
    ++malformed_count_;
    return;
  }
  const Expected<const pb::ToCoordinator*> message = decode_to_coordinator(frame, arena_);
  if (message) {
    on_message(peer, **message, now);
  } else {
    on_malformed(peer, message.error(), now);
  }
  arena_.Reset();
}

void Coordinator::on_message(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const auto forbidden = [&] {
    const std::string sentence = "the key \"" + std::string(peer.client) + "\" has a role that " +
                                 "does not allow this; `role` in clients.toml says which it is";
    // Whoever holds a listed key is told; strangers never come so far.
    send(peer.id,
         frame_of(SendReject{peer.id, message.incarnation(), RejectReason::Protocol, sentence}));
    on_malformed(peer, {ErrorKind::BadInput, sentence, "role"}, now);
  };
  if (message.has_command()) {
    return may_command(peer.role) ? on_command(peer, message.command(), now) : forbidden();
  }
  if (message.has_want_status()) {
    if (!may_read(peer.role)) return forbidden();
    if (budgets_.may_be_sent(peer.id, 0, now)) actions_.emplace_back(AnswerStatus{peer.id});
    return;
  }
  return may_work(peer.role) ? on_work(peer, message, now) : forbidden();
}

void Coordinator::on_work(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const Sender sender{peer.id, message.incarnation(), message.sequence()};
  switch (message.body_case()) {
    case pb::ToCoordinator::kHello:
      on_hello(peer, message, now);
      return;
    case pb::ToCoordinator::kCredit:
      scheduler_.on_credit(sender, message.credit().tasks(), now);
      return;
    case pb::ToCoordinator::kResults:
      on_results(peer, message, now);
      return;
    case pb::ToCoordinator::kHeartbeat:
      running_of(message.heartbeat(), running_);
      scheduler_.on_heartbeat(sender, message.heartbeat().credit(), running_, now,
                              slots_of(message.heartbeat()));
      return;
    case pb::ToCoordinator::kReturned:
      scheduler_.on_returned(sender, keys_of(message.returned()), now);
      return;
    case pb::ToCoordinator::kBegan:
      scheduler_.on_began(sender, *pack(message.began().key()), now);
      return;
    case pb::ToCoordinator::kGoodbye:
      scheduler_.on_goodbye(sender, now);
      return;
    case pb::ToCoordinator::kWantScenario:
      // A worker asks again.
      if (scheduler_.on_sign_of_life(sender, now) &&
          budgets_.may_be_sent(peer.id, facts_.scenario.size(), now)) {
        send(peer.id, scenario_reply_of(facts_, sender.incarnation));
      }
      return;
    case pb::ToCoordinator::kCommand:
    case pb::ToCoordinator::kWantStatus:
    case pb::ToCoordinator::BODY_NOT_SET:
      scheduler_.on_sign_of_life(sender, now);
      return;
  }
}

/// One that is not heard is said again, on another connection.
void Coordinator::on_hello(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const bool is_local = same_secret(message.hello().secret(), options_.local_secret);
  if (!is_local) {
    const std::string name = principal_of(
        WorkerHello{.client = std::string(peer.client), .address = std::string(peer.address)});
    const Principal* known = scheduler_.principals().find(name);
    const Source source{name, known == nullptr || known->is_stranger()};
    if (!budgets_.may_say_hello(peer.id, source, now)) return;
  }
  WorkerHello hello = hello_of(message.hello(), message.incarnation(), facts_.scenario_digest);
  hello.client = peer.client;
  hello.address = peer.address;
  hello.local = is_local;
  scheduler_.on_hello(peer.id, std::move(hello), now);
}

void Coordinator::on_results(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  // Of another campaign that ran here before: nobody wants them.
  if (message.results().scenario() != facts_.scenario_digest) {
    on_malformed(peer, {ErrorKind::BadInput, "results of another campaign", "campaign"}, now);
    return;
  }
  results_of(message.results(), results_);
  scheduler_.on_results({peer.id, message.incarnation(), message.sequence()}, results_, now);
}

void Coordinator::on_unreachable(const SendFrame& unsent, TimePoint now) {
  faults_.erase(unsent.peer);
  scheduler_.on_unreachable(unsent.peer, now, unsent.leases);
}

void Coordinator::on_cut_off(PeerId peer, TimePoint now) {
  faults_.erase(peer);
  scheduler_.on_refused(peer, now);
}

void Coordinator::on_tick(TimePoint now) {
  scheduler_.on_tick(now);
  sample_due_ = true;
}

}  // namespace swarmsmith
