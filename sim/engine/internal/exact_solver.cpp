#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/engine/internal/contacts.h"
#include "sim/engine/internal/motion.h"

// Sequential impulses (Catto, "Iterative dynamics with temporal coherence", GDC 2005), with two
// things of the original simulator: the drive is one more constraint with a limited impulse, and
// overlap is never pushed apart, only approach is cancelled.

namespace swarmsmith {
namespace {

constexpr int kRounds = 10;
/// Rounds end early when no impulse changes by more, N s.
constexpr double kSettled_Ns = 1e-9;
constexpr double kMaxImpulse_Ns = kMaxForce_N * kSubStep_s;
constexpr double kMaxTwist_Nms = kMaxTorque_Nm * kSubStep_s;
constexpr double kInverseMass = 1 / kMass_kg;
constexpr double kInverseInertia = 1 / kInertia_kg_m2;

/// A contact with what it has done in this sub-step.
struct Constraint {
  Contact contact;
  double normal_mass = 0;  ///< change of impulse per change of parting speed
  double friction_mass = 0;
  double normal_Ns = 0;  ///< impulses so far
  double friction_Ns = 0;
};

/// What a drive gave in this sub-step.
struct Drive {
  double x_Ns = 0;
  double y_Ns = 0;
  double twist_Nms = 0;
};

void push(Body& body, double rx, double ry, double x_Ns, double y_Ns) {
  body.vx += x_Ns * kInverseMass;
  body.vy += y_Ns * kInverseMass;
  body.spin += (rx * y_Ns - ry * x_Ns) * kInverseInertia;
}

/// An impulse along (x, y) from a to the other.
void push_apart(std::span<IslandMember> island, const Contact& contact, double x, double y,
                double size_Ns) {
  push(island[static_cast<std::size_t>(contact.a)].body, contact.ax, contact.ay, -x * size_Ns,
       -y * size_Ns);
  if (contact.b >= 0) {
    push(island[static_cast<std::size_t>(contact.b)].body, contact.bx, contact.by, x * size_Ns,
         y * size_Ns);
  }
}

/// Speed of the other against a at the point of contact, along (x, y).
double parting_speed(std::span<const IslandMember> island, const Contact& contact, double x,
                     double y) {
  const Body& a = island[static_cast<std::size_t>(contact.a)].body;
  double vx = a.spin * contact.ay - a.vx;
  double vy = -a.spin * contact.ax - a.vy;
  if (contact.b >= 0) {
    const Body& b = island[static_cast<std::size_t>(contact.b)].body;
    vx += b.vx - b.spin * contact.by;
    vy += b.vy + b.spin * contact.bx;
  }
  return x * vx + y * vy;
}

/// The impulse along (x, y) that changes the parting speed by one.
double mass_along(const Contact& contact, double x, double y) {
  const double arm_a = contact.ax * y - contact.ay * x;
  double response = kInverseMass + arm_a * arm_a * kInverseInertia;
  if (contact.b >= 0) {
    const double arm_b = contact.bx * y - contact.by * x;
    response += kInverseMass + arm_b * arm_b * kInverseInertia;
  }
  return 1 / response;
}

/// One round for one contact; returns the largest change of an impulse.
double relax(std::span<IslandMember> island, Constraint& constraint) {
  const Contact& contact = constraint.contact;
  const double parting = parting_speed(island, contact, contact.nx, contact.ny);
  const double normal = std::max(0.0, constraint.normal_Ns - constraint.normal_mass * parting);
  const double normal_change = normal - constraint.normal_Ns;
  constraint.normal_Ns = normal;
  push_apart(island, contact, contact.nx, contact.ny, normal_change);
  const double sliding = parting_speed(island, contact, -contact.ny, contact.nx);
  const double bound = kFriction * normal;
  const double friction =
      std::clamp(constraint.friction_Ns - constraint.friction_mass * sliding, -bound, bound);
  const double friction_change = friction - constraint.friction_Ns;
  constraint.friction_Ns = friction;
  push_apart(island, contact, -contact.ny, contact.nx, friction_change);
  return std::max(std::fabs(normal_change), std::fabs(friction_change));
}

/// One round for one drive: towards the set-point, its whole impulse within the limit. Returns the
/// largest change.
double steer(IslandMember& member, Drive& drive) {
  Body& body = member.body;
  double x = drive.x_Ns + kMass_kg * (member.set_point.vx - body.vx);
  double y = drive.y_Ns + kMass_kg * (member.set_point.vy - body.vy);
  const double size2 = x * x + y * y;
  if (size2 > kMaxImpulse_Ns * kMaxImpulse_Ns) {
    const double scale = kMaxImpulse_Ns / std::sqrt(size2);
    x *= scale;
    y *= scale;
  }
  const double twist =
      std::clamp(drive.twist_Nms + kInertia_kg_m2 * (member.set_point.spin - body.spin),
                 -kMaxTwist_Nms, kMaxTwist_Nms);
  const Drive change = {x - drive.x_Ns, y - drive.y_Ns, twist - drive.twist_Nms};
  drive = {x, y, twist};
  push(body, 0, 0, change.x_Ns, change.y_Ns);
  body.spin += change.twist_Nms * kInverseInertia;
  // A twist over the half side is comparable with an impulse.
  return std::max(
      {std::fabs(change.x_Ns), std::fabs(change.y_Ns), std::fabs(change.twist_Nms) / kHalfSide_m});
}

class ExactSolver final : public ContactSolver {
 public:
  void advance(std::span<IslandMember> island, std::span<const WallPlane> walls,
               int sub_steps) override {
    constraints_.clear();
    int left = sub_steps;
    while (left > 0) {
      // Most islands are false alarms, or come to touch late: those sub-steps are free.
      const int quiet = quiet_sub_steps(island, walls, left);
      if (quiet > 0) {
        for (IslandMember& member : island) {
          advance_freely(member.body, member.set_point, quiet);
        }
        constraints_.clear();
      } else {
        touching_sub_step(island, walls);
      }
      left -= std::max(quiet, 1);
    }
  }

