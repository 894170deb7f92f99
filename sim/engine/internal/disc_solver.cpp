#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/engine/internal/contact_solver.h"
#include "sim/engine/internal/contacts.h"
#include "sim/engine/internal/gaps.h"
#include "sim/engine/internal/motion.h"
#include "sim/engine/internal/places.h"

// The contact model of the e-puck's simulator, Chipmunk 6 (epuck facts, sections 2.2 and 8):
// sequential impulses, starting from the accumulated impulses of the last sub-step; a normal
// impulse only while two bodies approach; friction up to a multiple of it; the drive as one more
// constraint with a limited impulse; no correction of positions. Discs meet in one point, on the
// line through the centre, so that the normal impulse causes no rotation.

namespace swarmsmith {
namespace {

constexpr int kRounds = 10;
/// Iterations end early when no impulse changes by more than this, in N s: a ten thousandth of the
/// impulse of the e-puck's drive in a sub-step. The next sub-step continues from there.
constexpr double kSettled_Ns = 1.5e-6;
constexpr std::uint64_t kWallBit = std::uint64_t{1} << 31U;
constexpr std::uint64_t kObstacleBit = std::uint64_t{1} << 30U;

/// One contact of a disc, with its impulses in this sub-step.
struct DiscContact {
  std::uint64_t id = 0;
  std::size_t a = 0;
  std::size_t b = 0;  ///< the index after the last mover stands for fixed bodies
  double nx = 0;      ///< unit normal from a to the other body
  double ny = 0;
  double arm_a = 0;  ///< from a's centre to the contact point, along the normal
  double arm_b = 0;  ///< from b's centre, against the normal
  double normal_mass = 0;
  double face_mass = 0;
  double friction = 0;
  double normal_Ns = 0;
  double friction_Ns = 0;
};

/// A mover during the iterations. The entry after the last one represents all fixed bodies.
struct DiscState {
  double vx = 0;
  double vy = 0;
  double spin = 0;
  double inverse_mass = 0;
  double inverse_inertia = 0;
  double drive_x_Ns = 0;  ///< impulse of its drive in this sub-step
  double drive_y_Ns = 0;
  double drive_twist_Nms = 0;
  bool touched = false;
};

/// The gap between a disc and another body, with its direction.
struct Depth {
  double gap = 0;  ///< negative in contact
  double nx = 0;   ///< unit vector from the disc
  double ny = 0;
};

Depth depth_to_point(double dx, double dy, double radius_m) {
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (distance == 0) return {-radius_m, 1, 0};
  return {distance - radius_m, dx / distance, dy / distance};
}

Depth depth_in_wall(const Body& body, double radius_m, const WallPlane& wall) {
  const double along = wall.along(body.x, body.y);
  const double on_face = std::clamp(along, 0.0, wall.length_m);
  if (along == on_face) return {wall.depth_of(body.x, body.y) - radius_m, wall.nx, wall.ny};
  return depth_to_point(wall.from.x - wall.ny * on_face - body.x,
                        wall.from.y + wall.nx * on_face - body.y, radius_m);
}

/// For a polygon: the gap to the side whose line the disc's centre is farthest outside, or to a
/// corner of this side if the centre lies beyond its end.
Depth depth_in_solid(const Body& body, double radius_m, const FixedSolid& solid) {
  const Form& form = solid.form;
  const Body& at = solid.at;
  const double dx = body.x - at.x;
  const double dy = body.y - at.y;
  if (form.is_circle()) return depth_to_point(-dx, -dy, radius_m + form.radius_m);
  const Point own = {dx * at.cos + dy * at.sin, dy * at.cos - dx * at.sin};
  std::size_t side = 0;
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < form.normals.size(); ++i) {
    const Point& normal = form.normals[i];
    const double apart =
        normal.x * (own.x - form.corners[i].x) + normal.y * (own.y - form.corners[i].y);
    if (apart > widest) {
      widest = apart;
      side = i;
    }
  }
  const Point& from = form.corners[side];
  const Point& to = form.corners[(side + 1) % form.corners.size()];
  const Point& normal = form.normals[side];
  const double along = normal.x * own.y - normal.y * own.x;
  const double first = normal.x * from.y - normal.y * from.x;
  const double last = normal.x * to.y - normal.y * to.x;
  Depth depth = {widest - radius_m, -normal.x, -normal.y};
  if (along < first) depth = depth_to_point(from.x - own.x, from.y - own.y, radius_m);
  if (along > last) depth = depth_to_point(to.x - own.x, to.y - own.y, radius_m);
  return {depth.gap, depth.nx * at.cos - depth.ny * at.sin, depth.nx * at.sin + depth.ny * at.cos};
}

class DiscSolver final : public ContactSolver {
 public:
  DiscSolver(const Surroundings& surroundings, double robot_friction, double wall_friction)
      : surroundings_(&surroundings),
        robot_friction_(robot_friction),
        wall_friction_(wall_friction) {}

