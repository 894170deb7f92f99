// Hostile peers among the simulated connections, and what must never come of them.

#include <algorithm>
#include <array>
#include <string_view>

#include "coordinator/pool/task_key.h"
#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "storage/answer.h"
#include "tests/cluster/simulated_cluster.h"

namespace swarmsmith::cluster {
namespace {

constexpr std::string_view kHostile = "hostile";
constexpr std::string_view kElsewhere = "10.0.0.99";
constexpr std::array<std::string_view, 3> kAddresses = {"10.0.0.1", "10.0.0.2", "10.0.0.3"};

using std::chrono::microseconds;
using std::chrono::milliseconds;

}  // namespace

void SimulatedCluster::invite_strangers() {
  for (std::size_t i = 0; i < schedule_.hostile.size(); ++i) {
    const Oracle oracle = [this](const pb::Task& task) {
      const CampaignShape& shape = campaigns_.at(task.key().campaign()).shape;
      return truth_of(shape, task_of(task));
    };
    strangers_.push_back(
        {.peer = HostilePeer(schedule_.hostile[i], rng_.split("stranger", i), oracle)});
    at(now_ + between(Duration{0}, schedule_.faults.until / 2), [this, i] { visit(i); });
    tick_stranger(i);
  }
}

/// Comes (again), until all faults are over.
void SimulatedCluster::visit(std::size_t index) {
  Stranger& stranger = strangers_[index];
  if (now_ >= faults_end_ || stranger.connection != 0) return;
  if (!coordinator_process_.alive || !stranger.peer.knows_the_words()) {
    at(now_ + milliseconds(20), [this, index] { visit(index); });
    return;
  }
  stranger.connection = ++peers_;
  connections_[stranger.connection] = {.worker = kNoWorker,
                                       .stranger = index,
                                       .coordinator_life = coordinator_process_.life,
                                       .open = true};
  stranger.peer.on_connected();
  settle_stranger(index);
}

void SimulatedCluster::tick_stranger(std::size_t index) {
  at(now_ + between(milliseconds(2), milliseconds(30)), [this, index] {
    Stranger& stranger = strangers_[index];
    if (now_ >= faults_end_) return hang_up(index);
    if (stranger.connection != 0) {
      stranger.peer.on_tick();
      settle_stranger(index);
    }
    tick_stranger(index);
  });
}

void SimulatedCluster::settle_stranger(std::size_t index) {
  Stranger& stranger = strangers_[index];
  for (std::string& frame : stranger.peer.take_frames()) {
    ++connections_.at(stranger.connection).unread;
    on_process(kCoordinator, between(microseconds(30), microseconds(300)),
               [this, from = stranger.connection, frame = std::move(frame)] {
                 frame_arrives(stranger_at(from), frame);
               });
  }
  if (!stranger.peer.take_hang_up()) return;
  hang_up(index);
  at(now_ + between(milliseconds(1), milliseconds(60)), [this, index] { visit(index); });
}

void SimulatedCluster::hang_up(std::size_t index) {
  Stranger& stranger = strangers_[index];
  if (stranger.connection != 0) connections_[stranger.connection].open = false;
  stranger.connection = 0;
}

/// The coordinator's process is gone, and all of its connections.
void SimulatedCluster::cut_strangers_off() {
  for (std::size_t i = 0; i < strangers_.size(); ++i) {
    hang_up(i);
    at(now_ + between(milliseconds(1), milliseconds(60)), [this, i] { visit(i); });
  }
}

/// Also of what never arrives, since its connection is closed: the lease is its principal's until
/// the coordinator knows that, and another stranger of the same one may answer it by a guess.
void SimulatedCluster::note_leases_of_strangers(const std::string& frame) {
  google::protobuf::Arena arena;
  if (const auto message = decode_to_worker(frame, arena); message && (*message)->has_tasks()) {
    for (const pb::Task& task : (*message)->tasks().tasks())
      leased_to_strangers_.insert(*pack(task.key()));
  }
}

void SimulatedCluster::to_stranger(PeerId peer, const std::string& frame) {
  at(now_ + between(microseconds(30), microseconds(300)), [this, peer, frame] {
    const std::size_t index = connections_.at(peer).stranger;
    if (strangers_[index].connection != peer) return;
    strangers_[index].peer.on_frame(frame);
    settle_stranger(index);
  });
}

/// With a key of their own, and the address of a worker; without keys, from one address.
Peer SimulatedCluster::stranger_at(PeerId connection) const {
  if (!schedule_.keys) return {.id = connection, .address = kElsewhere};
  return {.id = connection, .role = Role::Worker, .client = kHostile, .address = kAddresses[0]};
}

/// Every worker is on a host of its own.
Peer SimulatedCluster::worker_at(PeerId connection) const {
  const auto worker = static_cast<std::size_t>(connections_.at(connection).worker);
  if (!schedule_.keys) return {.id = connection, .address = kAddresses[worker]};
  return {
      .id = connection, .role = Role::Worker, .client = "honest", .address = kAddresses[worker]};
}

/// A worker alone cannot reject an evaluation that has a score, and wrong scores come only from
/// workers that had a lease.
void SimulatedCluster::check_row(const Running& running, const Row& row) {
  const auto* evaluation = std::get_if<EvaluationRow>(&row);
  if (evaluation == nullptr) return;
  const EvaluationKey key = evaluation->key;
  const auto campaign = static_cast<std::uint32_t>(&running - campaigns_.data());
  const PackedKey packed = pack(key, campaign);
  const auto truth = running.truths.find(pack(key));
  if (truth == running.truths.end()) return fail("a row of an evaluation that was not asked for");
  const bool has_score = truth->second.kind == Truth::Kind::Score;
  if (evaluation->status == EvaluationStatus::Rejected) {
    // Once a lie has turned a race, a crash may bring another machine under the same number.
    if (has_score && lies_.empty()) fail("rejected what has a score: " + to_string(key));
    return;
  }
  const bool is_true = has_score && evaluation->measured.score == truth->second.score &&
                       evaluation->measured.state_digest == truth->second.state_digest;
  if (is_true) return;
  if (!leased_to_strangers_.contains(packed))
    fail("stored a wrong score from a worker without a lease: " + to_string(key));
  lies_.insert(packed);
}

void SimulatedCluster::check_trust() {
  for (const auto& [number, entry] : coordinator_->scheduler().workers().all()) {
    // A stranger may come under id and host of another worker, but neither with its key nor from
    // its address.
    const bool is_honest = entry.hello.client != kHostile && entry.hello.address != kElsewhere;
    if (is_honest && entry.quarantined) fail("an honest worker is in quarantine");
  }
}

/// A person lets hostile peers work again, under any principal.
void SimulatedCluster::forgive() {
  const auto quarantined = [this] {
    return !coordinator_->quarantine(clock(kCoordinator)).empty();
  };
  const bool had = quarantined();
  pb::ToCoordinator message;
  message.mutable_command()->set_kind(pb::Command::KIND_FORGIVE);
  message.mutable_command()->set_whom(std::string(schedule_.keys ? kHostile : kElsewhere));
  coordinator_->on_frame({kPerson, Role::Operator}, encode(message), clock(kCoordinator));
  if (quarantined()) fail("hostile peers are in quarantine after they were forgiven");
  forgiven_ += had ? 1 : 0;
  settle_coordinator();
}

/// Only who was asked and lies can bring the campaign there, and it says why. Several strangers of
/// one principal answer for each other's leases.
void SimulatedCluster::on_stopped(const std::string& reason, bool distrusted) {
  const bool may_lie = std::ranges::any_of(schedule_.hostile, [&](Misdeed misdeed) {
    return misdeed == Misdeed::Lies || misdeed == Misdeed::LiesLater ||
           misdeed == Misdeed::Renames || misdeed == Misdeed::TalksAtRandom ||
           (misdeed == Misdeed::Guesses && schedule_.hostile.size() > 1);
  });
  if (!may_lie || !distrusted || reason.empty()) fail("stopped: " + reason);
  stopped_ = reason;
}

/// Another answer than an honest cluster's, and the campaign did not stop: only where not every
/// score is made again, so that lies may have been lucky, or where it said that it left some out.
bool SimulatedCluster::is_excused() {
  if (lies_.empty() || (schedule_.audit_every == 1 && !left_out_audits_)) return false;
  escaped_ = true;
  return true;
}

std::uint64_t SimulatedCluster::acts(Misdeed misdeed) const {
  std::uint64_t sum = 0;
  for (const Stranger& stranger : strangers_) {
    if (stranger.peer.misdeed() == misdeed) sum += stranger.peer.acts();
  }
  return sum;
}

}  // namespace swarmsmith::cluster
