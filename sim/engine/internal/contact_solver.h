#pragma once

#include <memory>
#include <span>

#include "sim/engine/internal/body.h"
#include "sim/engine/internal/walls.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// A robot of an island, before and after.
struct IslandMember {
  Body body;
  SetPoint set_point;

  friend bool operator==(const IslandMember&, const IslandMember&) = default;
};

/// The seam between free motion and contact: moves robots that may touch each other or a wall.
///
/// A solver is a function: what it gives depends on its arguments alone, never on earlier calls (it
/// keeps scratch memory, not impulses or caches), so that an evaluation cannot depend on the one
/// before it. One solver serves one thread.
///
/// The law, for each sub-step: all bodies move with their present velocity; contacts are found
/// where bodies then are; velocities change by the drives' impulses (at most max force and torque
/// times the sub-step) and the contacts' (rigid, no restitution, Coulomb friction). Without a touch
/// that is sub_step.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  /// `walls` are those that a member may reach.
  virtual void advance(std::span<IslandMember> island, std::span<const WallPlane> walls,
                       int sub_steps) = 0;
};

/// The solver of a contact model. `Exact` wants a convex arena; in another one it is Box2D's.
std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool convex_arena);

/// Our own, for squares inside a convex polygon (simulator facts, section 4.1).
std::unique_ptr<ContactSolver> make_exact_solver();
/// Box2D's, single precision (simulator facts, section 4.2).
std::unique_ptr<ContactSolver> make_box2d_solver();

}  // namespace swarmsmith
