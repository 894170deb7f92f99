#include "coordinator/pool/design_queues.h"

#include <algorithm>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// The number of designs that are checked for urgency: a design with more outstanding tasks than
/// this many others is not the next one at a barrier. The limit keeps the selection cheap.
constexpr int kNearest = 8;

std::optional<PackedKey> first_of(const std::list<PackedKey>& queue,
                                  const DesignQueues::Fits& fits) {
  const auto at = std::ranges::find_if(queue, fits);
  return at == queue.end() ? std::nullopt : std::optional(*at);
}

}  // namespace

DesignQueues::Design& DesignQueues::design(PoolDesign id) {
  const auto [at, is_new] = designs_.try_emplace(id);
  if (is_new) {
    at->second.id = id;
    // Its design or campaign may have been held before its first task came.
    at->second.held = is_held(id);
  }
  return at->second;
}

void DesignQueues::put(Order& order, std::optional<Order::iterator>& at, bool ready,
                       std::uint64_t rank, Design& design) {
  if (!at) {
    if (ready) at = order.insert({rank, design.id, &design}).first;
    return;
  }
  if (ready && (*at)->rank == rank) return;
  auto node = order.extract(*at);
  at.reset();
  if (!ready) return;
  node.value().rank = rank;
  at = order.insert(std::move(node)).position;
}

/// The ranks are keys of the ordered sets and must not change while a design is in one: so every
/// change is made by this function, before and after which the sets and totals are consistent.
template <class Change>
void DesignQueues::change(Design& design, const Change& make) {
  if (!design.held) {
    SWARMSMITH_ASSERT(wanted_ >= design.wanted.size() && ahead_ >= design.ahead.size(),
                      "the totals have every ready task");
    wanted_ -= design.wanted.size();
    ahead_ -= design.ahead.size();
  }
  make();
  const bool is_ready = !design.held && !design.wanted.empty();
  // A design that becomes ready again starts at the level of the others: idle time gives no credit,
  // because otherwise a design that has waited at a barrier would block all others.
  if (is_ready && !design.by_had) design.had_us = std::max(design.had_us, had_us_);
  put(by_had_, design.by_had, is_ready, design.had_us, design);
  put(by_outstanding_, design.by_outstanding, is_ready, design.outstanding(), design);
  put(by_ahead_, design.by_ahead, !design.held && !design.ahead.empty(), design.ahead_leased,
      design);
  SWARMSMITH_ASSERT(by_had_.size() == by_outstanding_.size(), "both orders hold the ready designs");
  if (!design.held) {
    wanted_ += design.wanted.size();
    ahead_ += design.ahead.size();
  }
}

DesignQueues::Place DesignQueues::push_back(Design& design, bool ahead, PackedKey key) {
  std::list<PackedKey>& queue = ahead ? design.ahead : design.wanted;
  Place place;
  change(design, [&] { place = queue.insert(queue.end(), key); });
  return place;
}

DesignQueues::Place DesignQueues::push_front(Design& design, bool ahead, PackedKey key) {
  std::list<PackedKey>& queue = ahead ? design.ahead : design.wanted;
  Place place;
  change(design, [&] { place = queue.insert(queue.begin(), key); });
  return place;
}

void DesignQueues::erase(Design& design, bool ahead, Place place) {
  change(design, [&] { (ahead ? design.ahead : design.wanted).erase(place); });
}

/// Look-ahead is not charged, because it uses slots that would idle. `had_us_` is the virtual time
/// of start-time fair queueing, which never decreases.
void DesignQueues::on_leased(Design& design, bool ahead, std::uint64_t cost_us) {
  // Before the charge: of all designs with work, the one that has had least sets the level at which
  // others join.
  if (!ahead && !by_had_.empty()) had_us_ = std::max(had_us_, by_had_.begin()->rank);
  change(design, [&] {
    ++(ahead ? design.ahead_leased : design.wanted_leased);
    if (!ahead) design.had_us += cost_us;
  });
}

void DesignQueues::on_unleased(Design& design, bool ahead) {
  std::size_t& leased = ahead ? design.ahead_leased : design.wanted_leased;
  SWARMSMITH_ASSERT(leased > 0, "every lease that ends was counted");
  change(design, [&] { --leased; });
}

void DesignQueues::on_promoted(Design& design) {
  SWARMSMITH_ASSERT(design.ahead_leased > 0, "a lease that is promoted was counted");
  change(design, [&] {
    --design.ahead_leased;
    ++design.wanted_leased;
  });
}

void DesignQueues::hold(PoolDesign id, bool held) {
  if (held) {
    held_.insert(id);
  } else {
    held_.erase(id);
  }
  // A change for one design or for the campaign: each design is ready only if neither holds it.
  for (auto at = designs_.lower_bound({id.campaign, 0});
       at != designs_.end() && at->first.campaign == id.campaign; ++at) {
    Design& design = at->second;
    const bool now_held = is_held(at->first);
    if (design.held != now_held) change(design, [&] { design.held = now_held; });
  }
}

bool DesignQueues::is_held(PoolDesign id) const {
  return !held_.empty() && (held_.contains({id.campaign, 0}) || held_.contains(id));
}

std::size_t DesignQueues::wanted_of(PoolDesign id) const {
  std::size_t wanted = 0;
  for (auto at = designs_.lower_bound(id);
       at != designs_.end() && at->first.campaign == id.campaign; ++at) {
    if (id.design != 0 && at->first.design != id.design) break;
    wanted += at->second.wanted.size();
  }
  return wanted;
}

void DesignQueues::forget(std::uint32_t campaign) {
  std::erase_if(designs_, [&](const auto& entry) {
    const Design& design = entry.second;
    if (entry.first.campaign != campaign) return false;
    SWARMSMITH_ASSERT(!design.by_had && !design.by_ahead && design.outstanding() == 0,
                      "a campaign is removed only without tasks");
    return true;
  });
}

bool DesignQueues::is_urgent(const Design& design, std::size_t free,
                             std::uint64_t allowance_us) const {
  SWARMSMITH_ASSERT(!by_had_.empty(), "both orders hold the ready designs");
  // The whole rest of its step can be sent now, and it is not too far ahead of the others by being
  // urgent.
  return design.wanted.size() <= free && design.had_us <= by_had_.begin()->rank + allowance_us;
}

std::optional<PackedKey> DesignQueues::next(std::size_t free, std::uint64_t allowance_us,
                                            const Fits& fits) const {
  // Before a barrier, all workers of the design's step wait for its last task, so these tasks go
  // first (orchestration facts, 5 "Order"). They are charged, so they cannot starve other designs.
  int seen = 0;
  for (auto at = by_outstanding_.begin(); at != by_outstanding_.end() && seen < kNearest;
       ++at, ++seen) {
    if (!is_urgent(*at->design, free, allowance_us)) continue;
    if (const auto key = first_of(at->design->wanted, fits)) return key;
  }
  // No design is near a barrier: the one that has had the least time.
  for (const Design::Ranked& ranked : by_had_) {
    if (const auto key = first_of(ranked.design->wanted, fits)) return key;
  }
  return std::nullopt;
}

std::optional<PackedKey> DesignQueues::next_ahead(const Fits& fits) const {
  // The design with the fewest leased look-ahead tasks, so that they are spread over the designs.
  for (const Design::Ranked& ranked : by_ahead_) {
    if (const auto key = first_of(ranked.design->ahead, fits)) return key;
  }
  return std::nullopt;
}

}  // namespace swarmsmith
