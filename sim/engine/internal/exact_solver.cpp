#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "sim/engine/internal/contact_solver.h"
#include "sim/engine/internal/contacts.h"
#include "sim/engine/internal/motion.h"

// Sequential impulses (Catto, "Iterative dynamics with temporal coherence", GDC 2005), with two
// things of the original simulator: the drive is one more constraint with a limited impulse, and
// overlap is never pushed apart, only approach is cancelled.
//
// Torque is plenty: a drive holds the spin of a robot that presses, so that rounds between it and
// the contacts would only pass an impulse to and fro. Such spins are taken as held, contacts act as
// if the robot could not turn, and at the end it is checked that the torque was there.

namespace swarmsmith {
namespace {

constexpr int kRounds = 10;
/// Rounds end early when no contact changes its impulse by more, N s: less than a hundredth of what
/// a drive gives in a sub-step. What is left over is the first guess of the next sub-step.

constexpr double kSettled_Ns = 1e-4;
constexpr double kMaxImpulse_Ns = kMaxForce_N * kSubStep_s;
constexpr double kMaxTwist_Nms = kMaxTorque_Nm * kSubStep_s;
constexpr double kInverseMass = 1 / kMass_kg;
constexpr double kInverseInertia = 1 / kInertia_kg_m2;

/// A robot in the rounds. The body behind the last robot is that of all walls: nothing moves it.
struct Dynamic {
  double vx = 0;
  double vy = 0;
  double spin = 0;
  double inverse_mass = 0;
  double inverse_inertia = 0;  ///< 0 also for a robot whose spin is held
  /// What its drive gave in this sub-step.
  double drive_x_Ns = 0;
  double drive_y_Ns = 0;
  double drive_twist_Nms = 0;
  double give = 1;  ///< how much of a change of its velocity the drive answers, at most
  bool touched = false;
};

/// Along one direction of a contact, from a to b.
struct Direction {
  double arm_a = 0;  ///< lever arms of an impulse
  double arm_b = 0;
  /// Speed of b against a, times the impulse that would stop it, is
  /// x (vx_b - vx_a) + y (vy_b - vy_a) + spin_b * (spin of b) - spin_a * (spin of a).
  double x = 0;
  double y = 0;
  double spin_a = 0;
  double spin_b = 0;
  /// Changes of the spins for each N s.
  double turns_a = 0;
  double turns_b = 0;

