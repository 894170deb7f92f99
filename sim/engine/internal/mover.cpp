#include "sim/engine/internal/mover.h"

namespace swarmsmith {
namespace {

Dynamics dynamics_of(double mass_kg, double inertia_kg_m2, double max_force_N,
                     double max_torque_Nm) {
  return {.mass_kg = mass_kg,
          .inertia_kg_m2 = inertia_kg_m2,
          .max_force_N = max_force_N,
          .max_torque_Nm = max_torque_Nm,
          .speed_step_mps = max_force_N / mass_kg * kSubStep_s,
          .spin_step_radps = max_torque_Nm / inertia_kg_m2 * kSubStep_s};
}

}  // namespace

const MoverKind& rvr_kind() {
  static const MoverKind kind = {.form = rvr_form(), .dynamics = {}};
  return kind;
}

MoverKind robot_kind(const Robot& robot) {
  const RobotBody& body = robot.body;
  const RobotDrive& drive = robot.drive;
  if (body == RobotBody{} && drive.max_force_N == kMaxForce_N &&
      drive.max_torque_Nm == kMaxTorque_Nm) {
    return rvr_kind();
  }
  Form form = form_of(body.outline, body.height_m);
  const double inertia_kg_m2 =
      body.inertia_kg_m2 > 0 ? body.inertia_kg_m2 : body.mass_kg * form.mean_radius2_m2;
  const Dynamics dynamics =
      dynamics_of(body.mass_kg, inertia_kg_m2, drive.max_force_N, drive.max_torque_Nm);
  return {.form = std::move(form), .dynamics = dynamics, .friction = body.robot_friction};
}

MoverKind object_kind(const MovableObject& object, double friction) {
  Form form = form_of(object.outline, object.height_m);
  const Dynamics dynamics = dynamics_of(object.mass_kg, object.mass_kg * form.mean_radius2_m2,
                                        object.friction_N, object.friction_N * form.mean_radius_m);
  return {.form = std::move(form), .dynamics = dynamics, .friction = friction};
}

}  // namespace swarmsmith
