#include <box2d/box2d.h>

#include <mutex>
#include <vector>

#include "base/math.h"
#include "sim/engine/internal/contact_solver.h"

// Box2D 2.4 in the original's terms (simulator facts, section 4.2): the drive is a friction joint
// to a kinematic body that moves with the set-point; its order (solve velocities, then move) is
// made ours (move, find contacts, solve velocities) by handing over poses one sub-step ahead; the
// skin that it keeps round polygons is taken off their size. A world of its own for each call keeps
// evaluations independent of each other: warm starts, the order of the tree and sleep die with it.

namespace swarmsmith {
namespace {

constexpr double kSkin_m = b2_polygonRadius;
constexpr int kVelocityIterations = 10;
/// The original tolerates 0.1 m of overlap, so positions are never pushed apart.
constexpr int kPositionIterations = 0;

b2Vec2 vector(double x, double y) {
  return {static_cast<float>(x), static_cast<float>(y)};
}

b2Body* add_robot(b2World& world, const Body& body) {
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position = vector(body.x + kSubStep_s * body.vx, body.y + kSubStep_s * body.vy);
  definition.angle = static_cast<float>(atan2(body.sin, body.cos) + kSubStep_s * body.spin);
  definition.linearVelocity = vector(body.vx, body.vy);
  definition.angularVelocity = static_cast<float>(body.spin);
  definition.allowSleep = false;
  b2Body* robot = world.CreateBody(&definition);
  b2PolygonShape square;
  const auto half = static_cast<float>(kHalfSide_m - kSkin_m);
  square.SetAsBox(half, half);
  b2FixtureDef fixture;
  fixture.shape = &square;
  fixture.friction = static_cast<float>(kFriction);
  robot->CreateFixture(&fixture);
  b2MassData mass;
  mass.mass = static_cast<float>(kMass_kg);
  mass.center.SetZero();
  mass.I = static_cast<float>(kInertia_kg_m2);
  robot->SetMassData(&mass);
  return robot;
}

void add_drive(b2World& world, b2Body* robot, const SetPoint& set_point) {
  b2BodyDef definition;
  definition.type = b2_kinematicBody;
  definition.position = robot->GetPosition();
  definition.linearVelocity = vector(set_point.vx, set_point.vy);
  definition.angularVelocity = static_cast<float>(set_point.spin);
  definition.allowSleep = false;
  b2FrictionJointDef joint;
  joint.Initialize(world.CreateBody(&definition), robot, robot->GetPosition());
  joint.maxForce = static_cast<float>(kMaxForce_N);
  joint.maxTorque = static_cast<float>(kMaxTorque_Nm);
  world.CreateJoint(&joint);
}

void add_walls(b2World& world, std::span<const WallPlane> walls) {
  b2BodyDef definition;
  b2Body* ground = world.CreateBody(&definition);
  for (const WallPlane& wall : walls) {
    const double x = wall.from.x + kSkin_m * wall.nx;
    const double y = wall.from.y + kSkin_m * wall.ny;
    b2EdgeShape edge;
    edge.SetTwoSided(vector(x, y),
                     vector(x - wall.ny * wall.length_m, y + wall.nx * wall.length_m));
    b2FixtureDef fixture;
    fixture.shape = &edge;
    fixture.friction = static_cast<float>(kFriction);
    ground->CreateFixture(&fixture);
  }
}

Body taken_from(const b2Body& robot) {
  const b2Vec2 velocity = robot.GetLinearVelocity();
  Body body;
  body.vx = velocity.x;
  body.vy = velocity.y;
  body.spin = robot.GetAngularVelocity();
  body.x = robot.GetPosition().x - kSubStep_s * body.vx;
  body.y = robot.GetPosition().y - kSubStep_s * body.vy;
  const SinCos heading = sin_cos(robot.GetAngle() - kSubStep_s * body.spin);
  body.cos = heading.cos;
  body.sin = heading.sin;
  return body;
}

/// Box2D fills a global table when the first contact is made: here, before threads race for it.
void prepare_globals() {
  static std::once_flag once;
  std::call_once(once, [] {
    b2World world(b2Vec2_zero);
    add_robot(world, Body{});
    add_robot(world, Body{.x = 0.2});
    world.Step(static_cast<float>(kSubStep_s), 1, 0);
  });
}

class Box2dSolver final : public ContactSolver {
 public:
  void advance(std::span<IslandMember> island, std::span<const WallPlane> walls,
               int sub_steps) override {
    b2World world(b2Vec2_zero);
    world.SetAllowSleeping(false);
    world.SetContinuousPhysics(false);
    add_walls(world, walls);
    robots_.clear();
    for (const IslandMember& member : island) {
      robots_.push_back(add_robot(world, member.body));
      add_drive(world, robots_.back(), member.set_point);
    }
    for (int i = 0; i < sub_steps; ++i) {
      world.Step(static_cast<float>(kSubStep_s), kVelocityIterations, kPositionIterations);
    }
    for (std::size_t i = 0; i < island.size(); ++i)
      island[i].body = taken_from(*robots_[i]);
  }

 private:
  std::vector<b2Body*> robots_;
};

}  // namespace

std::unique_ptr<ContactSolver> make_box2d_solver() {
  prepare_globals();
  return std::make_unique<Box2dSolver>();
}

}  // namespace swarmsmith
