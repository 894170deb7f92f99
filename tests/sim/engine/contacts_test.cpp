#include "sim/engine/internal/contacts.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/engine/internal/motion.h"
#include "tests/sim/engine/islands.h"

namespace swarmsmith {
namespace {

std::vector<Mover> island_of(const std::vector<Pose>& poses) {
  std::vector<Mover> island;
  for (const Pose& pose : poses)
    island.push_back({.body = body_at(pose), .set_point = {}});
  return island;
}

std::vector<Contact> contacts_of(const std::vector<Mover>& island) {
  std::vector<Contact> contacts;
  const Surroundings around = surroundings_of(dodecagon_of_the_thesis());
  find_contacts(island, everything(island.size(), around), around, contacts);
  return contacts;
}

TEST(Contacts, SquaresApartHaveNone) {
  EXPECT_TRUE(contacts_of(island_of({{0, 0, 0}, {0.287, 0, 0}})).empty());
}

TEST(Contacts, ACornerInAFaceIsOneAlongTheFacesNormal) {
  const auto contacts = contacts_of(island_of({{0, 0, 0}, {0.34, 0.02, kPi / 4}}));
  ASSERT_EQ(contacts.size(), 1);
  EXPECT_EQ(contacts[0].a, 0);
  EXPECT_EQ(contacts[0].b, 1);
  EXPECT_DOUBLE_EQ(contacts[0].nx, 1);
  EXPECT_NEAR(contacts[0].ax, 0.34 - kCornerRadius_m, 1e-12);
  EXPECT_NEAR(contacts[0].ay, 0.02, 1e-12);
  EXPECT_NEAR(contacts[0].bx, -kCornerRadius_m, 1e-12);
}

TEST(Contacts, FacesThatMeetAskewHaveTwo) {
  const auto contacts = contacts_of(island_of({{0, 0, 0}, {0.284, 0.1, 0}}));
  ASSERT_EQ(contacts.size(), 2);
  EXPECT_EQ(contacts[0].nx, 1);
  EXPECT_NE(contacts[0].id, contacts[1].id);
}

TEST(Contacts, AFaceFlatOnAWallHasTwo) {
  const auto contacts = contacts_of(island_of({{1.226 - kHalfSide_m + 0.001, 0, 0}}));
  ASSERT_EQ(contacts.size(), 2);
  EXPECT_EQ(contacts[0].b, -1);
  EXPECT_NEAR(contacts[0].nx, 1, 1e-12);
  EXPECT_NEAR(contacts[0].ax, kHalfSide_m, 1e-12);
}

TEST(Contacts, NormalsPointFromTheFirstToTheOtherAndIdsAreDistinct) {
  Rng rng(1);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto island = island_of({{0, 0, rng.uniform(-kPi, kPi)},
                                   {rng.uniform(0.2, 0.3), 0, rng.uniform(-kPi, kPi)},
                                   {0, rng.uniform(0.2, 0.3), rng.uniform(-kPi, kPi)}});
    std::set<std::uint64_t> ids;
    const std::vector<Contact> contacts = contacts_of(island);
    for (const Contact& contact : contacts) {
      const Body& a = island[static_cast<std::size_t>(contact.a)].body;
      const Body& b = island[static_cast<std::size_t>(contact.b)].body;
      EXPECT_GT(contact.nx * (b.x - a.x) + contact.ny * (b.y - a.y), 0);
      // Both lead to the same point.
      EXPECT_NEAR(a.x + contact.ax, b.x + contact.bx, 1e-15);
      EXPECT_NEAR(a.y + contact.ay, b.y + contact.by, 1e-15);
      ids.insert(contact.id);
    }
    EXPECT_EQ(ids.size(), contacts.size());
    found += static_cast<int>(contacts.size());
  }
  EXPECT_GT(found, 1000);
}

TEST(QuietSubSteps, AreAllThatAreLeftWhenNothingMoves) {
  EXPECT_EQ(quiet_sub_steps(island_of({{0, 0, 0}, {0.29, 0, 0}}), everything(2, {}), {}, 10), 10);
}

TEST(QuietSubSteps, AreNoneOnceSquaresTouch) {
  EXPECT_EQ(quiet_sub_steps(island_of({{0, 0, 0}, {0.285, 0, 0}}), everything(2, {}), {}, 10), 0);
}

TEST(QuietSubSteps, NeverEndBehindATouch) {
  Rng rng(2);
  const Surroundings around = surroundings_of(dodecagon_of_the_thesis());
  const Island all = everything(2, around);
  for (int i = 0; i < 5000; ++i) {
    std::vector<Mover> island = island_of(
        {{0.7, 0, rng.uniform(-kPi, kPi)}, {0.7 + rng.uniform(0.3, 0.4), 0, rng.uniform(-3, 3)}});
    for (Mover& member : island) {
      member.body.vx = rng.uniform(-0.3, 0.3);
      member.body.spin = rng.uniform(-4, 4);
      member.set_point = set_point_of({rng.uniform(-0.3, 0.3), 0.3}, member.body);
    }
    const int quiet = quiet_sub_steps(island, all, around, 10);
    std::vector<Contact> contacts;
    for (int step = 0; step < quiet; ++step) {
      for (Mover& member : island)
        sub_step(member.body, member.set_point);
      find_contacts(island, all, around, contacts);
      ASSERT_TRUE(contacts.empty()) << "run " << i << " sub-step " << step;
    }
  }
}

}  // namespace
}  // namespace swarmsmith
