#pragma once

#include "sim/engine/internal/body.h"
#include "sim/engine/internal/form.h"
#include "sim/mission/solid.h"
#include "sim/robot/robot.h"

namespace swarmsmith {

/// The properties of all robots of a mission, or of one object.
struct MoverKind {
  Form form;
  Dynamics dynamics;
  double friction = kFriction;  ///< of its surface; two bodies in contact have the geometric mean

  friend bool operator==(const MoverKind&, const MoverKind&) = default;
};

/// The robot described in rvr-automode facts, section 2.
const MoverKind& rvr_kind();

/// The kind of a robot; equal to `rvr_kind` for a robot with the RVR's body and drive.
MoverKind robot_kind(const Robot& robot);

/// An object that slides on the floor. The friction of the floor is at most the force `friction_N`,
/// and at most the torque of this force times the mean distance of its floor area from its centre.
/// `friction` is the friction coefficient of its sides.
MoverKind object_kind(const MovableObject& object, double friction = kFriction);

/// A robot or an object, with its set-point. A kind outlives its movers.
struct Mover {
  Body body;
  SetPoint set_point;
  const MoverKind* kind = &rvr_kind();

  const Form& form() const { return kind->form; }
  const Dynamics& dynamics() const { return kind->dynamics; }

  friend bool operator==(const Mover&, const Mover&) = default;
};

}  // namespace swarmsmith
