#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/engine/internal/contact_solver.h"
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
/// Inverse mass and inertia of what does not move.
constexpr double kNoResponse = 0;

struct Contact {
  int a = 0;
  int b = -1;            ///< another robot, or -1: a wall
  std::uint32_t id = 0;  ///< which corner meets what; the same from sub-step to sub-step
  double nx = 0;         ///< unit normal from a to the other
  double ny = 0;
  double ax = 0;  ///< from a's centre to the point of contact
  double ay = 0;
  double bx = 0;
  double by = 0;
  double normal_mass = 0;  ///< change of impulse per change of approach speed
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

double inverse_response(double rx, double ry, double dx, double dy, bool moves) {
  const double arm = rx * dy - ry * dx;
  return moves ? 1 / kMass_kg + arm * arm / kInertia_kg_m2 : kNoResponse;
}

void push(Body& body, double rx, double ry, double x_Ns, double y_Ns) {
  body.vx += x_Ns / kMass_kg;
  body.vy += y_Ns / kMass_kg;
  body.spin += (rx * y_Ns - ry * x_Ns) / kInertia_kg_m2;
}

class ExactSolver final : public ContactSolver {
 public:
  void advance(std::span<IslandMember> island, std::span<const WallPlane> walls,
               int sub_steps) override {
    before_.clear();
    for (int i = 0; i < sub_steps; ++i) {
      for (IslandMember& member : island) move(member.body);
      find_contacts(island, walls);
      if (contacts_.empty()) {
        for (IslandMember& member : island) steer_alone(member);
      } else {
        solve(island);
      }
      std::swap(before_, contacts_);
    }
  }

 private:
  static void move(Body& body) {
    body.x += kSubStep_s * body.vx;
    body.y += kSubStep_s * body.vy;
    turn(body, kSubStep_s * body.spin);
  }

  static void steer_alone(IslandMember& member) {
    Drive drive;
    steer(member, drive);
  }

  void find_contacts(std::span<const IslandMember> island, std::span<const WallPlane> walls) {
    contacts_.clear();
    for (std::size_t i = 0; i < island.size(); ++i) {
      for (std::size_t j = i + 1; j < island.size(); ++j) meet(island, i, j);
      for (std::size_t w = 0; w < walls.size(); ++w) {
        if (gap_to(island[i].body, walls[w]) < 0) meet_wall(island, i, walls[w], w);
      }
    }
  }

  /// Contacts of two squares: the corners of each that lie in the other.
  void meet(std::span<const IslandMember> island, std::size_t i, std::size_t j) {
    const Body& a = island[i].body;
    const Body& b = island[j].body;
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    if (dx * dx + dy * dy >= 4 * kCornerRadius_m * kCornerRadius_m) return;
    if (gap_between(a, b) >= 0) return;
    // All four axes leave the same room, so the least overlap is where the centres are widest apart.
    const std::array<std::array<double, 2>, 4> axes = {
        {{a.cos, a.sin}, {-a.sin, a.cos}, {b.cos, b.sin}, {-b.sin, b.cos}}};
    double widest = -1;
    Contact contact{.a = static_cast<int>(i), .b = static_cast<int>(j)};
    for (const auto& [x, y] : axes) {
      const double projection = dx * x + dy * y;
      if (std::fabs(projection) <= widest) continue;
      widest = std::fabs(projection);
      contact.nx = std::copysign(1.0, projection) * x;
      contact.ny = std::copysign(1.0, projection) * y;
    }
    const auto pair = static_cast<std::uint32_t>(i * island.size() + j) << 8U;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const bool of_a = corner < 4;
      const Body& own = of_a ? a : b;
      const Body& other = of_a ? b : a;
      const auto [rx, ry] = corner_of(own, corner % 4);
      const double ox = own.x + rx - other.x;
      const double oy = own.y + ry - other.y;
      if (std::fabs(ox * other.cos + oy * other.sin) > kHalfSide_m ||
          std::fabs(oy * other.cos - ox * other.sin) > kHalfSide_m) {
        continue;
      }
      contact.id = pair | corner;
      contact.ax = of_a ? rx : ox;
      contact.ay = of_a ? ry : oy;
      contact.bx = of_a ? ox : rx;
      contact.by = of_a ? oy : ry;
      add(contact);
    }
  }

  void meet_wall(std::span<const IslandMember> island, std::size_t i, const WallPlane& wall,
                 std::size_t index) {
    const Body& body = island[i].body;
    for (unsigned corner = 0; corner < 4; ++corner) {
      const auto [rx, ry] = corner_of(body, corner);
      if (wall.depth_of(body.x + rx, body.y + ry) > 0) continue;
      add({.a = static_cast<int>(i),
           .id = 0x80000000U | static_cast<std::uint32_t>(i << 16U | index << 8U) | corner,
           .nx = wall.nx,
           .ny = wall.ny,
           .ax = rx,
           .ay = ry});
    }
  }

  /// From the centre to a corner.
  static std::array<double, 2> corner_of(const Body& body, unsigned corner) {
    const double x = corner == 0 || corner == 3 ? kHalfSide_m : -kHalfSide_m;
    const double y = corner < 2 ? kHalfSide_m : -kHalfSide_m;
    return {body.cos * x - body.sin * y, body.sin * x + body.cos * y};
  }

