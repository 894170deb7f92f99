#include "proto/access/allow_list.h"

#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "proto/access/allow_list_file.h"
#include "proto/access/allow_list_watch.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

constexpr std::chrono::sys_seconds kNoon =
    std::chrono::sys_days(std::chrono::year(2027) / 1 / 31) + std::chrono::hours(12);

const KeyPair kNode = make_key_pair();
const KeyPair kDesk = make_key_pair();

AllowedClient node() {
  return {.name = "node",
          .role = Role::Worker,
          .public_key = kNode.public_key,
          .expires = std::chrono::year(2027) / 1 / 31};
}
AllowedClient desk() {
  return {.name = "desk", .role = Role::Operator, .public_key = kDesk.public_key, .expires = {}};
}

std::string list_of_both() {
  return "format = 1\n" + text_of(node()) + "\n# a comment\n" + text_of(desk());
}

std::vector<std::string> complaints_about(const std::string& text) {
  return complaints_of(parse_allow_list(text, "clients.toml"));
}

TEST(AllowList, ReadsWhatItPrints) {
  const AllowListOrErrors list = parse_allow_list(list_of_both(), "clients.toml");
  ASSERT_TRUE(list);
  EXPECT_THAT(*list, ElementsAre(node(), desk()));
}

TEST(AllowList, MayBeEmpty) {
  EXPECT_THAT(parse_allow_list("format = 1\n", "clients.toml").value(), IsEmpty());
}

TEST(AllowList, IsPrintedAsPeopleWriteIt) {
  EXPECT_EQ(text_of(node()), "[[client]]\nname = \"node\"\nrole = \"worker\"\nkey = \"" +
                                 kNode.public_key + "\"\nexpires = 2027-01-31\n");
  EXPECT_EQ(text_of(desk()), "[[client]]\nname = \"desk\"\nrole = \"operator\"\nkey = \"" +
                                 kDesk.public_key + "\"\n");
}

TEST(AllowList, SaysWhereItIsNoToml) {
  EXPECT_THAT(complaints_about("format = 1\n[[client]\n"),
              ElementsAre(HasSubstr("clients.toml:2:")));
}

TEST(AllowList, SaysEverythingThatIsWrongAndWhere) {
  const std::string text =
      "format = 1\n"
      "[[client]]\n"
      "name = \"a b\"\n"
      "role = \"work\"\n"
      "key = \"short\"\n"
      "expires = \"2027-01-31\"\n"
      "until = 3\n"
      "[[client]]\n"
      "name = \"desk\"\n"
      "rights = \"all\"\n";
  const auto needs = [](const char* key) {
    return std::string("[[client]] needs a `") + key +
           "`; `swarmsmith keygen --client NAME` writes complete entries";
  };
  EXPECT_THAT(
      complaints_about(text),
      ElementsAre("clients.toml:3:8: a client's name must consist of at most 64 letters, digits, "
                  "\".\", \"_\" and \"-\"",
                  HasSubstr("clients.toml:4:8: `role` cannot be \"work\"; it is one of"),
                  "clients.toml:5:7: `key` must be a public key of 40 characters: the value of "
                  "`public` in the client's key file",
                  HasSubstr("clients.toml:6:11: `expires` must be a date such as 2027-01-31"),
                  HasSubstr("clients.toml:7:1: [[client]] has no key `until`"),
                  "clients.toml:8:1: " + needs("role"), "clients.toml:8:1: " + needs("key"),
                  HasSubstr("clients.toml:10:1: [[client]] has no key `rights`")));
  // What is missing is not said to be there twice.
  EXPECT_THAT(
      complaints_about("format = 1\n[[client]]\n[[client]]\n"),
      ElementsAre("clients.toml:2:1: " + needs("name"), "clients.toml:2:1: " + needs("role"),
                  "clients.toml:2:1: " + needs("key"), "clients.toml:3:1: " + needs("name"),
                  "clients.toml:3:1: " + needs("role"), "clients.toml:3:1: " + needs("key")));
}

TEST(AllowList, HasItsFormatAndNothingElse) {
  EXPECT_THAT(complaints_about(""),
              ElementsAre(HasSubstr("the file must begin with its format: format = 1")));
  EXPECT_THAT(complaints_about("format = 1\nclients = 3\n"), ElementsAre(HasSubstr("`clients`")));
}