  void advance(std::span<Mover> movers, std::span<const Island> islands, int sub_steps) override {
    if (islands.empty() && memory_.empty()) return;
    states_.resize(movers.size() + 1);
    // All movers are robots of one kind.
    dynamics_ = movers.front().dynamics();
    inverse_mass_ = 1 / dynamics_.mass_kg;
    inverse_inertia_ = 1 / dynamics_.inertia_kg_m2;
    most_Ns_ = dynamics_.max_force_N * kSubStep_s;
    most_Nms_ = dynamics_.max_torque_Nm * kSubStep_s;
    fresh_.clear();
    for (const Island& island : islands) {
      recall(island);
      advance_island(movers, island, sub_steps);
    }
    std::sort(fresh_.begin(), fresh_.end(),
              [](const DiscContact& a, const DiscContact& b) { return a.id < b.id; });
    memory_.swap(fresh_);
  }

 private:
  void advance_island(std::span<Mover> movers, const Island& island, int sub_steps) {
    int left = sub_steps;
    while (left > 0) {
      const int quiet = before_.empty() ? quiet_sub_steps(movers, island, *surroundings_, left) : 0;
      if (quiet > 0) {
        for (const int index : island.movers) {
          Mover& mover = movers[static_cast<std::size_t>(index)];
          advance_freely(mover.body, mover.set_point, quiet, mover.dynamics());
          states_[static_cast<std::size_t>(index)] = {};
        }
      } else {
        sub_step(movers, island);
        before_.swap(contacts_);
      }
      left -= std::max(quiet, 1);
    }
    fresh_.insert(fresh_.end(), before_.begin(), before_.end());
  }

  /// Recalls the contacts of an island at the end of the last call; resets the drives of robots
  /// without contacts.
  void recall(const Island& island) {
    before_.clear();
    for (const int index : island.movers) {
      const auto i = static_cast<std::size_t>(index);
      const std::uint64_t first = static_cast<std::uint64_t>(i) << 32U;
      auto found = std::lower_bound(
          memory_.begin(), memory_.end(), first,
          [](const DiscContact& contact, std::uint64_t id) { return contact.id < id; });
      for (; found != memory_.end() && found->a == i; ++found)
        before_.push_back(*found);
    }
    for (const int index : island.movers)
      states_[static_cast<std::size_t>(index)].touched = false;
    for (const DiscContact& contact : before_)
      states_[contact.a].touched = states_[contact.b].touched = true;
    for (const int index : island.movers) {
      DiscState& state = states_[static_cast<std::size_t>(index)];
      if (!state.touched) state = {};
    }
  }

  void sub_step(std::span<Mover> movers, const Island& island) {
    for (const int index : island.movers) {
      move(movers[static_cast<std::size_t>(index)].body);
      states_[static_cast<std::size_t>(index)].touched = false;
    }
    find_contacts(movers, island);
    active_.clear();
    for (const int index : island.movers) {
      const auto i = static_cast<std::size_t>(index);
      if (states_[i].touched) {
        active_.push_back(i);
      } else {
        states_[i] = {};
        steer(movers[i].body, movers[i].set_point, movers[i].dynamics());
      }
    }
    if (active_.empty()) return;
    solve(movers);
    for (const std::size_t i : active_) {
      Body& body = movers[i].body;
      body.vx = states_[i].vx;
      body.vy = states_[i].vy;
      body.spin = states_[i].spin;
    }
  }

