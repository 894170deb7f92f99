#pragma once

#include <memory>
#include <span>

#include "sim/engine/internal/island.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/surroundings.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// The seam between free motion and contact: moves what may touch each other, a wall or an
/// obstacle.
///
/// A solver belongs to one world. It may remember what held its contacts in the last call, as the
/// first guess of the next one; it keeps nothing else, and no two worlds share anything, so that an
/// evaluation cannot depend on the one before it.
///
/// The law, for each sub-step: all bodies move with their present velocity; contacts are found
/// where bodies then are; velocities change by the drives' impulses (at most max force and torque
/// times the sub-step) and the contacts' (rigid, no restitution, Coulomb friction). Without a touch
/// that is sub_step.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  /// Moves the members of the islands; called for each span of time, also when there are none.
  virtual void advance(std::span<Mover> movers, std::span<const Island> islands, int sub_steps) = 0;
};

/// The solver of a contact model. `Exact` wants squares of the RVR's side alone in a convex arena
/// (`squares`); with other movers or walls it is Box2D's. `surroundings` must outlive the solver.
std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool squares,
                                                   const Surroundings& surroundings);

/// Our own, for the RVR's squares inside a convex polygon, among fixed obstacles (simulator facts,
/// section 4.1).
std::unique_ptr<ContactSolver> make_exact_solver(const Surroundings& surroundings);
/// Our own for robots that are discs, among walls of any arena and fixed obstacles.
std::unique_ptr<ContactSolver> make_disc_solver(const Surroundings& surroundings,
                                                double robot_friction, double wall_friction);
/// Box2D's, single precision (simulator facts, section 4.2), for all forms. In a plain world
/// overlap is left as it is, as in the original; elsewhere more than 5 mm of it is pushed apart,
/// because light objects between heavy robots and walls would be pressed into them.
std::unique_ptr<ContactSolver> make_box2d_solver(const Surroundings& surroundings, bool plain);

}  // namespace swarmsmith
