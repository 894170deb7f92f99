#include <box2d/box2d.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "base/math.h"
#include "sim/engine/internal/contact_solver.h"
#include "sim/engine/internal/contacts.h"
#include "sim/engine/internal/motion.h"

// Box2D 2.4, set up like the original simulator (simulator facts, section 4.2). The drive is a
// friction joint to a kinematic body that moves with the set-point. Box2D's order (solve
// velocities, then move) is adapted to ours (move, find contacts, solve velocities) by giving it
// poses one sub-step ahead. Its shapes have no skin, so that they meet at their true outlines. A
// new b2World for each call keeps evaluations independent of each other, because warm starts, the
// order of the tree and sleep are not kept.

namespace swarmsmith {
namespace {

constexpr int kVelocityIterations = 10;
/// The original tolerates 0.1 m of overlap: it never pushes bodies apart.
constexpr int kPositionIterations = 3;

b2Vec2 vector(double x, double y) {
  return {static_cast<float>(x), static_cast<float>(y)};
}

/// Adds the form to the body; `at` is its pose in the body's frame.
void add_fixture(b2Body* body, const Form& form, const Body& at, double friction) {
  b2CircleShape circle;
  b2PolygonShape polygon;
  b2FixtureDef fixture;
  fixture.friction = static_cast<float>(friction);
  if (form.is_circle()) {
    circle.m_p = vector(at.x, at.y);
    circle.m_radius = static_cast<float>(form.radius_m);
    fixture.shape = &circle;
  } else {
    // Filled by hand, because Set() would merge corners of small polygons.
    polygon.m_count = static_cast<int32>(form.corners.size());
    polygon.m_centroid = vector(at.x, at.y);
    polygon.m_radius = 0;
    for (std::size_t i = 0; i < form.corners.size(); ++i) {
      const Point& corner = form.corners[i];
      const Point& normal = form.normals[i];
      polygon.m_vertices[i] = vector(at.x + at.cos * corner.x - at.sin * corner.y,
                                     at.y + at.sin * corner.x + at.cos * corner.y);
      polygon.m_normals[i] =
          vector(at.cos * normal.x - at.sin * normal.y, at.sin * normal.x + at.cos * normal.y);
    }
    fixture.shape = &polygon;
  }
  body->CreateFixture(&fixture);
}

b2Body* add_mover(b2World& world, const Mover& mover) {
  const Body& body = mover.body;
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position = vector(body.x + kSubStep_s * body.vx, body.y + kSubStep_s * body.vy);
  definition.angle = static_cast<float>(atan2(body.sin, body.cos) + kSubStep_s * body.spin);
  definition.linearVelocity = vector(body.vx, body.vy);
  definition.angularVelocity = static_cast<float>(body.spin);
  definition.allowSleep = false;
  b2Body* result = world.CreateBody(&definition);
  add_fixture(result, mover.form(), Body{}, mover.kind->friction);
  b2MassData mass;
  mass.mass = static_cast<float>(mover.dynamics().mass_kg);
  mass.center.SetZero();
  mass.I = static_cast<float>(mover.dynamics().inertia_kg_m2);
  result->SetMassData(&mass);
  return result;
}

void add_drive(b2World& world, b2Body* body, const Mover& mover) {
  b2BodyDef definition;
  definition.type = b2_kinematicBody;
  definition.position = body->GetPosition();
  definition.linearVelocity = vector(mover.set_point.vx, mover.set_point.vy);
  definition.angularVelocity = static_cast<float>(mover.set_point.spin);
  definition.allowSleep = false;
  b2FrictionJointDef joint;
  joint.Initialize(world.CreateBody(&definition), body, body->GetPosition());
  joint.maxForce = static_cast<float>(mover.dynamics().max_force_N);
  joint.maxTorque = static_cast<float>(mover.dynamics().max_torque_Nm);
  world.CreateJoint(&joint);
}

void add_wall(b2Body* ground, const Walls& walls, std::size_t index, double friction) {
  const std::size_t n = walls.planes.size();
  const WallPlane& wall = walls.planes[index];
  const Point from = wall.from;
  const Point to = {from.x - wall.ny * wall.length_m, from.y + wall.nx * wall.length_m};
  const Point before = walls.planes[(index + n - 1) % n].from;
  const WallPlane& next = walls.planes[(index + 1) % n];
  const Point after = {next.from.x - next.ny * next.length_m,
                       next.from.y + next.nx * next.length_m};
  b2EdgeShape edge;
  // Box2D's edges face right, ours left. The neighbouring vertices keep bodies that slide along a
  // wall from catching on the joints.
  edge.SetOneSided(vector(after.x, after.y), vector(to.x, to.y), vector(from.x, from.y),
                   vector(before.x, before.y));
  edge.m_radius = 0;
  b2FixtureDef fixture;
  fixture.shape = &edge;
  fixture.friction = static_cast<float>(friction);
  ground->CreateFixture(&fixture);
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

/// Box2D fills a global table when the first contact is made: this does it before several threads
/// can.
void prepare_globals() {
  static std::once_flag once;
  std::call_once(once, [] {
    b2World world(b2Vec2_zero);
    add_mover(world, Mover{});
    add_mover(world, Mover{.body = {.x = 0.2}, .set_point = {}});
    world.Step(static_cast<float>(kSubStep_s), 1, 0);
  });
}

class Box2dSolver final : public ContactSolver {
 public:
  Box2dSolver(const Surroundings& surroundings, bool plain)
      : surroundings_(&surroundings), position_iterations_(plain ? 0 : kPositionIterations) {}

  void advance(std::span<Mover> movers, std::span<const Island> islands, int sub_steps) override {
    for (const Island& island : islands) {
      // Most islands are false alarms, or come into contact late: until then the motion is free.
      const int quiet = quiet_sub_steps(movers, island, *surroundings_, sub_steps);
      for (const int index : island.movers) {
        Mover& mover = movers[static_cast<std::size_t>(index)];
        advance_freely(mover.body, mover.set_point, quiet, mover.dynamics());
      }
      if (quiet < sub_steps) advance_touching(movers, island, sub_steps - quiet);
    }
  }

 private:
  void advance_touching(std::span<Mover> movers, const Island& island, int sub_steps) {
    b2World world(b2Vec2_zero);
    world.SetAllowSleeping(false);
    world.SetContinuousPhysics(false);
    add_surroundings(world, island);
    bodies_.clear();
    for (const int index : island.movers) {
      const Mover& mover = movers[static_cast<std::size_t>(index)];
      bodies_.push_back(add_mover(world, mover));
      add_drive(world, bodies_.back(), mover);
    }
    for (int i = 0; i < sub_steps; ++i) {
      world.Step(static_cast<float>(kSubStep_s), kVelocityIterations, position_iterations_);
      mark_touched(world);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Mover& mover = movers[static_cast<std::size_t>(island.movers[i])];
      if (bodies_[i]->GetUserData().pointer != 0) {
        mover.body = taken_from(*bodies_[i]);
      } else {
        advance_freely(mover.body, mover.set_point, sub_steps, mover.dynamics());
      }
    }
  }

  void add_surroundings(b2World& world, const Island& island) {
    const b2BodyDef definition;
    b2Body* ground = world.CreateBody(&definition);
    for (const std::size_t wall : distinct(island.walls))
      add_wall(ground, surroundings_->walls, wall, surroundings_->friction);
    for (const std::size_t obstacle : distinct(island.obstacles)) {
      const FixedSolid& solid = surroundings_->obstacles[obstacle];
      add_fixture(ground, solid.form, solid.at, surroundings_->friction);
    }
  }

  /// The other bodies of the meetings, each once.
  const std::vector<std::size_t>& distinct(const std::vector<Meeting>& meetings) {
    distinct_.clear();
    for (const Meeting& meeting : meetings)
      distinct_.push_back(static_cast<std::size_t>(meeting.other));
    std::sort(distinct_.begin(), distinct_.end());
    distinct_.erase(std::unique(distinct_.begin(), distinct_.end()), distinct_.end());
    return distinct_;
  }

  static void mark_touched(b2World& world) {
    for (b2Contact* contact = world.GetContactList(); contact; contact = contact->GetNext()) {
      if (!contact->IsTouching()) continue;
      contact->GetFixtureA()->GetBody()->GetUserData().pointer = 1;
      contact->GetFixtureB()->GetBody()->GetUserData().pointer = 1;
    }
  }

  const Surroundings* surroundings_;
  int position_iterations_;
  std::vector<b2Body*> bodies_;
  std::vector<std::size_t> distinct_;
};

}  // namespace

std::unique_ptr<ContactSolver> make_box2d_solver(const Surroundings& surroundings, bool plain) {
  prepare_globals();
  return std::make_unique<Box2dSolver>(surroundings, plain);
}

}  // namespace swarmsmith
