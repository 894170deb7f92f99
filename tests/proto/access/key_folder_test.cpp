#include "proto/access/key_folder.h"

#include <pwd.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <latch>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "proto/access/allow_list_file.h"
#include "proto/access/key_file.h"
#include "proto/access/role_text.h"
#include "proto/access/secret_file.h"
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
  EXPECT_EQ(why_not(make_key_folder(folder)),
            (Error{ErrorKind::Conflict,
                   "already exists, and keys are never overwritten; name another folder, or add a "
                   "client to this one with --client NAME",
                   folder.server_key().string()}));
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
  EXPECT_EQ(file, folder.client_key("node.7"));
  EXPECT_EQ(list.clients().back().name, "node.7");
  for (const char* name : {"node.7", "../x", "", "server", ".x"})
    EXPECT_FALSE(add_client(folder, {.name = name, .role = Role::Worker, .expires = {}})) << name;
  EXPECT_EQ(why_not(add_client(folder, {.name = "a b", .role = Role::Worker, .expires = {}})),
            (Error{ErrorKind::BadInput,
                   "a client's name must consist of at most 64 letters, digits, \".\", \"_\" and "
                   "\"-\"",
                   "a b"}));
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
  EXPECT_EQ(again,
            (Error{ErrorKind::Conflict, "a client \"node.7\" already exists; choose another name",
                   folder.clients().string()}));
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
  EXPECT_EQ(refusal(folder.server_key()),
            folder.server_key().string() +
                ": this is the coordinator's key, which stays with it; clients use others, such as "
                "worker.key");
  EXPECT_EQ(complaint_of(read_server_key(worker)),
            worker.string() + ": this is a client's key, not a coordinator's (server.key)");
}

TEST_F(Keys, ArePrintedWithAWarning) {
  const std::string warning =
      "# Secret: anyone who reads this file can connect with it. Mode 0600; copy it with scp or on "
      "a\n# file system that others cannot read, never by mail or into a repository.\nformat = 1\n";
  const ClientKeyFile key = read_client_key(folder.client_key("operator")).value();
  const KeyPair server = read_server_key(folder.server_key()).value();
  EXPECT_EQ(key.keys().server_key, server.public_key);
  EXPECT_EQ(whole_file(folder.client_key("operator")),
            "# Key of the client \"operator\" of a Swarmsmith coordinator.\n" + warning +
                "name = \"operator\"\nrole = \"operator\"\npublic = \"" + key.pair.public_key +
                "\"\nsecret = \"" + key.pair.secret_key +
                "\"\n# The coordinator's public key; the client talks to no other coordinator.\n"
                "server = \"" +
                server.public_key + "\"\n");
  EXPECT_EQ(whole_file(folder.server_key()),
            "# Key of a Swarmsmith coordinator.\n" + warning + "role = \"server\"\npublic = \"" +
                server.public_key + "\"\nsecret = \"" + server.secret_key + "\"\n");
}

/// A line is left out, has a number, or another text.
TEST_F(Keys, ThatAreNotWholeAreRefused) {
  const std::string good = whole_file(worker);
  const auto complaint = [&](const std::string& name, const std::string& line) {
    std::string text = good;
    const std::size_t begin = text.find("\n" + name + " = ") + 1;
    text.replace(begin, text.find('\n', begin) + 1 - begin, line);
    const auto parsed = parse_client_key(text, "f");
    return parsed ? "" : to_string(parsed.error());
  };
  EXPECT_THAT(complaint("format", ""), HasSubstr("the file must begin with its format"));
  EXPECT_EQ(complaint("role", ""), "f:1:1: the file needs a `role`");
  EXPECT_EQ(complaint("name", ""), "f:1:1: the file needs a `name`");
  for (const std::string name : {"public", "secret", "server"}) {
    EXPECT_EQ(complaint(name, ""), "f:1:1: the file needs a key `" + name + "`");
    EXPECT_THAT(complaint(name, name + " = \"short\"\n"),
                HasSubstr("`" + name + "` is not a key of 40 characters in Z85"));
    EXPECT_THAT(complaint(name, name + " = 1\n"), StartsWith("f:")) << name;
  }
  EXPECT_THAT(complaint("role", "role = \"anyone\"\n"), HasSubstr("`role` cannot be"));
  EXPECT_THAT(complaint("format", "format = 1\nmore = 1\n"),
              HasSubstr("a key file has no such key"));
  EXPECT_THAT(complaint("public", "public = \"" + make_key_pair().public_key + "\"\n"),
              HasSubstr("`public` does not belong to `secret`; is the file damaged?"));
  EXPECT_EQ(why_not(parse_client_key("no toml", "f")).message,
            "this is not a key file of `swarmsmith keygen`");
}

TEST_F(Keys, ThatAreMissingAreNamed) {
  EXPECT_EQ(refusal(folder.client_key("absent")),
            folder.client_key("absent").string() + ": there is no such key file");
  const KeyFolder other{temporary / "other"};
  EXPECT_EQ(why_not(add_client(other, {.name = "a", .role = Role::Worker, .expires = {}})),
            (Error{ErrorKind::NotFound,
                   "there is no such key file; `swarmsmith keygen " + other.path.string() +
                       "` makes a folder of keys",
                   other.server_key().string()}));
}