  double stopping_Ns(const Dynamic& a, const Dynamic& b) const {
    return -((x * (b.vx - a.vx) + y * (b.vy - a.vy)) + (spin_b * b.spin - spin_a * a.spin));
  }
};

/// A contact as the rounds want it, with what it has done in this sub-step.
struct Constraint {
  std::uint64_t id = 0;
  std::size_t a = 0;
  std::size_t b = 0;
  /// Change of a's velocity for each N s along the normal; along the face it is (-y, x).
  double pushes_x = 0;
  double pushes_y = 0;
  double share_b = 0;  ///< of that change for b: 1, or 0 for a wall
  Direction normal;
  Direction face;
  double coupling = 0;   ///< change of the face's stopping impulse for each N s along the normal
  double normal_Ns = 0;  ///< impulses so far
  double friction_Ns = 0;
};

void push_apart(const Constraint& c, Dynamic& a, Dynamic& b, double normal_Ns, double friction_Ns) {
  const double x = c.pushes_x * normal_Ns - c.pushes_y * friction_Ns;
  const double y = c.pushes_y * normal_Ns + c.pushes_x * friction_Ns;
  a.vx -= x;
  a.vy -= y;
  a.spin -= c.normal.turns_a * normal_Ns + c.face.turns_a * friction_Ns;
  b.vx += c.share_b * x;
  b.vy += c.share_b * y;
  b.spin += c.normal.turns_b * normal_Ns + c.face.turns_b * friction_Ns;
}

/// One round for one contact; the bound of its friction is that of the normal impulse before, as in
/// Box2D. Returns the largest change. Written for short chains of operations that wait for each
/// other: they are what a round costs.
double relax(Constraint& c, Dynamic& a, Dynamic& b) {
  const double normal_change = std::max(c.normal.stopping_Ns(a, b), -c.normal_Ns);
  const double bound = kFriction * c.normal_Ns;
  double stopping = c.face.stopping_Ns(a, b);
  if (c.coupling != 0) stopping -= c.coupling * normal_change;
  const double friction_change =
      std::clamp(stopping, -bound - c.friction_Ns, bound - c.friction_Ns);
  c.normal_Ns += normal_change;
  c.friction_Ns += friction_change;
  push_apart(c, a, b, normal_change, friction_change);
  return std::max(std::fabs(normal_change), std::fabs(friction_change));
}

/// One round for one drive: towards the set-point, its whole impulse within the limit.
void relax_drive(const SetPoint& set_point, Dynamic& robot) {
  double x = robot.drive_x_Ns + kMass_kg * (set_point.vx - robot.vx);
  double y = robot.drive_y_Ns + kMass_kg * (set_point.vy - robot.vy);
  const double size2 = x * x + y * y;
  if (robot.inverse_inertia != 0) {
    const double twist =
        std::clamp(robot.drive_twist_Nms + kInertia_kg_m2 * (set_point.spin - robot.spin),
                   -kMaxTwist_Nms, kMaxTwist_Nms);
    robot.spin += (twist - robot.drive_twist_Nms) * kInverseInertia;
    robot.drive_twist_Nms = twist;
  }
  robot.give = 1;
  if (size2 > kMaxImpulse_Ns * kMaxImpulse_Ns) {
    const double scale = kMaxImpulse_Ns / std::sqrt(size2);
    if (robot.inverse_inertia == 0) robot.give = scale;
    x *= scale;
    y *= scale;
  }
  robot.vx += (x - robot.drive_x_Ns) * kInverseMass;
  robot.vy += (y - robot.drive_y_Ns) * kInverseMass;
  robot.drive_x_Ns = x;
  robot.drive_y_Ns = y;
}

class ExactSolver final : public ContactSolver {
 public:
  explicit ExactSolver(const Surroundings& surroundings) : surroundings_(&surroundings) {}

  void advance(std::span<Mover> movers, std::span<const Island> islands, int sub_steps) override {
    if (islands.empty() && memory_.empty()) return;
    robots_.resize(movers.size() + 1);
    fresh_.clear();
    for (const Island& island : islands)
      advance_island(movers, island, sub_steps);
    memory_.swap(fresh_);
    if (islands.size() > 1) {
      std::sort(memory_.begin(), memory_.end(),
                [](const Constraint& a, const Constraint& b) { return a.id < b.id; });
    }
  }

