#pragma once

#include <memory>
#include <span>

#include "sim/engine/internal/island.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/surroundings.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// The interface between free motion and contact: moves bodies that may touch each other, a wall or
/// an obstacle.
///
/// A solver belongs to one world. It may remember the impulses of its contacts from the last call,
/// as the first guess for the next one. It keeps nothing else, and worlds share nothing, so that an
/// evaluation cannot depend on an earlier one.
///
/// In each sub-step all bodies move with their present velocity; contacts are found at the new
/// poses; then velocities change by the impulses of the drives (at most max force and torque times
/// the sub-step) and of the contacts (rigid, no restitution, Coulomb friction). Without contacts
/// this is the same as sub_step.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  /// Moves the members of the islands; called for each span of time, even when there are no
  /// islands.
  virtual void advance(std::span<Mover> movers, std::span<const Island> islands, int sub_steps) = 0;
};

/// The solver of a contact model. `Exact` has its own solver only for squares of the RVR's size in
/// a convex arena (`squares`); with other movers or walls it uses Box2D. `surroundings` must
/// outlive the solver.
std::unique_ptr<ContactSolver> make_contact_solver(ContactModel model, bool squares,
                                                   const Surroundings& surroundings);

/// This project's solver for RVR squares inside a convex polygon, among fixed obstacles (simulator
/// facts, section 4.1).
std::unique_ptr<ContactSolver> make_exact_solver(const Surroundings& surroundings);
/// This project's solver for disc-shaped robots, among the walls of any arena and fixed obstacles.
std::unique_ptr<ContactSolver> make_disc_solver(const Surroundings& surroundings,
                                                double robot_friction, double wall_friction);
/// The solver based on Box2D, in single precision (simulator facts, section 4.2), for all shapes.
/// In a plain world overlap is not corrected, as in the original simulator; otherwise overlap above
/// 5 mm is pushed apart, because light objects between heavy robots and walls would be pressed into
/// them.
std::unique_ptr<ContactSolver> make_box2d_solver(const Surroundings& surroundings, bool plain);

}  // namespace swarmsmith
