#include "proto/access/find_coordinator.h"

#include <cstdlib>

#include "proto/access/coordinator_file.h"
#include "proto/access/key_file.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

constexpr const char* kNear = "tcp://127.0.0.1:5555";
constexpr const char* kFar = "tcp://login1:5555";

/// Whether a client goes on in plaintext is decided here and nowhere else.
class FindCoordinator : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(make_key_folder(folder));
    unsetenv("SWARMSMITH_KEY");
    setenv("SWARMSMITH_KEYS", folder.path.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("SWARMSMITH_KEY");
    unsetenv("SWARMSMITH_KEYS");
  }

  /// A coordinator's file: what it says of itself.
  void write(const std::string& endpoint, const std::string& public_key) {
    CoordinatorFile there;
    there.endpoint = endpoint;
    there.others = {"tcp://10.0.0.1:5555"};
    there.public_key = public_key;
    there.host = "login1";
    there.started = "2026-11-21T15:37:00Z";
    ASSERT_TRUE(write_coordinator_file(file, there));
  }
  /// "keys", "plain", or why not.
  std::string found(const CoordinatorSearch& search) {
    const auto coordinator = find_coordinator(search);
    if (!coordinator) return to_string(coordinator.error());
    return coordinator->keys ? "keys" : "plain";
  }

  TemporaryFolder temporary;
  const KeyFolder folder{temporary / "keys"};
  const std::filesystem::path file = temporary / "c.db.coordinator";
  const std::filesystem::path own = folder.client_key("operator");
};

TEST_F(FindCoordinator, AtAnEndpointEncryptsUnlessItIsOnLoopbackOrPlaintextIsInsistedOn) {
  EXPECT_EQ(found({.endpoint = kFar}), "keys");
  EXPECT_EQ(found({.endpoint = kNear}), "plain");
  EXPECT_EQ(found({.endpoint = kFar, .insecure_plaintext = true}), "plain");
  EXPECT_EQ(found({.endpoint = kNear, .insecure_plaintext = true}), "plain");
  // A key of one's own is always used.
  for (const char* endpoint : {kNear, kFar}) {
    for (const bool insecure : {false, true})
      EXPECT_EQ(found({.endpoint = endpoint, .key = own, .insecure_plaintext = insecure}), "keys");
  }
}

TEST_F(FindCoordinator, ByItsFileEncryptsWheneverTheFileHasAKey) {
  const std::string server = read_server_key(folder.server_key())->public_key;
  for (const char* endpoint : {kNear, kFar}) {
    write(endpoint, server);
    for (const bool insecure : {false, true}) {
      for (const auto& key : {std::filesystem::path(), own}) {
        EXPECT_EQ(found({.file = file, .key = key, .insecure_plaintext = insecure}), "keys")
            << endpoint << insecure << key;
      }
    }
  }
}

TEST_F(FindCoordinator, ByAFileWithoutAKeyIsPlaintextOnLoopbackOrWhereItIsInsistedOn) {
  write(kNear, "");
  EXPECT_EQ(found({.file = file}), "plain");
  EXPECT_EQ(
      found({.file = file, .key = own}),
      file.string() + ": the coordinator does not encrypt, but a key was given; leave out --key");
  write(kFar, "");
  EXPECT_EQ(found({.file = file}),
            file.string() +
                ": this coordinator does not encrypt; start it with keys (`swarmsmith keygen`), or "
                "accept it with --insecure-plaintext");
  EXPECT_THAT(found({.file = file, .key = own}), HasSubstr("does not encrypt; start it"));
  EXPECT_EQ(found({.file = file, .insecure_plaintext = true}), "plain");
  EXPECT_THAT(found({.file = file, .key = own, .insecure_plaintext = true}),
              HasSubstr("leave out --key"));
}

TEST_F(FindCoordinator, SaysWhereElseItMayBeFound) {
  write(kNear, "");
  EXPECT_EQ(find_coordinator({.file = file})->others,
            std::vector<std::string>{"tcp://10.0.0.1:5555"});
  write(kNear, read_server_key(folder.server_key())->public_key);
  const auto coordinator = find_coordinator({.file = file});
  EXPECT_EQ(coordinator->others, std::vector<std::string>{"tcp://10.0.0.1:5555"});
  EXPECT_EQ(coordinator->endpoint, kNear);
  EXPECT_EQ(coordinator->keys->server_key, read_server_key(folder.server_key())->public_key);
  EXPECT_EQ(find_coordinator({.endpoint = kFar})->endpoint, kFar);
  EXPECT_EQ(find_coordinator({.endpoint = kNear})->endpoint, kNear);
  EXPECT_TRUE(find_coordinator({.endpoint = kNear})->others.empty());
}

TEST_F(FindCoordinator, TakesTheKeyOfTheRoleOrTheOneThatIsNamed) {
  const auto secret_of = [](const CoordinatorSearch& search) {
    return find_coordinator(search)->keys->secret_key;
  };
  const auto of_file = [](const std::filesystem::path& path) {
    return read_client_key(path)->pair.secret_key;
  };
  EXPECT_EQ(secret_of({.endpoint = kFar}), of_file(folder.client_key("worker")));
  EXPECT_EQ(secret_of({.endpoint = kFar, .role = "reader"}), of_file(folder.client_key("reader")));
  setenv("SWARMSMITH_KEY", own.c_str(), 1);
  EXPECT_EQ(secret_of({.endpoint = kFar}), of_file(own));
  EXPECT_EQ(secret_of({.endpoint = kFar, .key = folder.client_key("reader")}),
            of_file(folder.client_key("reader")));
  // An empty variable names nothing.
  setenv("SWARMSMITH_KEY", "", 1);
  EXPECT_EQ(default_client_key("reader"), folder.client_key("reader"));
}

TEST_F(FindCoordinator, RefusesAKeyOfAnotherCoordinator) {
  write(kFar, make_key_pair().public_key);
  EXPECT_EQ(found({.file = file}), folder.client_key("worker").string() +
                                       ": this key is for another coordinator than the one in " +
                                       file.string() +
                                       "; use a key from that coordinator's folder");
  EXPECT_THAT(found({.file = file, .insecure_plaintext = true}),
              HasSubstr("is for another coordinator"));
}

TEST_F(FindCoordinator, SaysWhatIsMissing) {
  EXPECT_EQ(why_not(find_coordinator({.file = file})).kind, ErrorKind::NotFound)
      << "it may come yet";
  std::filesystem::remove(folder.client_key("worker"));
  const Error keyless = why_not(find_coordinator({.endpoint = kFar}));
  EXPECT_EQ(keyless,
            (Error{ErrorKind::BadInput,
                   "there is no such key file, and tcp://login1:5555 needs a key; copy "
                   "the one that `swarmsmith keygen` made, or name another file with --key",
                   folder.client_key("worker").string()}));
  EXPECT_EQ(
      why_not(find_coordinator({.endpoint = kFar, .key = temporary / "no.key"})),
      (Error{ErrorKind::BadInput, "there is no such key file", (temporary / "no.key").string()}));
}

}  // namespace
}  // namespace swarmsmith
