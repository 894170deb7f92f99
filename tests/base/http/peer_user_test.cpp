#include "base/peer_user.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <optional>
#include <utility>

#include "base/http/request_door.h"

namespace swarmsmith {
namespace {

/// Both ends of a connection within this host.
class PeerUserTest : public testing::TestWithParam<const char*> {
 protected:
  ~PeerUserTest() override {
    for (const int socket : {listening_, theirs_, ours_})
      if (socket >= 0) close(socket);
  }

  void connect_ends() {
    const auto listening = listen_for_requests(GetParam(), 0);
    if (!listening) GTEST_SKIP() << to_string(listening.error());
    listening_ = listening->descriptor;
    sockaddr_storage address = {};
    socklen_t size = sizeof address;
    getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
    theirs_ = socket(address.ss_family, SOCK_STREAM, 0);
    ASSERT_EQ(connect(theirs_, reinterpret_cast<sockaddr*>(&address), size), 0);
    ours_ = accept(listening_, nullptr, nullptr);
    ASSERT_GE(ours_, 0);
  }
  void close_theirs() { close(std::exchange(theirs_, -1)); }

  int listening_ = -1;
  int theirs_ = -1;
  int ours_ = -1;
};

TEST_P(PeerUserTest, IsTheUserWhoHoldsTheOtherEnd) {
  ASSERT_NO_FATAL_FAILURE(connect_ends());
  if (IsSkipped()) return;
  EXPECT_EQ(user_of_peer(ours_), geteuid());
  EXPECT_EQ(user_of_peer(theirs_), geteuid());
  EXPECT_EQ(address_of_peer(ours_), GetParam());
}

TEST_P(PeerUserTest, IsTheUserWhoMadeTheConnection) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  constexpr uid_t kNobody = 65534;
  ASSERT_EQ(seteuid(kNobody), 0);
  connect_ends();
  ASSERT_EQ(seteuid(0), 0);
  if (IsSkipped()) return;
  EXPECT_EQ(user_of_peer(ours_), kNobody);
}

/// Of a socket that no process holds the kernel says that it is root's.
TEST_P(PeerUserTest, IsUnknownWhenTheOtherEndWasClosed) {
  ASSERT_NO_FATAL_FAILURE(connect_ends());
  if (IsSkipped()) return;
  close_theirs();
  EXPECT_EQ(user_of_peer(ours_), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(OfLoopback, PeerUserTest, testing::Values("127.0.0.1", "::1"));

TEST(PeerUser, IsUnknownWithoutAConnection) {
  const int alone = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_EQ(user_of_peer(alone), std::nullopt);
  EXPECT_EQ(user_of_peer(-1), std::nullopt);
  close(alone);
}

}  // namespace
}  // namespace swarmsmith
