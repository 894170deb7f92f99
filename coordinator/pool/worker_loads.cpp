#include "coordinator/pool/worker_loads.h"

#include "base/assert.h"

namespace swarmsmith {
namespace {

const WorkerLoad kNothing;

void put(std::set<WorkerNumber>& workers, WorkerNumber worker, bool was_in, bool is_in) {
  if (was_in == is_in) return;
  if (is_in) {
    workers.insert(worker);
  } else {
    workers.erase(worker);
  }
}

}  // namespace

/// All changes go through here: sums and sets follow from the load before and after the change, so
/// no call walks over all workers.
template <class Change>
void WorkerLoads::change(WorkerNumber worker, const Change& make) {
  const auto at = loads_.try_emplace(worker).first;
  WorkerLoad& load = at->second;
  const std::size_t room = load.room();
  const std::size_t idle = load.idle();
  make(load);
  SWARMSMITH_ASSERT(load.ahead <= load.leases.size(), "look-ahead is among the leases");
  room_ += load.room() - room;
  idle_ += load.idle() - idle;
  put(with_room_, worker, room > 0, load.room() > 0);
  put(with_idle_, worker, idle > 0, load.idle() > 0);
  // A worker that left and holds nothing leaves no trace.
  if (load.slots == 0 && load.held() == 0) loads_.erase(at);
}

void WorkerLoads::set_capacity(WorkerNumber worker, std::size_t slots, std::size_t credit) {
  change(worker, [&](WorkerLoad& load) {
    load.slots = slots;
    load.credit = credit;
    if (slots == 0) load.lingering.clear();
  });
}

WorkerLoads::Place WorkerLoads::lease(WorkerNumber worker, PackedKey key, bool ahead) {
  Place place;
  change(worker, [&](WorkerLoad& load) {
    place = load.leases.insert(load.leases.end(), key);
    if (ahead) ++load.ahead;
    // A new lease of the task replaces the old one there, so it takes one place only.
    load.lingering.erase(key);
  });
  return place;
}

void WorkerLoads::end(WorkerNumber worker, Place place, bool ahead) {
  change(worker, [&](WorkerLoad& load) {
    load.leases.erase(place);
    SWARMSMITH_ASSERT(!ahead || load.ahead > 0, "a look-ahead lease was counted as one");
    if (ahead) --load.ahead;
  });
}

void WorkerLoads::promote(WorkerNumber worker) {
  change(worker, [](WorkerLoad& load) {
    SWARMSMITH_ASSERT(load.ahead > 0, "a lease that is promoted was look-ahead");
    --load.ahead;
  });
}

void WorkerLoads::linger(WorkerNumber worker, PackedKey key, TimePoint since) {
  if (of(worker).slots == 0) return;  // the worker has gone
  change(worker, [&](WorkerLoad& load) { load.lingering.emplace(key, since); });
}

bool WorkerLoads::renew_lingering(WorkerNumber worker, PackedKey key, TimePoint now) {
  const auto load = loads_.find(worker);
  if (load == loads_.end()) return false;
  const auto at = load->second.lingering.find(key);
  // Only the time changes, so neither room nor idle slots do.
  if (at == load->second.lingering.end()) return false;
  at->second = now;
  return true;
}

bool WorkerLoads::settle(WorkerNumber worker, PackedKey key) {
  if (of(worker).lingering.empty()) return false;
  bool lingered = false;
  change(worker, [&](WorkerLoad& load) { lingered = load.lingering.erase(key) > 0; });
  return lingered;
}

void WorkerLoads::settle_older(WorkerNumber worker, TimePoint than) {
  if (of(worker).lingering.empty()) return;
  change(worker, [&](WorkerLoad& load) {
    std::erase_if(load.lingering, [&](const auto& entry) { return entry.second < than; });
  });
}

const WorkerLoad& WorkerLoads::of(WorkerNumber worker) const {
  const auto at = loads_.find(worker);
  return at == loads_.end() ? kNothing : at->second;
}

}  // namespace swarmsmith