 private:
  void advance_island(std::span<Mover> movers, const Island& island, int sub_steps) {
    recall(island);
    int left = sub_steps;
    while (left > 0) {
      // Most islands are false alarms, or come to touch late: those sub-steps are free.
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

  /// What held the island's contacts at the end of the last call; forgets the drives of the others.
  void recall(const Island& island) {
    before_.clear();
    for (const int index : island.movers)
      robots_[static_cast<std::size_t>(index)].touched = false;
    for (const Constraint& c : memory_) {
      if (!std::binary_search(island.movers.begin(), island.movers.end(), static_cast<int>(c.a))) {
        continue;
      }
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
    find_contacts(movers, island, surroundings_->walls, contacts_);
    constraints_.clear();
    const bool held = select(movers, island);
    if (active_.empty()) return;
    solve(movers, held);
    for (const std::size_t i : active_) {
      Body& body = movers[i].body;
      body.vx = robots_[i].vx;
      body.vy = robots_[i].vy;
      body.spin = robots_[i].spin;
    }
  }

  /// Steers what touches nothing; the others are `active_`. Returns whether a spin is held.
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

  /// Whether the drives are strong enough to hold the spins that were held.
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
      for (Constraint& c : constraints_)
        change = std::max(change, relax(c, robots_[c.a], robots_[c.b]));
    }
  }

  /// Warm start: what a contact or a drive gave in the last sub-step is the first guess of this
  /// one.
  void prepare(std::span<const Mover> movers) {
    for (const std::size_t i : active_) {
      const Body& body = movers[i].body;
      Dynamic& robot = robots_[i];
      robot.vx = body.vx + robot.drive_x_Ns * kInverseMass;
      robot.vy = body.vy + robot.drive_y_Ns * kInverseMass;
      robot.spin = robot.inverse_inertia == 0 ? movers[i].set_point.spin
                                              : body.spin + robot.drive_twist_Nms * kInverseInertia;
    }
    constraints_.clear();
    auto old = before_.begin();
    for (const Contact& contact : contacts_) {
      Constraint& c = add_constraint(contact);
      while (old != before_.end() && old->id < c.id)
        ++old;
      if (old == before_.end() || old->id != c.id) continue;
      c.normal_Ns = old->normal_Ns;
      c.friction_Ns = old->friction_Ns;
      push_apart(c, robots_[c.a], robots_[c.b], c.normal_Ns, c.friction_Ns);
    }
  }

  Constraint& add_constraint(const Contact& contact) {
    const auto a = static_cast<std::size_t>(contact.a);
    const bool wall = contact.b < 0;
    const std::size_t b = wall ? robots_.size() - 1 : static_cast<std::size_t>(contact.b);
    constraints_.push_back({.id = contact.id,
                            .a = a,
                            .b = b,
                            .pushes_x = contact.nx * kInverseMass,
                            .pushes_y = contact.ny * kInverseMass,
                            .share_b = wall ? 0.0 : 1.0});
    Constraint& c = constraints_.back();
    c.normal = direction(contact, contact.nx, contact.ny, robots_[a], robots_[b]);
    c.face = direction(contact, -contact.ny, contact.nx, robots_[a], robots_[b]);
    c.coupling = c.face.spin_a * c.normal.turns_a + c.face.spin_b * c.normal.turns_b;
    return c;
  }

  static Direction direction(const Contact& contact, double x, double y, const Dynamic& a,
                             const Dynamic& b) {
    const double arm_a = contact.ax * y - contact.ay * x;
    const double arm_b = contact.bx * y - contact.by * x;
    const double mass = 1 / (a.inverse_mass + b.inverse_mass + arm_a * arm_a * a.inverse_inertia +
                             arm_b * arm_b * b.inverse_inertia);
    return {.arm_a = arm_a,
            .arm_b = arm_b,
            .x = mass * x,
            .y = mass * y,
            .spin_a = mass * arm_a,
            .spin_b = mass * arm_b,
            .turns_a = arm_a * a.inverse_inertia,
            .turns_b = arm_b * b.inverse_inertia};
  }

  const Surroundings* surroundings_;
  std::vector<Contact> contacts_;
  std::vector<Constraint> constraints_;  ///< of this sub-step
  std::vector<Constraint> before_;       ///< of the last one
  std::vector<Constraint> memory_;       ///< of all islands at the end of the last call
  std::vector<Constraint> fresh_;        ///< and of this one
  std::vector<Dynamic> robots_;
  std::vector<std::size_t> active_;  ///< movers in contact
};

}  // namespace

std::unique_ptr<ContactSolver> make_exact_solver(const Surroundings& surroundings) {
  return std::make_unique<ExactSolver>(surroundings);
}

std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool plain,
                                                   const Surroundings& surroundings) {
  return model == ContactModel::Exact && plain ? make_exact_solver(surroundings)
                                               : make_box2d_solver(surroundings, plain);
}

}  // namespace swarmsmith
