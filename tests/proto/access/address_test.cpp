#include "proto/access/address.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

bool loopback(const std::string& endpoint) {
  return is_loopback(address_of(endpoint).value());
}

TEST(Addresses, AreTakenApart) {
  EXPECT_EQ(address_of("tcp://node1:5555")->host, "node1");
  EXPECT_EQ(address_of("tcp://[::1]:5555")->host, "[::1]");
  EXPECT_EQ(address_of("tcp://[::1]:5555")->port, "5555");
  EXPECT_FALSE(address_of("node1:5555"));
  EXPECT_FALSE(address_of("tcp://node1"));
}

TEST(Addresses, OfThisHostOnlyAreKnown) {
  EXPECT_TRUE(loopback("tcp://127.0.0.1:1"));
  EXPECT_TRUE(loopback("tcp://127.8.0.1:1"));
  EXPECT_TRUE(loopback("tcp://[::1]:1"));
  EXPECT_TRUE(loopback("tcp://localhost:1"));
  EXPECT_FALSE(loopback("tcp://0.0.0.0:1"));
  EXPECT_FALSE(loopback("tcp://*:1"));
  EXPECT_FALSE(loopback("tcp://10.0.0.1:1"));
  // A name of somebody else's, not a number.
  EXPECT_FALSE(loopback("tcp://127.example.org:1"));
  EXPECT_FALSE(loopback("tcp://localhost.example.org:1"));
}

TEST(Addresses, AreAdvertisedAsOthersReachThem) {
  EXPECT_EQ(advertised_endpoint("tcp://10.0.0.1:5555", ""), "tcp://10.0.0.1:5555");
  EXPECT_EQ(advertised_endpoint("tcp://0.0.0.0:5555", "login1"), "tcp://login1:5555");
  EXPECT_EQ(advertised_endpoint("tcp://10.0.0.1:5555", "login1"), "tcp://login1:5555");
  const auto found = address_of(advertised_endpoint("tcp://0.0.0.0:5555", ""));
  ASSERT_TRUE(found);
  EXPECT_FALSE(is_wildcard(*found));
  EXPECT_EQ(found->port, "5555");
  EXPECT_EQ(local_endpoint("tcp://0.0.0.0:5555"), "tcp://127.0.0.1:5555");
  EXPECT_EQ(local_endpoint("tcp://10.0.0.1:5555"), "tcp://10.0.0.1:5555");
}

}  // namespace
}  // namespace swarmsmith
