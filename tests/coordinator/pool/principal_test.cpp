#include "coordinator/pool/principal.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

std::string named(const std::string& client, const std::string& address) {
  return principal_of({.client = client, .address = address});
}

TEST(Principal, IsKeyAndAddress) {
  EXPECT_EQ(named("node1", "10.0.0.5"), "node1@10.0.0.5");
  EXPECT_EQ(named("", "10.0.0.5"), "10.0.0.5");
  EXPECT_EQ(named("node1", "::ffff:10.0.0.5"), "node1@10.0.0.5");
}

TEST(Principal, HasOneLoopback) {
  EXPECT_EQ(named("", "127.0.0.1"), "loopback");
  EXPECT_EQ(named("", "127.44.3.9"), "loopback");
  EXPECT_EQ(named("", "::1"), "loopback");
  EXPECT_EQ(named("", "::ffff:127.0.0.1"), "loopback");
}

TEST(Principal, IsANetworkOfIPv6) {
  EXPECT_EQ(named("", "2001:db8:1:2:aaaa::1"), "2001:db8:1:2::/64");
  EXPECT_EQ(named("", "2001:db8:1:2:bbbb::9"), "2001:db8:1:2::/64");
  EXPECT_NE(named("", "2001:db8:1:3::1"), "2001:db8:1:2::/64");
}

TEST(Principal, IsItselfWhenThisProcessStartedIt) {
  const WorkerHello own{.identity = "ab", .address = "127.0.0.1", .local = true};
  EXPECT_EQ(principal_of(own), "local 6162");
}

TEST(Principals, ForgetThoseOfWhomNothingIsKnown) {
  Principals principals;
  principals.at("a");
  principals.at("b").standing(1).unchecked_of(0) = 1;
  principals.at("c").quarantined = true;
  principals.at("process that left").standing(1);
  principals.at("worker").workers = {4};
  principals.at("worker").standing(4).taken = 3;
  principals.at("worker").standing(5).taken = 3;
  principals.at("on trial").standing(1).on_trial = 1;
  principals.forget_idle();
  EXPECT_EQ(principals.find("process that left"), nullptr);
  ASSERT_NE(principals.find("worker"), nullptr);
  EXPECT_EQ(principals.find("worker")->standings.size(), 1U);
  EXPECT_TRUE(principals.find("worker")->standings.contains(4));
  EXPECT_NE(principals.find("on trial"), nullptr);
  EXPECT_EQ(principals.find("a"), nullptr);
  EXPECT_NE(principals.find("b"), nullptr);
  EXPECT_NE(principals.find("c"), nullptr);
}

}  // namespace
}  // namespace swarmsmith
