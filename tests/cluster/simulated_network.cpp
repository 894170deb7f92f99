#include "tests/cluster/simulated_cluster.h"

#include <algorithm>

#include "coordinator/service/paused_designs.h"
#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith::cluster {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

}  // namespace

void SimulatedCluster::transmit(int from, int to, PeerId connection, std::string frame) {
  const bool faulty = now_ < faults_end_;
  const bool cut = now_ < process(from).cut_out_until || now_ < process(to).cut_in_until;
  if (cut || (faulty && rng_.bernoulli(schedule_.faults.loss))) return;
  const int copies = faulty && rng_.bernoulli(schedule_.faults.doubled) ? 2 : 1;
  for (int i = 0; i < copies; ++i) {
    const bool late = faulty && rng_.bernoulli(schedule_.faults.late);
    Duration delay =
        late ? between(milliseconds(1), seconds(4)) : between(microseconds(30), microseconds(300));
    Connection& over = connections_.at(connection);
    if (!late) {
      TimePoint& last = to == kCoordinator ? over.to_coordinator : over.to_worker;
      last = std::max(last, now_ + delay);
      delay = last - now_;
    }
    if (to == kCoordinator) ++over.unread;
    on_process(to, delay, [this, to, connection, frame] {
      if (to == kCoordinator) return frame_arrives(worker_at(connection), frame);
      Worker& worker = workers_[static_cast<std::size_t>(to)];
      if (worker.connection != connection) return;
      worker.protocol->on_frame(frame, clock(to));
      settle_worker(to);
    });
  }
}

void SimulatedCluster::frame_arrives(const Peer& peer, const std::string& frame) {
  Connection& over = connections_.at(peer.id);
  --over.unread;
  if (over.coordinator_life != coordinator_process_.life) return;
  coordinator_->on_frame(peer, frame, clock(kCoordinator));
  settle_coordinator();
}

/// A connection that is closed is seen at once, and what was said before may still be on its way.
bool SimulatedCluster::judge_gone() {
  const bool all_read =
      std::ranges::all_of(gone_, [this](PeerId peer) { return connections_.at(peer).unread == 0; });
  if (gone_.empty() || !all_read) return false;
  gone_.clear();
  coordinator_->on_all_read(clock(kCoordinator));
  return true;
}

void SimulatedCluster::connect(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  if (worker.connection != 0) connections_[worker.connection].open = false;
  worker.connection = ++peers_;
  connections_[worker.connection] = {.worker = index,
                                     .worker_life = worker.process.life,
                                     .coordinator_life = coordinator_process_.life,
                                     .open = coordinator_process_.alive};
  if (coordinator_process_.alive) return;
  on_process(index, milliseconds(1), [this, index, connection = worker.connection] {
    Worker& it = workers_[static_cast<std::size_t>(index)];
    if (it.connection != connection) return;
    it.protocol->on_connection_lost(clock(index));
    settle_worker(index);
  });
}

void SimulatedCluster::to_coordinator(int index, std::string frame) {
  const PeerId connection = workers_[static_cast<std::size_t>(index)].connection;
  for (Stranger& stranger : strangers_)
    stranger.peer.overhear(frame);
  if (connections_.at(connection).open) transmit(index, kCoordinator, connection, std::move(frame));
}

SendStatus SimulatedCluster::to_worker(PeerId peer, const std::string& frame) {
  const Connection& connection = connections_.at(peer);
  if (connection.worker == kNoWorker) note_leases_of_strangers(frame);
  if (!connection.open) return SendStatus::Gone;
  if (connection.worker == kNoWorker) {
    to_stranger(peer, frame);
    return SendStatus::Sent;
  }
  const Process& worker = process(connection.worker);
  if (!worker.alive || worker.life != connection.worker_life) return SendStatus::Sent;  // silence
  transmit(kCoordinator, connection.worker, peer, frame);
  return SendStatus::Sent;
}

/// Acknowledged means durable; failures are sent without a row.
void SimulatedCluster::check_acknowledged(const std::string& frame) {
  google::protobuf::Arena arena;
  const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena);
  if (!message) return fail("the coordinator sent a frame that is malformed");
  for (const pb::Key& key : (*message)->acknowledged().keys()) {
    const PackedKey packed = *pack(key);
    const Running& running = campaigns_.at(campaign_of(packed));
    const SimulatedDisk& disk = running.disk;
    // What is not wanted any more need not be kept: of a campaign that has stopped, nothing.
    if (disk.finished() || running.source->is_void(packed)) continue;
    if (coordinator_->stopped(campaign_of(packed))) continue;
    if (disk.holds(packed)) {
      acknowledged_.insert(packed);
    } else if (!failed_.contains(packed)) {
      fail("acknowledged what is not on disk");
    }
  }
}

/// Of a coordinator that has died: the next one finds all of it.
void SimulatedCluster::check_promises() {
  for (const PackedKey key : acknowledged_) {
    if (!campaigns_.at(campaign_of(key)).disk.holds(key)) fail("an acknowledged result is lost");
  }
  if (campaigns_.front().disk.commands().size() < confirmed_) fail("a confirmed command is lost");
}

/// The client hears when it is on disk: what the disk has is what will be after a crash.
void SimulatedCluster::check_confirmed(const std::string& frame) {
  google::protobuf::Arena arena;
  const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena);
  if (!message || !(*message)->has_command_reply()) return fail("no reply to a command");
  const auto is_command = [](const Row& row) { return std::holds_alternative<CommandRow>(row); };
  const Running& running = campaigns_.front();
  const bool more = std::ranges::any_of(running.uncommitted, [&](const Batch& batch) {
    return std::ranges::any_of(batch.rows, is_command);
  });
  if (more) return;
  if (paused_designs(running.disk.commands()) != coordinator_->paused())
    fail("what a person was told of is not on disk");
  confirmed_ = running.disk.commands().size();
}

}  // namespace swarmsmith::cluster
