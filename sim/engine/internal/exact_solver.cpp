#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "sim/engine/internal/contact_solver.h"
#include "sim/engine/internal/contacts.h"
#include "sim/engine/internal/impulses.h"
#include "sim/engine/internal/motion.h"

// Sequential impulses (Catto, "Iterative dynamics with temporal coherence", GDC 2005), with two
// features of the original simulator: the drive is one more constraint with a limited impulse, and
// overlap is never pushed apart; only approach is stopped.
//
// Drives have ample torque: a drive holds the spin of a pressing robot, so that iterations between
// it and the contacts would only exchange an impulse back and forth. Such spins are treated as
// held, contacts act as if the robot could not turn, and at the end it is checked that the torque
// was sufficient.

namespace swarmsmith {
namespace {

constexpr int kRounds = 10;
/// Iterations end early when no impulse of a contact changes by more than this, in N s: less than a
/// hundredth of the impulse of a drive in a sub-step. The next sub-step continues from there.
constexpr double kSettled_Ns = 1e-4;

class ExactSolver final : public ContactSolver {
 public:
  explicit ExactSolver(const Surroundings& surroundings) : surroundings_(&surroundings) {}

  void advance(std::span<Mover> movers, std::span<const Island> islands, int sub_steps) override {
    if (islands.empty() && memory_.empty()) return;
    robots_.resize(movers.size() + 1);
    fresh_.clear();
    sort_memory(movers.size(), islands);
    for (std::size_t i = 0; i < islands.size(); ++i) {
      recall(islands[i], i);
      advance_island(movers, islands[i], sub_steps);
    }
    memory_.swap(fresh_);
  }

 private:
  void advance_island(std::span<Mover> movers, const Island& island, int sub_steps) {
    int left = sub_steps;
    while (left > 0) {
      // Most islands are false alarms, or come into contact late: until then the motion is free.
      const int quiet = before_.empty() ? quiet_sub_steps(movers, island, *surroundings_, left) : 0;
      if (quiet > 0) {
        for (const int index : island.movers) {
          const auto i = static_cast<std::size_t>(index);
          advance_freely(movers[i].body, movers[i].set_point, quiet);
          robots_[i] = {};
        }
        constraints_.clear();
      } else {
        sub_step(movers, island);
      }
      left -= std::max(quiet, 1);
      before_.swap(constraints_);
    }
    fresh_.insert(fresh_.end(), before_.begin(), before_.end());
  }

  /// Sorts `memory_` by the islands to which its contacts now belong; contacts outside all islands
  /// come last.
  void sort_memory(std::size_t movers, std::span<const Island> islands) {
    next_in_memory_ = 0;
    if (memory_.empty()) return;
    island_of_.assign(movers, islands.size());
    for (std::size_t i = 0; i < islands.size(); ++i) {
      for (const int index : islands[i].movers)
        island_of_[static_cast<std::size_t>(index)] = i;
    }
    const auto before = [&](const Constraint& a, const Constraint& b) {
      const std::size_t of_a = island_of_[a.a];
      const std::size_t of_b = island_of_[b.a];
      return of_a != of_b ? of_a < of_b : a.id < b.id;
    };
    if (std::is_sorted(memory_.begin(), memory_.end(), before)) return;
    std::sort(memory_.begin(), memory_.end(), before);
  }

  /// Recalls the contacts of an island at the end of the last call; resets the drives of robots
  /// without contacts. Must be called island by island.
  void recall(const Island& island, std::size_t number) {
    before_.clear();
    for (const int index : island.movers)
      robots_[static_cast<std::size_t>(index)].touched = false;
    for (; next_in_memory_ < memory_.size(); ++next_in_memory_) {
      const Constraint& c = memory_[next_in_memory_];
      if (island_of_[c.a] != number) break;
      before_.push_back(c);
      robots_[c.a].touched = robots_[c.b].touched = true;
    }
    for (const int index : island.movers) {
      Dynamic& robot = robots_[static_cast<std::size_t>(index)];
      if (!robot.touched) robot = {};
    }
  }

  void sub_step(std::span<Mover> movers, const Island& island) {
    for (const int index : island.movers)
      move(movers[static_cast<std::size_t>(index)].body);
    find_contacts(movers, island, *surroundings_, contacts_);
    const bool held = select(movers, island);
    if (active_.empty()) {
      constraints_.clear();
      return;
    }
    solve(movers, held);
    for (const std::size_t i : active_) {
      Body& body = movers[i].body;
      body.vx = robots_[i].vx;
      body.vy = robots_[i].vy;
      body.spin = robots_[i].spin;
    }
  }