/// A person may have written the list, too.
TEST_F(Keys, OfFurtherClientsNeedAGoodList) {
  const NewClient edge{.name = "edge", .role = Role::Reader, .expires = {}};
  const std::string before = whole_file(folder.clients());
  std::ofstream(folder.clients()) << before << "x = 1\n";
  EXPECT_THAT(complaint_of(add_client(folder, edge)), HasSubstr("`x`"));
  std::filesystem::remove(folder.clients());
  EXPECT_THAT(complaint_of(add_client(folder, edge)), HasSubstr("no such list of clients"));
  EXPECT_FALSE(std::filesystem::exists(folder.client_key("edge")));
  // Without the end of its last line.
  std::ofstream(folder.clients()) << before.substr(0, before.size() - 1);
  std::filesystem::permissions(folder.clients(), std::filesystem::perms(0600));
  const auto key = value_of(read_client_key(value_of(add_client(folder, edge))));
  EXPECT_EQ(whole_file(folder.clients()),
            before + "\n[[client]]\nname = \"edge\"\nrole = \"reader\"\nkey = \"" +
                key.pair.public_key + "\"\n");
}

TEST_F(Keys, OfAClientAreRemovedWhenTheListCannotBeReplaced) {
  const std::string before = whole_file(folder.clients());
  struct rlimit usual = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  // The key's file is shorter than this, the list is longer.
  const struct rlimit few = {.rlim_cur = 600, .rlim_max = usual.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &few), 0);
  const auto added = add_client(folder, {.name = "edge", .role = Role::Worker, .expires = {}});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &usual), 0);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(why_not(added), (Error{ErrorKind::Unavailable, "cannot be written: File too large",
                                   folder.clients().string()}));
  EXPECT_EQ(whole_file(folder.clients()), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 5)
      << "the server's key, three clients' and the list";
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
  EXPECT_EQ(error, (Error{ErrorKind::Conflict,
                          "already exists, and keys are never overwritten; this one is not in "
                          "clients.toml: delete it, or choose another name for the client",
                          folder.client_key("node").string()}));
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

TEST(KeyFolders, AreNotMadeWhereTheyWouldNotBeSafe) {
  const TemporaryFolder temporary;
  const std::filesystem::path path = temporary / "keys";
  std::ofstream(path) << "a file";
  EXPECT_EQ(why_not(make_key_folder({path})),
            (Error{ErrorKind::BadInput, "this is not a folder", path.string()}));
  const std::filesystem::path inside = path / "in";
  const auto cannot = [&](const std::string& end) {
    return Error{ErrorKind::Unavailable,
                 "the folder cannot be made: Not a directory; name another one: swarmsmith keygen "
                 "DIR" +
                     end,
                 inside.string()};
  };
  setenv("HOME", "/home/mine", 1);
  EXPECT_EQ(why_not(make_key_folder({inside})), cannot(""));
  unsetenv("HOME");
  EXPECT_EQ(why_not(make_key_folder({inside})), cannot(" (HOME is not set)"));
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  for (const unsigned mode : {0770U, 0720U, 0702U}) {
    chmod(path.c_str(), mode);
    EXPECT_EQ(
        why_not(make_key_folder({path})),
        (Error{ErrorKind::BadInput,
               "other users can write into this folder; forbid it: chmod 700 " + path.string(),
               path.string()}))
        << mode;
  }
  chmod(path.c_str(), 0755);
  EXPECT_TRUE(make_key_folder({path}));
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
  // Without HOME the system knows the user's folder.
  unsetenv("SWARMSMITH_KEYS");
  unsetenv("XDG_CONFIG_HOME");
  unsetenv("HOME");
  const struct passwd* user = getpwuid(geteuid());
  ASSERT_NE(user, nullptr);
  EXPECT_EQ(default_key_folder().path,
            std::filesystem::path(user->pw_dir) / ".config/swarmsmith/keys");
}

TEST(Roles, HaveNames) {
  for (const Role role : {Role::Worker, Role::Operator, Role::Reader})
    EXPECT_EQ(role_of(name_of(role)), role);
  EXPECT_EQ(name_of(Role::Worker), "worker");
  EXPECT_EQ(name_of(Role::Operator), "operator");
  EXPECT_EQ(name_of(Role::Reader), "reader");
  EXPECT_EQ(name_of(Role::Anyone), "anyone");
  EXPECT_EQ(role_of("anyone"), std::nullopt);
}

/// They are names of files, too. Signs beside the letters and digits are refused.
TEST(Roles, OfClientsHaveNamesOfFiles) {
  for (const std::string& name :
       {std::string("a"), std::string("09azAZ._-"), std::string("servers"), std::string(64, 'x')})
    EXPECT_TRUE(is_client_name(name)) << name;
  for (const std::string& name : {std::string(), std::string("server"), std::string("clients"),
                                  std::string(".a"), std::string("-a"), std::string(65, 'x')})
    EXPECT_FALSE(is_client_name(name)) << name;
  for (const char sign : std::string("/:@[`{ +\n"))
    EXPECT_FALSE(is_client_name(std::string("a") + sign)) << sign;
}

