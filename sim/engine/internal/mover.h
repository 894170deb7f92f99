#pragma once

#include "sim/engine/internal/body.h"
#include "sim/engine/internal/form.h"
#include "sim/mission/solid.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// What all robots of a mission, or one object, are like.
struct MoverKind {
  Form form;
  Dynamics dynamics;
  double friction = kFriction;  ///< of its surface; two that meet have the geometric mean

  friend bool operator==(const MoverKind&, const MoverKind&) = default;
};

/// The robot of rvr-automode facts, section 2.
const MoverKind& rvr_kind();

/// A robot as a mover; of the RVR's body and drive it is `rvr_kind`.
MoverKind robot_kind(const Robot& robot);

/// An object that slides on the floor: at most `friction_N`, and in turning that times the mean
/// distance of its floor from its centre. `friction` is that of its sides.
MoverKind object_kind(const MovableObject& object, double friction = kFriction);

/// A robot or an object, with what it steers towards. A kind outlives its movers.
struct Mover {
  Body body;
  SetPoint set_point;
  const MoverKind* kind = &rvr_kind();

  const Form& form() const { return kind->form; }
  const Dynamics& dynamics() const { return kind->dynamics; }

  friend bool operator==(const Mover&, const Mover&) = default;
};

}  // namespace swarmsmith
