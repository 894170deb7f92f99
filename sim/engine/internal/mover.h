#pragma once

#include "sim/engine/internal/body.h"
#include "sim/engine/internal/form.h"
#include "sim/mission/solid.h"

namespace swarmsmith {

/// What all robots of a mission, or one object, are like.
struct MoverKind {
  Form form;
  Dynamics dynamics;

  friend bool operator==(const MoverKind&, const MoverKind&) = default;
};

/// The robot of rvr-automode facts, section 2.
const MoverKind& rvr_kind();

/// A robot of another outline: the RVR's mass and drive, inertia of a plate of that outline. With
/// the RVR's square it is the RVR.
MoverKind robot_kind(const Outline& outline);

/// An object that slides on the floor: at most `friction_N`, and in turning that times the mean
/// distance of its floor from its centre.
MoverKind object_kind(const MovableObject& object);

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
