#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "sim/engine/internal/contact_solver.h"
#include "sim/engine/internal/mover.h"
#include "sim/engine/internal/places.h"
#include "sim/engine/internal/reach.h"
#include "sim/engine/internal/ring.h"
#include "sim/engine/internal/surroundings.h"
#include "sim/mission/arena.h"
#include "sim/mission/pose.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Whether only robots with the RVR's body and drive move, in a convex arena: then the exact
/// contact model has its own solver, otherwise it uses Box2D.
bool has_squares_alone(const Arena& arena, const Robot& robot);

/// Whether only discs move that are not the RVR with another outline: then the exact contact model
/// has a solver for them.
bool has_discs_alone(const Arena& arena, const Robot& robot);

/// Bodies, walls and motion: the simulated world without sensors and control software. Time is
/// counted in sub-steps of 10 ms. Movers are the robots, 0 to robots() - 1, followed by the arena's
/// movable objects.
class World {
 public:
  World(const Arena& arena, const Robot& robot, std::span<const Pose> starts,
        ContactModel contacts);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// The model of all robots.
  const Robot& robot() const { return robot_; }
  const Ring& proximity_ring() const { return proximity_ring_; }
  const Ring& light_ring() const { return light_ring_; }
  int robots() const { return robots_; }
  int movers() const { return static_cast<int>(movers_.size()); }
  const Body& body(int mover) const { return movers_[static_cast<std::size_t>(mover)].body; }
  /// All robots have the same form; each object has its own.
  const Form& form(int mover) const { return movers_[static_cast<std::size_t>(mover)].form(); }
  const Walls& walls() const { return surroundings_.walls; }
  std::span<const FixedSolid> obstacles() const { return surroundings_.obstacles; }
  /// Whether there are only robots with the RVR's body, and walls around a convex arena.
  bool is_plain() const { return plain_; }
  /// Square of the present distance between two centres.
  double distance2(int mover, int other) const { return distance2_of(body(mover), body(other)); }
  /// Calls visit(other) for the other movers whose centres are at most `radius_m` from the mover's
  /// centre, in ascending order; `room` is working memory.
  template <class Visit>
  void visit_near(int mover, double radius_m, std::vector<int>& room, const Visit& visit) const {
    places_.visit_near(movers_, static_cast<std::size_t>(mover), radius_m, 0, room, visit);
  }
  /// An upper bound for the radius of all movers.
  double largest_radius_m() const { return largest_radius_m_; }

  /// From now on the robot's drive follows the command, along its present heading.
  void command(int robot, const Command& command) {
    Mover& mover = movers_[static_cast<std::size_t>(robot)];
    mover.set_point = set_point_of(command, mover.body, robot_.drive.track_m);
    speed_limit_mps_ = std::max(
        speed_limit_mps_, std::max(std::fabs(command.left_mps), std::fabs(command.right_mps)));
  }

  /// Moves all movers: free ones in closed form, islands with the contact solver.
  void advance(int sub_steps);

  /// The first mover that is not sound, or -1.
  int find_unsound() const {
    for (std::size_t i = 0; i < movers_.size(); ++i) {
      if (!is_sound(movers_[i].body)) [[unlikely]]
        return static_cast<int>(i);
    }
    return -1;
  }

  /// The number of mover sub-steps that the contact solver has computed so far.
  long solved_sub_steps() const { return solved_sub_steps_; }

 private:
  void take_note(const Island& island, int sub_steps);

  Robot robot_;
  Ring proximity_ring_;
  Ring light_ring_;
  Surroundings surroundings_;
  int robots_;
  std::vector<MoverKind> kinds_;  ///< the robots' kind, then the kinds of the objects
  std::vector<Mover> movers_;
  bool squares_;  ///< whether the world is plain apart from fixed obstacles
  bool plain_;
  double largest_radius_m_;
  Places places_;
  double speed_limit_mps_ = 0;  ///< no centre has been faster so far
  Reach reach_;
  std::unique_ptr<ContactSolver> solver_;
  long solved_sub_steps_ = 0;
};

}  // namespace swarmsmith
