#include "base/address.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::string fault_of(const std::string& text) {
  const auto address = parse_address(text);
  return address ? "" : address.error().message;
}

TEST(Address, IsHostAndPort) {
  EXPECT_EQ(parse_address("node1:5555"), (Address{"node1", 5555}));
  EXPECT_EQ(parse_address("[fd00::1]:5555"), (Address{"fd00::1", 5555}));
  EXPECT_EQ(parse_address("[fe80::1%eth0]:1"), (Address{"fe80::1%eth0", 1}));
  EXPECT_EQ(parse_address("*:0"), (Address{"*", 0}));
  EXPECT_EQ(parse_address("localhost:*"), (Address{"localhost", 0}));
  for (const char* wrong : {"", "8347", "a:", "a:-1", "a:+1", "a:65536", "a:80x", ":80", "[::1]",
                            "[::1", "[::1]5", "[a]:5", "[]:5", "a:b:5"})
    EXPECT_THAT(fault_of(wrong), HasSubstr("such as")) << wrong;
}

TEST(Address, OfIpv6HasBrackets) {
  EXPECT_THAT(fault_of("fd00::1:5555"), HasSubstr("an IPv6 address is in brackets"));
  EXPECT_EQ(to_string(Address{"fd00::1", 5555}), "[fd00::1]:5555");
  EXPECT_EQ(to_string(Address{"node1", 0}), "node1:*");
  for (const char* text : {"node1:5555", "[fd00::1]:5555", "[fe80::1%eth0]:5555", "*:*"})
    EXPECT_EQ(to_string(parse_address(text).value()), text);
}

TEST(Address, OfThisHostAloneIsKnown) {
  for (const char* host :
       {"127.0.0.1", "127.8.0.1", "::1", "0:0::1", "localhost", "::ffff:127.0.0.1"})
    EXPECT_TRUE(is_loopback(host)) << host;
  // Names of another host, too, not numbers.
  for (const char* host : {"0.0.0.0", "*", "::", "10.0.0.1", "127.example.org",
                           "localhost.example.org", "::2", "fd00::1", "::ffff:10.0.0.1"})
    EXPECT_FALSE(is_loopback(host)) << host;
}

TEST(Address, OfAllInterfacesIsKnown) {
  for (const char* host : {"*", "0.0.0.0", "::", "0:0:0:0:0:0:0:0"})
    EXPECT_TRUE(is_wildcard(host)) << host;
  for (const char* host : {"127.0.0.1", "::1", "node1"})
    EXPECT_FALSE(is_wildcard(host)) << host;
}

TEST(Numbers, AreLookedUp) {
  EXPECT_THAT(numbers_of("10.0.0.1").value(), ElementsAre("10.0.0.1"));
  EXPECT_THAT(numbers_of("fd00::1").value(), ElementsAre("fd00::1"));
  EXPECT_THAT(numbers_of("localhost", Family::Four).value(), ElementsAre("127.0.0.1"));
}

TEST(Numbers, OfAnUnknownNameAreNamedAsSuch) {
  const Error numbers = why_not(numbers_of("no-such-host.invalid"));
  EXPECT_EQ(numbers.kind, ErrorKind::Unavailable);
  EXPECT_THAT(numbers.message, HasSubstr("the name `no-such-host.invalid`"));
}

TEST(Numbers, ThatAreLinkLocalNeedTheirInterface) {
  EXPECT_THAT(numbers_of("fe80::1").error().message, HasSubstr("[fe80::1%eth0]"));
  EXPECT_THAT(numbers_of("fe80::1%none7").error().message, HasSubstr("no interface `none7`"));
  EXPECT_THAT(numbers_of("fe80::1%lo").value(), ElementsAre("fe80::1%lo"));
}

TEST(Numbers, OfThisHostAreForOthers) {
  for (const std::string& number : numbers_of_this_host()) {
    EXPECT_TRUE(is_host_number(number)) << number;
    EXPECT_FALSE(is_loopback(number)) << number;
  }
  for (const std::string& number : numbers_of_this_host(Family::Four))
    EXPECT_EQ(number.find(':'), std::string::npos);
}

}  // namespace
}  // namespace swarmsmith
