#include "sim/engine/internal/mover.h"

namespace swarmsmith {
namespace {

Dynamics dynamics_of(double mass_kg, const Form& form, double max_force_N, double max_torque_Nm) {
  const double inertia = mass_kg * form.mean_radius2_m2;
  return {.mass_kg = mass_kg,
          .inertia_kg_m2 = inertia,
          .max_force_N = max_force_N,
          .max_torque_Nm = max_torque_Nm,
          .speed_step_mps = max_force_N / mass_kg * kSubStep_s,
          .spin_step_radps = max_torque_Nm / inertia * kSubStep_s};
}

}  // namespace

const MoverKind& rvr_kind() {
  static const MoverKind kind = {.form = rvr_form(), .dynamics = {}};
  return kind;
}

MoverKind robot_kind(const Outline& outline) {
  Form form = form_of(outline, kBodyHeight_m);
  if (form.is_rvr) return rvr_kind();
  const Dynamics dynamics = dynamics_of(kMass_kg, form, kMaxForce_N, kMaxTorque_Nm);
  return {.form = std::move(form), .dynamics = dynamics};
}

MoverKind object_kind(const MovableObject& object) {
  Form form = form_of(object.outline, object.height_m);
  const Dynamics dynamics =
      dynamics_of(object.mass_kg, form, object.friction_N, object.friction_N * form.mean_radius_m);
  return {.form = std::move(form), .dynamics = dynamics};
}

}  // namespace swarmsmith