TEST(AllowList, TakesNamesAndKeysOnce) {
  AllowedClient twin = node();
  EXPECT_THAT(complaints_about("format = 1\n" + text_of(node()) + text_of(twin)),
              ElementsAre("clients.toml:8:8: two clients have the name \"node\"",
                          "clients.toml:10:7: \"node\" has the same key"));
}

TEST(AllowList, KeysAreGoodThroughTheirLastDay) {
  const AllowList list = {node(), desk()};
  const auto expired_at = [&](std::chrono::sys_seconds now) {
    const auto clients = clients_at(list, now);
    EXPECT_EQ(clients[1], (ListedClient{.name = "desk",
                                        .role = Role::Operator,
                                        .public_key = kDesk.public_key,
                                        .expired = false}));
    EXPECT_EQ(clients[0].role, Role::Worker);
    return clients[0].expired;
  };
  EXPECT_FALSE(expired_at(kNoon));
  EXPECT_FALSE(expired_at(kNoon + std::chrono::hours(12) - std::chrono::seconds(1)));
  EXPECT_TRUE(expired_at(kNoon + std::chrono::hours(12)));
}

TEST(Dates, AreReadAsTheyArePrinted) {
  for (const char* date : {"2027-01-31", "2040-12-09", "1998-10-25", "2028-02-29"})
    EXPECT_EQ(text_of(date_of(date).value()), date);
  const auto last = value_of(date_of("2076-11-28"));
  EXPECT_EQ(last, std::chrono::year(2076) / 11 / 28);
  EXPECT_EQ(text_of(std::chrono::year(33) / 4 / 3), "0033-04-03");
  // "/" and ":" are beside the digits.
  for (const char* wrong : {"", "2027-1-31", "2027-02-30", "31-01-2027", "2027-01-3a", "2027-01-3/",
                            "2027-01-2:", "2027/01/31", "2027-01-311", "2027-13-01", "2027-00-01",
                            "2027-01-00", "2027-0131-"})
    EXPECT_FALSE(date_of(wrong)) << wrong;
}

class AllowListOnDisk : public ::testing::Test {
 protected:
  void write(const std::string& text) {
    // In another file first: a new inode, whatever the clock's steps.
    const std::filesystem::path fresh = folder / "fresh.toml";
    std::ofstream(fresh) << text;
    chmod(fresh.c_str(), 0644);
    std::filesystem::rename(fresh, file);
  }

  TemporaryFolder folder;
  const std::filesystem::path file = folder / "clients.toml";
};

TEST_F(AllowListOnDisk, SaysHowAMissingOneIsMade) {
  EXPECT_EQ(why_not(AllowListFile::open(file, kNoon)),
            (Error{ErrorKind::NotFound,
                   "there is no such list of clients; `swarmsmith keygen " +
                       folder.path().string() + "` makes one, with keys",
                   file.string()}));
}

TEST_F(AllowListOnDisk, IsRefusedWhenOthersMayWriteIt) {
  write(list_of_both());
  chmod(file.c_str(), 0664);
  EXPECT_EQ(why_not(AllowListFile::open(file, kNoon)),
            (Error{ErrorKind::BadInput,
                   "other users can change this file; forbid it: chmod go-w " + file.string(),
                   file.string()}));
}

TEST_F(AllowListOnDisk, IsReadAgainWhenItChanges) {
  write(list_of_both());
  auto opened = value_of(AllowListFile::open(file, kNoon));
  EXPECT_EQ(opened.clients().size(), 2U);
  EXPECT_FALSE(opened.look(kNoon).changed);
  write("format = 1\n" + text_of(node()));
  EXPECT_TRUE(opened.look(kNoon).changed);
  EXPECT_EQ(opened.clients().size(), 1U);
  EXPECT_FALSE(opened.look(kNoon).changed);
}