  void add(Contact contact) {
    const bool pair = contact.b >= 0;
    contact.normal_mass =
        1 / (inverse_response(contact.ax, contact.ay, contact.nx, contact.ny, true) +
             inverse_response(contact.bx, contact.by, contact.nx, contact.ny, pair));
    contact.friction_mass =
        1 / (inverse_response(contact.ax, contact.ay, -contact.ny, contact.nx, true) +
             inverse_response(contact.bx, contact.by, -contact.ny, contact.nx, pair));
    // Warm start: what held in the last sub-step is the first guess of this one.
    for (const Contact& old : before_) {
      if (old.id != contact.id) continue;
      contact.normal_Ns = old.normal_Ns;
      contact.friction_Ns = old.friction_Ns;
    }
    contacts_.push_back(contact);
  }

  void solve(std::span<IslandMember> island) {
    drives_.assign(island.size(), Drive{});
    for (const Contact& contact : contacts_) {
      apply(island, contact, contact.nx, contact.ny, contact.normal_Ns);
      apply(island, contact, -contact.ny, contact.nx, contact.friction_Ns);
    }
    for (int round = 0; round < kRounds; ++round) {
      double change = 0;
      for (Contact& contact : contacts_) change = std::max(change, relax(island, contact));
      for (std::size_t i = 0; i < island.size(); ++i) {
        change = std::max(change, steer(island[i], drives_[i]));
      }
      if (change < kSettled_Ns) break;
    }
  }

  /// An impulse along (x, y) from a to the other.
  static void apply(std::span<IslandMember> island, const Contact& contact, double x, double y,
                    double size_Ns) {
    push(island[static_cast<std::size_t>(contact.a)].body, contact.ax, contact.ay, -x * size_Ns,
         -y * size_Ns);
    if (contact.b >= 0) {
      push(island[static_cast<std::size_t>(contact.b)].body, contact.bx, contact.by, x * size_Ns,
           y * size_Ns);
    }
  }

  /// Speed of the other against a at the point of contact, along (x, y).
  static double parting_speed(std::span<const IslandMember> island, const Contact& contact,
                              double x, double y) {
    const Body& a = island[static_cast<std::size_t>(contact.a)].body;
    double vx = -(a.vx - a.spin * contact.ay);
    double vy = -(a.vy + a.spin * contact.ax);
    if (contact.b >= 0) {
      const Body& b = island[static_cast<std::size_t>(contact.b)].body;
      vx += b.vx - b.spin * contact.by;
      vy += b.vy + b.spin * contact.bx;
    }
    return x * vx + y * vy;
  }

  /// One round for one contact; returns the largest change of an impulse.
  static double relax(std::span<IslandMember> island, Contact& contact) {
    const double parting = parting_speed(island, contact, contact.nx, contact.ny);
    const double normal =
        std::max(0.0, contact.normal_Ns - contact.normal_mass * parting) - contact.normal_Ns;
    contact.normal_Ns += normal;
    apply(island, contact, contact.nx, contact.ny, normal);
    const double sliding = parting_speed(island, contact, -contact.ny, contact.nx);
    const double bound = kFriction * contact.normal_Ns;
    const double friction =
        std::clamp(contact.friction_Ns - contact.friction_mass * sliding, -bound, bound) -
        contact.friction_Ns;
    contact.friction_Ns += friction;
    apply(island, contact, -contact.ny, contact.nx, friction);
    return std::max(std::fabs(normal), std::fabs(friction));
  }

  /// One round for one drive: towards the set-point, its whole impulse within the limit.
  static double steer(IslandMember& member, Drive& drive) {
    Body& body = member.body;
    double x = drive.x_Ns + kMass_kg * (member.set_point.vx - body.vx);
    double y = drive.y_Ns + kMass_kg * (member.set_point.vy - body.vy);
    const double size = std::sqrt(x * x + y * y);
    if (size > kMaxImpulse_Ns) {
      x *= kMaxImpulse_Ns / size;
      y *= kMaxImpulse_Ns / size;
    }
    const double twist =
        std::clamp(drive.twist_Nms + kInertia_kg_m2 * (member.set_point.spin - body.spin),
                   -kMaxTwist_Nms, kMaxTwist_Nms);
    const Drive change = {x - drive.x_Ns, y - drive.y_Ns, twist - drive.twist_Nms};
    drive = {x, y, twist};
    body.vx += change.x_Ns / kMass_kg;
    body.vy += change.y_Ns / kMass_kg;
    body.spin += change.twist_Nms / kInertia_kg_m2;
    // A twist over the half side is comparable with an impulse.
    return std::max({std::fabs(change.x_Ns), std::fabs(change.y_Ns),
                     std::fabs(change.twist_Nms) / kHalfSide_m});
  }

  std::vector<Contact> contacts_;
  std::vector<Contact> before_;
  std::vector<Drive> drives_;
};

}  // namespace

std::unique_ptr<ContactSolver> make_exact_solver() { return std::make_unique<ExactSolver>(); }

std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool convex_arena) {
  return model == ContactModel::Exact && convex_arena ? make_exact_solver() : make_box2d_solver();
}

}  // namespace swarmsmith