 private:
  void touching_sub_step(std::span<IslandMember> island, std::span<const WallPlane> walls) {
    for (IslandMember& member : island) {
      Body& body = member.body;
      body.x += kSubStep_s * body.vx;
      body.y += kSubStep_s * body.vy;
      turn(body, kSubStep_s * body.spin);
    }
    find_contacts(island, walls, contacts_);
    prepare();
    for (const Constraint& constraint : constraints_) {
      const Contact& contact = constraint.contact;
      push_apart(island, contact, contact.nx, contact.ny, constraint.normal_Ns);
      push_apart(island, contact, -contact.ny, contact.nx, constraint.friction_Ns);
    }
    drives_.assign(island.size(), Drive{});
    for (int round = 0; round < kRounds; ++round) {
      double change = 0;
      for (Constraint& constraint : constraints_) {
        change = std::max(change, relax(island, constraint));
      }
      for (std::size_t i = 0; i < island.size(); ++i) {
        change = std::max(change, steer(island[i], drives_[i]));
      }
      if (change < kSettled_Ns || constraints_.empty()) break;
    }
  }

  /// Makes the contacts' constraints. Warm start: what held a contact in the last sub-step is the
  /// first guess of this one.
  void prepare() {
    before_.swap(constraints_);
    constraints_.clear();
    for (const Contact& contact : contacts_) {
      constraints_.push_back({.contact = contact,
                              .normal_mass = mass_along(contact, contact.nx, contact.ny),
                              .friction_mass = mass_along(contact, -contact.ny, contact.nx)});
      for (const Constraint& old : before_) {
        if (old.contact.id != contact.id) continue;
        constraints_.back().normal_Ns = old.normal_Ns;
        constraints_.back().friction_Ns = old.friction_Ns;
      }
    }
  }

  std::vector<Contact> contacts_;
  std::vector<Constraint> constraints_;
  std::vector<Constraint> before_;
  std::vector<Drive> drives_;
};

}  // namespace

std::unique_ptr<ContactSolver> make_exact_solver() {
  return std::make_unique<ExactSolver>();
}

std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool convex_arena) {
  return model == ContactModel::Exact && convex_arena ? make_exact_solver() : make_box2d_solver();
}

}  // namespace swarmsmith