class PrivateFiles : public ::testing::Test {
 protected:
  void make(const std::string& text, unsigned mode) {
    std::ofstream(file) << text;
    chmod(file.c_str(), mode);
  }
  Error objection(Privacy privacy) const {
    return why_not(read_private_file(file, "thing", privacy));
  }
  Error bad(const std::string& message) const {
    return {ErrorKind::BadInput, message, file.string()};
  }

  TemporaryFolder folder;
  const std::filesystem::path file = folder / "f";
};

TEST_F(PrivateFiles, AreReadUpToOneMegabyte) {
  constexpr std::size_t kMost = 1U << 20U;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kMost}) {
    make(std::string(size, 'x'), 0600);
    EXPECT_TRUE(read_private_file(file, "thing", Privacy::Secret).value() == std::string(size, 'x'))
        << size;
  }
  make(std::string(kMost + 1, 'x'), 0600);
  EXPECT_EQ(objection(Privacy::Secret), bad("the file is larger than 1 MB"));
}

TEST_F(PrivateFiles, AreFilesOfThisUserOnly) {
  EXPECT_EQ(objection(Privacy::Secret),
            (Error{ErrorKind::NotFound, "there is no such thing", file.string()}));
  std::filesystem::create_directory(file);
  EXPECT_EQ(objection(Privacy::Integral), bad("this is not a file"));
  std::filesystem::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(objection(Privacy::Secret), bad("this is not a file"));
  std::filesystem::remove(file);
  make("text", 0644);
  EXPECT_EQ(objection(Privacy::Secret),
            bad("other users can read this secret; forbid it: chmod 600 " + file.string()));
  EXPECT_EQ(read_private_file(file, "thing", Privacy::Integral).value(), "text");
  for (const unsigned mode : {0620U, 0602U}) {
    chmod(file.c_str(), mode);
    EXPECT_EQ(objection(Privacy::Integral),
              bad("other users can change this file; forbid it: chmod go-w " + file.string()));
  }
  const std::filesystem::path inside = file / "in";
  EXPECT_EQ(why_not(read_private_file(inside, "thing", Privacy::Secret)).kind, ErrorKind::NotFound);
}

TEST_F(PrivateFiles, OfAnotherUserAreRefusedUnlessItIsRootsList) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  constexpr uid_t kOther = 65534;
  make("text", 0600);
  ASSERT_EQ(chown(file.c_str(), kOther, static_cast<gid_t>(-1)), 0);
  EXPECT_EQ(objection(Privacy::Secret),
            bad("the file belongs to another user (id 65534); change its owner: chown 0 " +
                file.string()));
  EXPECT_EQ(objection(Privacy::Integral),
            bad("the file belongs to another user (id 65534), who could let anyone connect; change "
                "its owner: chown 0 " +
                file.string()));
  chmod(folder.path().c_str(), 0755);
  ASSERT_EQ(chown(file.c_str(), 0, static_cast<gid_t>(-1)), 0);
  chmod(file.c_str(), 0644);
  ASSERT_EQ(seteuid(kOther), 0);
  const auto list = read_private_file(file, "thing", Privacy::Integral);
  const auto secret = read_private_file(file, "thing", Privacy::Secret);
  ASSERT_EQ(seteuid(0), 0);
  chmod(file.c_str(), 0600);
  ASSERT_EQ(seteuid(kOther), 0);
  const auto hidden = read_private_file(file, "thing", Privacy::Integral);
  ASSERT_EQ(seteuid(0), 0);
  EXPECT_EQ(list.value(), "text");
  EXPECT_EQ(why_not(secret), bad("the file belongs to another user (id 0); change its owner: chown "
                                 "65534 " +
                                 file.string()));
  EXPECT_EQ(why_not(hidden), bad("the thing cannot be read: Permission denied"));
}

TEST_F(PrivateFiles, AreMadeNewOrReplacedWhole) {
  EXPECT_TRUE(write_new_file(file, "one"));
  EXPECT_EQ(mode_of(file), 0600U);
  EXPECT_EQ(why_not(write_new_file(file, "two")),
            (Error{ErrorKind::Conflict, "already exists, and keys are never overwritten",
                   file.string()}));
  EXPECT_EQ(whole_file(file), "one");
  EXPECT_TRUE(replace_file(file, "two", 0640));
  EXPECT_EQ(mode_of(file), 0640U);
  EXPECT_EQ(whole_file(file), "two");
  const std::filesystem::path nowhere = folder / "no" / "f";
  EXPECT_EQ(why_not(write_new_file(nowhere, "")),
            (Error{ErrorKind::Unavailable, "cannot be made: No such file or directory",
                   nowhere.string()}));
  EXPECT_EQ(why_not(replace_file(nowhere, "", 0600)),
            (Error{ErrorKind::Unavailable, "cannot be written: No such file or directory",
                   nowhere.string()}));
}

}  // namespace
}  // namespace swarmsmith