  void find_contacts(std::span<const Mover> movers, const Island& island) {
    contacts_.clear();
    for (const Meeting& meeting : island.pairs) {
      const auto a = static_cast<std::size_t>(meeting.mover);
      const auto b = static_cast<std::size_t>(meeting.other);
      const Body& self = movers[a].body;
      const Body& other = movers[b].body;
      const double reach = movers[a].form().radius_m + movers[b].form().radius_m;
      if (distance2_of(self, other) >= reach * reach) continue;
      const Depth depth = depth_to_point(other.x - self.x, other.y - self.y, reach);
      add(movers, a, b, static_cast<std::uint64_t>(b), depth);
      contacts_.back().arm_b = movers[b].form().radius_m + depth.gap / 2;
      contacts_.back().friction = robot_friction_;
    }
    const auto meet = [&](const Meeting& meeting, std::uint64_t bit, const auto& depth_of) {
      const auto a = static_cast<std::size_t>(meeting.mover);
      const Depth depth = depth_of(movers[a].body, movers[a].form().radius_m);
      if (depth.gap >= 0) return;
      add(movers, a, states_.size() - 1, bit | static_cast<std::uint64_t>(meeting.other), depth);
      contacts_.back().friction = wall_friction_;
    };
    for (const Meeting& meeting : island.walls) {
      const WallPlane& wall = surroundings_->walls.planes[static_cast<std::size_t>(meeting.other)];
      meet(meeting, kWallBit,
           [&](const Body& body, double radius_m) { return depth_in_wall(body, radius_m, wall); });
    }
    for (const Meeting& meeting : island.obstacles) {
      const FixedSolid& solid = surroundings_->obstacles[static_cast<std::size_t>(meeting.other)];
      meet(meeting, kObstacleBit, [&](const Body& body, double radius_m) {
        return depth_in_solid(body, radius_m, solid);
      });
    }
  }

  void add(std::span<const Mover> movers, std::size_t a, std::size_t b, std::uint64_t other,
           const Depth& depth) {
    contacts_.push_back({.id = static_cast<std::uint64_t>(a) << 32U | other,
                         .a = a,
                         .b = b,
                         .nx = depth.nx,
                         .ny = depth.ny,
                         .arm_a = movers[a].form().radius_m + depth.gap / 2});
    states_[a].touched = states_[b].touched = true;
  }

  void solve(std::span<const Mover> movers) {
    prepare(movers);
    double change = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds && change >= kSettled_Ns; ++round) {
      change = 0;
      for (DiscContact& contact : contacts_)
        change = std::max(change, relax(contact, states_[contact.a], states_[contact.b]));
      for (const std::size_t i : active_)
        change = std::max(change, relax_drive(movers[i].set_point, states_[i]));
    }
  }

  /// Warm start: the impulses of contacts and drives in the last sub-step are the first guess.
  void prepare(std::span<const Mover> movers) {
    for (const std::size_t i : active_) {
      const Body& body = movers[i].body;
      DiscState& state = states_[i];
      state.inverse_mass = inverse_mass_;
      state.inverse_inertia = inverse_inertia_;
      state.vx = body.vx + state.drive_x_Ns * state.inverse_mass;
      state.vy = body.vy + state.drive_y_Ns * state.inverse_mass;
      state.spin = body.spin + state.drive_twist_Nms * state.inverse_inertia;
    }
    // Most contacts were also present in the last sub-step, in the same order.
    std::size_t next = 0;
    for (DiscContact& contact : contacts_) {
      DiscState& a = states_[contact.a];
      DiscState& b = states_[contact.b];
      contact.normal_mass = 1 / (a.inverse_mass + b.inverse_mass);
      contact.face_mass =
          1 / (a.inverse_mass + b.inverse_mass + contact.arm_a * contact.arm_a * a.inverse_inertia +
               contact.arm_b * contact.arm_b * b.inverse_inertia);
      for (std::size_t tried = 0; tried < before_.size(); ++tried, ++next) {
        if (next >= before_.size()) next = 0;
        const DiscContact& old = before_[next];
        if (old.id != contact.id) continue;
        contact.normal_Ns = old.normal_Ns;
        contact.friction_Ns = old.friction_Ns;
        push(contact, a, b, contact.normal_Ns, contact.friction_Ns);
        ++next;
        break;
      }
    }
  }

