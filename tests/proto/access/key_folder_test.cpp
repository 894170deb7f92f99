#include "proto/access/key_folder.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <latch>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "proto/access/allow_list_file.h"
#include "proto/access/key_file.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

unsigned mode_of(const std::filesystem::path& file) {
  struct stat status = {};
  EXPECT_EQ(stat(file.c_str(), &status), 0) << file;
  return status.st_mode & 0777U;
}

class Keys : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto files = value_of(make_key_folder(folder));
    EXPECT_THAT(files, ElementsAre(folder.server_key(), worker, folder.client_key("operator"),
                                   folder.client_key("reader"), folder.clients()));
  }

  std::string refusal(const std::filesystem::path& file) {
    const auto key = read_client_key(file);
    return key ? "" : to_string(key.error());
  }

  TemporaryFolder temporary;
  const KeyFolder folder{temporary / "keys"};
  const std::filesystem::path worker = folder.client_key("worker");
};

TEST_F(Keys, AreForTheirOwnerOnly) {
  EXPECT_EQ(mode_of(folder.path), 0700U);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path))
    EXPECT_EQ(mode_of(entry.path()), 0600U) << entry.path();
}

TEST_F(Keys, FitTogether) {
  const auto server = value_of(read_server_key(folder.server_key()));
  const auto key = value_of(read_client_key(worker));
  EXPECT_EQ(key.server_key, server.public_key);
  EXPECT_EQ(key.name, "worker");
  EXPECT_EQ(key.role, Role::Worker);
  const auto list = value_of(AllowListFile::open(folder.clients(), {}));
  ASSERT_EQ(list.clients().size(), 3U);
  EXPECT_EQ(list.clients()[0].public_key, key.pair.public_key);
  EXPECT_EQ(list.clients()[1].role, Role::Operator);
  EXPECT_EQ(list.clients()[2].role, Role::Reader);
  EXPECT_THAT(whole_file(folder.clients()), Not(HasSubstr(key.pair.secret_key)));
}

TEST_F(Keys, AreNeverOverwritten) {
  const std::string before = whole_file(worker);
  EXPECT_EQ(why_not(make_key_folder(folder)).kind, ErrorKind::Conflict);
  EXPECT_EQ(whole_file(worker), before);
  // Nor one of them, and then none of the others is made.
  std::filesystem::remove(folder.server_key());
  EXPECT_FALSE(make_key_folder(folder));
  EXPECT_FALSE(std::filesystem::exists(folder.server_key()));
}

TEST_F(Keys, OfFurtherClientsAreAdded) {
  const auto file = value_of(add_client(
      folder,
      {.name = "node.7", .role = Role::Worker, .expires = std::chrono::year(2027) / 1 / 31}));
  EXPECT_EQ(mode_of(file), 0600U);
  EXPECT_EQ(mode_of(folder.clients()), 0600U);
  EXPECT_THAT(whole_file(folder.clients()), HasSubstr("expires = 2027-01-31"));
  EXPECT_THAT(whole_file(folder.clients()), HasSubstr("# Who may connect"));
  const auto list = value_of(AllowListFile::open(folder.clients(), {}));
  EXPECT_EQ(list.clients().back().public_key, read_client_key(file)->pair.public_key);
  for (const char* name : {"node.7", "../x", "", "server", ".x"})
    EXPECT_FALSE(add_client(folder, {.name = name, .role = Role::Worker, .expires = {}})) << name;
  EXPECT_EQ(AllowListFile::open(folder.clients(), {})->clients().size(), 4U);
}

/// A client's file is copied to its host and taken away; its name stays in the list.
TEST_F(Keys, OfAClientAreNotMadeAgainWhenItsFileWasMoved) {
  const auto file =
      value_of(add_client(folder, {.name = "node.7", .role = Role::Worker, .expires = {}}));
  std::filesystem::remove(file);
  const std::string list = whole_file(folder.clients());
  const Error again =
      why_not(add_client(folder, {.name = "node.7", .role = Role::Worker, .expires = {}}));
  EXPECT_EQ(again.kind, ErrorKind::Conflict);
  EXPECT_THAT(again.message, HasSubstr("choose another name"));
  EXPECT_EQ(whole_file(folder.clients()), list);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(Keys, ThatOthersMayReadAreRefused) {
  for (const mode_t mode : {0640U, 0604U, 0660U, 0610U}) {
    chmod(worker.c_str(), mode);
    EXPECT_THAT(refusal(worker), HasSubstr("chmod 600 " + worker.string())) << mode;
  }
  chmod(worker.c_str(), 0400);
  EXPECT_EQ(refusal(worker), "");
}

TEST_F(Keys, OfAnotherUserAreRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  ASSERT_EQ(chown(worker.c_str(), 12345, static_cast<gid_t>(-1)), 0);
  EXPECT_THAT(refusal(worker), HasSubstr("chown 0 " + worker.string()));
}

TEST_F(Keys, ThatAreDamagedAreRefusedWithoutShowingThem) {
  const ClientKeyFile key = read_client_key(worker).value();
  const std::string good = whole_file(worker);
  const std::string& secret = key.pair.secret_key;
  const auto damaged = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    text.replace(text.find(what), what.size(), by);
    std::ofstream(worker) << text;
    const std::string said = refusal(worker);
    EXPECT_THAT(said, HasSubstr(worker.string() + ":")) << by;
    EXPECT_THAT(said, Not(HasSubstr(secret))) << by;
    EXPECT_THAT(said, Not(HasSubstr(secret.substr(5, 20)))) << by;
    return said;
  };
  damaged("\"" + secret + "\"", secret);
  damaged("secret = \"" + secret + "\"", secret);
  damaged("secret = \"", "secret = \"x");
  damaged("secret", "Secret");
  damaged("role = \"worker\"", "role = 3");
  damaged("role = \"worker\"", "role = \"worker\"\n\"" + secret + "\" = 1");
  damaged(secret, make_key_pair().secret_key);
  std::ofstream(worker) << good.substr(0, good.size() / 2);
  EXPECT_NE(refusal(worker), "");
}

