#include "proto/access/address.h"

#include <string>
#include <vector>

#include "proto/socket.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(Endpoints, AreWhatAPersonTypesWithItsScheme) {
  EXPECT_EQ(endpoint_of("node1:5555", true), "tcp://node1:5555");
  EXPECT_EQ(endpoint_of("tcp://[fd00::1]:5555", true), "tcp://[fd00::1]:5555");
  EXPECT_EQ(endpoint_of("[::]:0", false), "tcp://[::]:*");
  EXPECT_EQ(endpoint_of("node1:0", false), "tcp://node1:*");
  EXPECT_EQ(why_not(endpoint_of("tcp://node1:*", true)),
            (Error{ErrorKind::BadInput, "the port is missing; write one, such as node1:5555",
                   "tcp://node1:*"}));
  const Error bare = why_not(endpoint_of("fd00::1:5555", true));
  EXPECT_THAT(bare.message, HasSubstr("brackets"));
  EXPECT_EQ(bare.where, "fd00::1:5555");
  EXPECT_FALSE(endpoint_of("http://node1:5555", true));
}

TEST(Endpoints, AreTakenApart) {
  EXPECT_EQ(address_of("tcp://node1:5555"), (Address{"node1", 5555}));
  EXPECT_EQ(address_of("tcp://[::1]:5555"), (Address{"::1", 5555}));
  EXPECT_FALSE(address_of("node1:5555"));
  EXPECT_FALSE(address_of("tcp://node1"));
}

TEST(Endpoints, AreAdvertisedAsOthersReachThem) {
  EXPECT_EQ(advertised_endpoint("tcp://10.0.0.1:5555", ""), "tcp://10.0.0.1:5555");
  EXPECT_EQ(advertised_endpoint("tcp://[fd00::1]:5555", ""), "tcp://[fd00::1]:5555");
  EXPECT_EQ(advertised_endpoint("tcp://0.0.0.0:5555", "login1"), "tcp://login1:5555");
  EXPECT_EQ(advertised_endpoint("tcp://[::]:5555", "fd00::1"), "tcp://[fd00::1]:5555");
  EXPECT_EQ(advertised_endpoint("tcp://[::]:5555", "[fd00::1]"), "tcp://[fd00::1]:5555");
  EXPECT_EQ(advertised_endpoint("tcp://10.0.0.1:5555", "login1"), "tcp://login1:5555");
  EXPECT_EQ(advertised_endpoint("no endpoint", "login1"), "no endpoint");
  for (const char* all : {"tcp://0.0.0.0:5555", "tcp://[::]:5555", "tcp://*:5555"}) {
    const auto found = value_of(address_of(advertised_endpoint(all, "")));
    EXPECT_FALSE(is_wildcard(found.host));
    EXPECT_EQ(found.port, 5555);
    // A name that is known here by numbers of loopback alone is none for others.
    if (!numbers_of_this_host().empty() && !is_host_number(found.host)) {
      EXPECT_THAT(numbers_of(found.host).value(),
                  Contains(testing::Truly([](const auto& n) { return !is_loopback(n); })));
    }
  }
}

TEST(Endpoints, AreAdvertisedByNumbersToo) {
  EXPECT_THAT(advertised_numbers("tcp://10.0.0.1:5555", ""), IsEmpty());
  EXPECT_THAT(advertised_numbers("tcp://0.0.0.0:5555", "login1"), IsEmpty());
  EXPECT_THAT(advertised_numbers("no endpoint", ""), IsEmpty());
  const auto with_port = [](std::vector<std::string> numbers) {
    for (std::string& number : numbers)
      number = tcp_endpoint({number, 5555});
    return numbers;
  };
  for (const char* all : {"tcp://*:5555", "tcp://[::]:5555"})
    EXPECT_EQ(advertised_numbers(all, ""), with_port(numbers_of_this_host(Family::Any))) << all;
  EXPECT_EQ(advertised_numbers("tcp://0.0.0.0:5555", ""),
            with_port(numbers_of_this_host(Family::Four)));
}

TEST(Endpoints, AreReachedFromThisHost) {
  EXPECT_EQ(local_endpoint("tcp://0.0.0.0:5555"), "tcp://127.0.0.1:5555");
  EXPECT_EQ(local_endpoint("tcp://[::]:5555"), "tcp://127.0.0.1:5555");
  EXPECT_EQ(local_endpoint("tcp://10.0.0.1:5555"), "tcp://10.0.0.1:5555");
  EXPECT_EQ(local_endpoint("no endpoint"), "no endpoint");
}

}  // namespace
}  // namespace swarmsmith