  /// Applies impulses along the normal and along the face (-ny, nx), from a to b.
  static void push(const DiscContact& c, DiscState& a, DiscState& b, double normal_Ns,
                   double friction_Ns) {
    const double x = c.nx * normal_Ns - c.ny * friction_Ns;
    const double y = c.ny * normal_Ns + c.nx * friction_Ns;
    a.vx -= x * a.inverse_mass;
    a.vy -= y * a.inverse_mass;
    a.spin -= c.arm_a * friction_Ns * a.inverse_inertia;
    b.vx += x * b.inverse_mass;
    b.vy += y * b.inverse_mass;
    b.spin -= c.arm_b * friction_Ns * b.inverse_inertia;
  }

  /// One iteration for one contact; returns the largest change.
  static double relax(DiscContact& c, DiscState& a, DiscState& b) {
    const double dx = b.vx - a.vx;
    const double dy = b.vy - a.vy;
    const double along_normal = dx * c.nx + dy * c.ny;
    const double along_face = dy * c.nx - dx * c.ny - c.arm_b * b.spin - c.arm_a * a.spin;
    const double normal_before = c.normal_Ns;
    const double friction_before = c.friction_Ns;
    c.normal_Ns = std::max(0.0, normal_before - along_normal * c.normal_mass);
    const double bound = c.friction * c.normal_Ns;
    c.friction_Ns = std::clamp(friction_before - along_face * c.face_mass, -bound, bound);
    const double normal_change = c.normal_Ns - normal_before;
    const double friction_change = c.friction_Ns - friction_before;
    push(c, a, b, normal_change, friction_change);
    return std::max(std::fabs(normal_change), std::fabs(friction_change));
  }

  /// One iteration for one drive: towards the set-point, with its whole impulse within the limit.
  double relax_drive(const SetPoint& set_point, DiscState& state) const {
    double x = state.drive_x_Ns + dynamics_.mass_kg * (set_point.vx - state.vx);
    double y = state.drive_y_Ns + dynamics_.mass_kg * (set_point.vy - state.vy);
    const double size2 = x * x + y * y;
    if (size2 > most_Ns_ * most_Ns_) {
      const double scale = most_Ns_ / std::sqrt(size2);
      x *= scale;
      y *= scale;
    }
    const double twist =
        std::clamp(state.drive_twist_Nms + dynamics_.inertia_kg_m2 * (set_point.spin - state.spin),
                   -most_Nms_, most_Nms_);
    const double change =
        std::max(std::fabs(x - state.drive_x_Ns), std::fabs(y - state.drive_y_Ns));
    state.vx += (x - state.drive_x_Ns) * state.inverse_mass;
    state.vy += (y - state.drive_y_Ns) * state.inverse_mass;
    state.spin += (twist - state.drive_twist_Nms) * state.inverse_inertia;
    state.drive_x_Ns = x;
    state.drive_y_Ns = y;
    state.drive_twist_Nms = twist;
    return change;
  }

  const Surroundings* surroundings_;
  double robot_friction_;
  double wall_friction_;
  Dynamics dynamics_;
  double inverse_mass_ = 0;
  double inverse_inertia_ = 0;
  double most_Ns_ = 0;  ///< of a drive in a sub-step
  double most_Nms_ = 0;
  std::vector<DiscContact> contacts_;  ///< of this sub-step
  std::vector<DiscContact> before_;    ///< of the last one
  std::vector<DiscContact> memory_;    ///< contacts of all islands at the end of the last call, by
                                       ///< id
  std::vector<DiscContact> fresh_;     ///< contacts at the end of this call
  std::vector<DiscState> states_;
  std::vector<std::size_t> active_;  ///< movers in contact
};

}  // namespace

std::unique_ptr<ContactSolver> make_disc_solver(const Surroundings& surroundings,
                                                double robot_friction, double wall_friction) {
  return std::make_unique<DiscSolver>(surroundings, robot_friction, wall_friction);
}

}  // namespace swarmsmith