TEST_F(Keys, OfServerAndClientsAreToldApart) {
  EXPECT_THAT(refusal(folder.server_key()), HasSubstr("the coordinator's key"));
  EXPECT_THAT(complaint_of(read_server_key(worker)), HasSubstr("a client's key"));
}

TEST_F(Keys, ThatAreMissingAreNamed) {
  EXPECT_THAT(refusal(folder.client_key("absent")), HasSubstr("absent.key"));
  EXPECT_THAT(complaint_of(add_client({temporary / "other"},
                                      {.name = "a", .role = Role::Worker, .expires = {}})),
              HasSubstr("swarmsmith keygen"));
}

/// Each add reads the list, and replaces it.
TEST_F(Keys, OfClientsAreAllInTheListWhenTheyAreAddedAtOnce) {
  std::vector<std::thread> threads;
  std::latch all(4);
  for (const std::string name : {"a", "b", "c", "d"}) {
    threads.emplace_back([&, name] {
      all.arrive_and_wait();
      for (int i = 0; i < 50; ++i) {
        EXPECT_TRUE(add_client(
            folder,
            {.name = name + std::to_string(i), .role = Role::Worker, .expires = std::nullopt}));
      }
    });
  }
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(AllowListFile::open(folder.clients(), {})->clients().size(), 203U);
}

/// `keygen` was killed between the key and the list, or a person removed the entry.
TEST_F(Keys, ThatAreNotInTheListAreNamedWhenTheirNameIsAddedAgain) {
  std::ofstream(folder.client_key("node")) << "left over";
  const Error error =
      why_not(add_client(folder, {.name = "node", .role = Role::Worker, .expires = {}}));
  EXPECT_EQ(error.kind, ErrorKind::Conflict);
  EXPECT_THAT(error.message, HasSubstr("is not in clients.toml"));
  EXPECT_THAT(error.message, HasSubstr("delete"));
  EXPECT_EQ(whole_file(folder.client_key("node")), "left over");
}

TEST(KeyFolders, AreForTheirOwnerOnlyHoweverTheirNameIsWritten) {
  const TemporaryFolder temporary;
  const mode_t before = umask(0002);
  for (const char* name : {"one/", "two/.", "three//", "four/./", "in/five/"}) {
    const KeyFolder folder{temporary / name};
    EXPECT_TRUE(make_key_folder(folder)) << name;
    EXPECT_EQ(mode_of(folder.path), 0700U) << name;
  }
  umask(before);
}

TEST(KeyFolders, AreEmptyAgainWhenAFileCannotBeWritten) {
  const TemporaryFolder temporary;
  const KeyFolder folder{temporary / "keys"};
  struct rlimit usual = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  // The list is the largest of the files, and the last one.
  const struct rlimit few = {.rlim_cur = 600, .rlim_max = usual.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &few), 0);
  const auto made = make_key_folder(folder);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, SIG_DFL);
  ASSERT_FALSE(made);
  EXPECT_THAT(to_string(made.error()), HasSubstr("clients.toml"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
  EXPECT_TRUE(make_key_folder(folder));
}

TEST(KeyFolders, AreWhereTheEnvironmentSays) {
  unsetenv("SWARMSMITH_KEYS");
  setenv("HOME", "/home/mine", 1);
  unsetenv("XDG_CONFIG_HOME");
  EXPECT_EQ(default_key_folder().path, "/home/mine/.config/swarmsmith/keys");
  setenv("XDG_CONFIG_HOME", "/config", 1);
  EXPECT_EQ(default_key_folder().path, "/config/swarmsmith/keys");
  setenv("XDG_CONFIG_HOME", "not-absolute", 1);
  EXPECT_EQ(default_key_folder().path, "/home/mine/.config/swarmsmith/keys");
  setenv("SWARMSMITH_KEYS", "/keys", 1);
  EXPECT_EQ(default_key_folder().path, "/keys");
}

}  // namespace
}  // namespace swarmsmith