  /// Steers robots that touch nothing; the others become `active_`. Returns whether any spin is
  /// held.
  bool select(std::span<Mover> movers, const Island& island) {
    for (const int index : island.movers)
      robots_[static_cast<std::size_t>(index)].touched = false;
    for (const Contact& contact : contacts_) {
      robots_[static_cast<std::size_t>(contact.a)].touched = true;
      if (contact.b >= 0) robots_[static_cast<std::size_t>(contact.b)].touched = true;
    }
    active_.clear();
    bool held = false;
    for (const int index : island.movers) {
      const auto i = static_cast<std::size_t>(index);
      Mover& mover = movers[i];
      if (!robots_[i].touched) {
        robots_[i] = {};
        steer(mover.body, mover.set_point);
        continue;
      }
      active_.push_back(i);
      const double spin = mover.set_point.spin - mover.body.spin;
      robots_[i].inverse_mass = kInverseMass;
      robots_[i].inverse_inertia = std::fabs(spin) <= kSpinStep_radps ? 0 : kInverseInertia;
      held = held || robots_[i].inverse_inertia == 0;
    }
    return held;
  }

  void solve(std::span<const Mover> movers, bool held) {
    run_rounds(movers);
    if (!held || holds(movers)) return;
    for (const std::size_t i : active_)
      robots_[i].inverse_inertia = kInverseInertia;
    run_rounds(movers);
  }

  /// Whether the drives are strong enough to hold the spins that were assumed held.
  bool holds(std::span<const Mover> movers) {
    for (const std::size_t i : active_) {
      if (robots_[i].inverse_inertia != 0) continue;
      robots_[i].drive_twist_Nms =
          kInertia_kg_m2 * (movers[i].set_point.spin - movers[i].body.spin);
    }
    for (const Constraint& c : constraints_) {
      Dynamic& a = robots_[c.a];
      Dynamic& b = robots_[c.b];
      if (a.inverse_inertia == 0) {
        a.drive_twist_Nms += c.normal.arm_a * c.normal_Ns + c.face.arm_a * c.friction_Ns;
      }
      if (b.inverse_inertia == 0) {
        b.drive_twist_Nms -= c.normal.arm_b * c.normal_Ns + c.face.arm_b * c.friction_Ns;
      }
    }
    bool all = true;
    for (const std::size_t i : active_) {
      double& twist = robots_[i].drive_twist_Nms;
      all = all && std::fabs(twist) <= kMaxTwist_Nms;
      twist = std::clamp(twist, -kMaxTwist_Nms, kMaxTwist_Nms);
    }
    return all;
  }

  void run_rounds(std::span<const Mover> movers) {
    prepare(movers);
    double change = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds && change >= kSettled_Ns; ++round) {
      for (const std::size_t i : active_) {
        if (change * robots_[i].give >= kSettled_Ns) relax_drive(movers[i].set_point, robots_[i]);
      }
      change = 0;
      for (Constraint& c : constraints_) {
        AtRest wall;
        change = std::max(change, c.share_b == 0 ? relax(c, robots_[c.a], wall)
                                                 : relax(c, robots_[c.a], robots_[c.b]));
      }
    }
  }

  /// Warm start: the impulses of contacts and drives in the last sub-step are the first guess.
  void prepare(std::span<const Mover> movers) {
    for (const std::size_t i : active_) {
      const Body& body = movers[i].body;
      Dynamic& robot = robots_[i];
      robot.vx = body.vx + robot.drive_x_Ns * kInverseMass;
      robot.vy = body.vy + robot.drive_y_Ns * kInverseMass;
      robot.spin = robot.inverse_inertia == 0 ? movers[i].set_point.spin
                                              : body.spin + robot.drive_twist_Nms * kInverseInertia;
    }
    constraints_.resize(contacts_.size());
    auto old = before_.begin();
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const Contact& contact = contacts_[k];
      Constraint& c = constraints_[k];
      const std::size_t b =
          contact.b < 0 ? robots_.size() - 1 : static_cast<std::size_t>(contact.b);
      set_constraint(c, contact, b, robots_[static_cast<std::size_t>(contact.a)], robots_[b]);
      // `find_contacts` lists pairs, obstacles and walls, each by mover: in ascending order of ids,
      // like `before_`.
      while (old != before_.end() && old->id < c.id)
        ++old;
      if (old == before_.end() || old->id != c.id) continue;
      c.normal_Ns = old->normal_Ns;
      c.friction_Ns = old->friction_Ns;
      push_apart(c, robots_[c.a], robots_[c.b], c.normal_Ns, c.friction_Ns);
    }
  }

  const Surroundings* surroundings_;
  std::vector<Contact> contacts_;
  std::vector<Constraint> constraints_;  ///< of this sub-step
  std::vector<Constraint> before_;       ///< of the last one
  std::vector<Constraint> memory_;       ///< contacts of all islands at the end of the last call
  std::vector<Constraint> fresh_;        ///< contacts at the end of this call
  std::size_t next_in_memory_ = 0;
  std::vector<std::size_t> island_of_;  ///< island of each mover, while contacts are remembered
  std::vector<Dynamic> robots_;
  std::vector<std::size_t> active_;  ///< movers in contact
};

}  // namespace

std::unique_ptr<ContactSolver> make_exact_solver(const Surroundings& surroundings) {
  return std::make_unique<ExactSolver>(surroundings);
}

std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool squares,
                                                   const Surroundings& surroundings) {
  if (model == ContactModel::Exact && squares) return make_exact_solver(surroundings);
  return make_box2d_solver(surroundings, squares && surroundings.obstacles.empty());
}

}  // namespace swarmsmith