TEST_F(AllowListOnDisk, StaysAsItWasWhenANewOneIsFaulty) {
  write(list_of_both());
  auto opened = value_of(AllowListFile::open(file, kNoon));
  write("format = 1\n[[client]]\nname = 3\n");
  AllowListFile::Look look = opened.look(kNoon);
  EXPECT_FALSE(look.changed);
  EXPECT_FALSE(look.faults.empty());
  EXPECT_EQ(opened.clients().size(), 2U);
  // Said once, unless it is asked for.
  EXPECT_THAT(opened.look(kNoon).faults, IsEmpty());
  EXPECT_EQ(opened.look(kNoon, true).faults, look.faults);
  EXPECT_EQ(opened.clients().size(), 2U);
  std::filesystem::remove(file);
  look = opened.look(kNoon);
  EXPECT_THAT(lines_of(look.faults), ElementsAre(HasSubstr("there is no such list of clients")));
  EXPECT_THAT(opened.look(kNoon).faults, IsEmpty());
  EXPECT_EQ(opened.clients().size(), 2U);
  write("format = 1\n");
  EXPECT_TRUE(opened.look(kNoon).changed);
  EXPECT_THAT(opened.clients(), IsEmpty());
}

/// The inode and the size stay.
TEST_F(AllowListOnDisk, IsReadAgainWhenOnlyItsTimeChanges) {
  write("format = 1\n" + text_of(node()));
  auto time = std::filesystem::last_write_time(file);
  auto opened = value_of(AllowListFile::open(file, kNoon));
  AllowedClient client = node();
  for (const auto step : {std::chrono::milliseconds(1), std::chrono::milliseconds(1000)}) {
    for (const char* name : {"edge", "node"}) {
      client.name = name;
      std::ofstream(file) << "format = 1\n" + text_of(client);
      time += step;
      std::filesystem::last_write_time(file, time);
      EXPECT_TRUE(opened.look(kNoon).changed) << step.count();
      EXPECT_EQ(opened.clients().front().name, name);
    }
  }
}

/// Only when it is asked, or the pause is over.
TEST_F(AllowListOnDisk, IsLookedAtWhenItIsAskedFor) {
  write(list_of_both());
  std::atomic<int> looks = 0;
  std::atomic<int> day = 0;
  AllowListWatch watch(
      AllowListFile::open(file, kNoon).value(), [](const std::vector<Error>&) {},
      [&] {
        ++looks;
        return kNoon + std::chrono::days(day);
      },
      std::chrono::hours(1));
  std::optional<std::vector<ListedClient>> taken;
  const auto take = [&] { return taken || (taken = watch.take()); };
  for (const int today : {1, 0}) {
    day = today;
    watch.look_now();
    ASSERT_TRUE(eventually(take));
    EXPECT_EQ(taken->front().expired, today == 1);
    taken.reset();
    EXPECT_FALSE(watch.take()) << "once";
  }
  EXPECT_EQ(looks, 2);
}

TEST_F(AllowListOnDisk, ChangesWhenADayIsOver) {
  write(list_of_both());
  auto opened = value_of(AllowListFile::open(file, kNoon));
  EXPECT_TRUE(opened.look(kNoon + std::chrono::hours(12)).changed);
  EXPECT_TRUE(opened.clients().front().expired);
}

TEST_F(AllowListOnDisk, IsWatched) {
  write(list_of_both());
  std::atomic<int> faults = 0;
  std::atomic<bool> next_day = false;
  AllowListWatch watch(
      AllowListFile::open(file, kNoon).value(), [&](const std::vector<Error>&) { ++faults; },
      [&] { return next_day ? kNoon + std::chrono::days(1) : kNoon; },
      std::chrono::milliseconds(1));
  std::optional<std::vector<ListedClient>> taken;
  const auto take = [&] { return taken || (taken = watch.take()); };
  next_day = true;
  ASSERT_TRUE(eventually(take));
  EXPECT_TRUE(taken->front().expired);
  write("no list\n");
  EXPECT_TRUE(eventually([&] { return faults > 0; }));
  taken.reset();
  write("format = 1\n" + text_of(desk()));
  watch.look_now();
  ASSERT_TRUE(eventually(take));
  EXPECT_EQ(taken->size(), 1U);
  EXPECT_EQ(taken->front().name, "desk");
}

}  // namespace
}  // namespace swarmsmith
