#include "proto/access/coordinator_file.h"

#include <sys/stat.h>
#include <fstream>
#include <string>

#include "proto/curve.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

CoordinatorFile example() {
  return {.endpoint = "tcp://login1:5555",
          .public_key = make_key_pair().public_key,
          .insecure_plaintext = false,
          .pid = 4711,
          .host = "login1",
          .started = "2026-11-21T15:37:00Z",
          .http = "http://127.0.0.1:9347"};
}

std::string complaint_about(const std::string& text) {
  const auto parsed = parse_coordinator_file(text, "c.db.coordinator");
  return parsed ? "" : to_string(parsed.error());
}

TEST(CoordinatorFiles, ReadBackAsTheyArePrinted) {
  CoordinatorFile file = example();
  EXPECT_EQ(parse_coordinator_file(text_of(file), "f").value(), file);
  file.public_key.clear();
  file.insecure_plaintext = true;
  file.http.clear();
  file.others = {"tcp://10.0.0.1:5555", "tcp://[fd00::1]:5555"};
  EXPECT_EQ(parse_coordinator_file(text_of(file), "f").value(), file);
}

TEST(CoordinatorFiles, SayWhatIsWrongAndWhere) {
  EXPECT_THAT(complaint_about("endpoint"), HasSubstr("c.db.coordinator:1:"));
  EXPECT_THAT(complaint_about("format = 1\n"), HasSubstr("needs an `endpoint`"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"\"\n"),
              HasSubstr("c.db.coordinator:2:12: `endpoint` must be the address to connect to"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = 5\n"), HasSubstr("c.db.coordinator:2:12:"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"login1:5555\"\n"),
              HasSubstr("c.db.coordinator:2:12: `endpoint` must be the address to connect to"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"tcp://0.0.0.0:5555\"\n"),
              HasSubstr("address to connect to"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"tcp://a:1\"\nkey = \"x\"\n"),
              HasSubstr("c.db.coordinator:3:7: `key` must be a public key"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"tcp://a:1\"\nothers = [\"10.0.0.1\"]\n"),
              HasSubstr("c.db.coordinator:3:10: `others` must be"));
  EXPECT_THAT(complaint_about("format = 2\nendpoint = \"tcp://a:1\"\n"), HasSubstr("newer"));
}

/// Of a host with many addresses: the file has as many of them as its readers take.
TEST(CoordinatorFiles, OfHostsWithManyAddressesCanBeRead) {
  CoordinatorFile file = example();
  for (int i = 1; i <= 100; ++i)
    file.others.push_back("tcp://10.0.0." + std::to_string(i) + ":5555");
  const auto read = value_of(parse_coordinator_file(text_of(file), "f"));
  ASSERT_EQ(read.others.size(), 64U);
  EXPECT_EQ(read.others.front(), "tcp://10.0.0.1:5555");
}

TEST(CoordinatorFiles, MayHaveKeysOfNewerVersions) {
  EXPECT_EQ(complaint_about(text_of(example()) + "colour = \"blue\"\n"), "");
}

TEST(CoordinatorFiles, AreRemovedByWhoWroteThem) {
  const TemporaryFolder folder;
  const std::filesystem::path path = coordinator_file_of(folder / "c.db");
  EXPECT_EQ(path.filename(), "c.db.coordinator");
  const CoordinatorFile first = example();
  CoordinatorFile second = example();
  second.pid = 4712;
  ASSERT_TRUE(write_coordinator_file(path, first));
  ASSERT_TRUE(write_coordinator_file(path, second));
  remove_coordinator_file(path, first);
  EXPECT_EQ(read_coordinator_file(path).value(), second);
  remove_coordinator_file(path, second);
  EXPECT_FALSE(std::filesystem::exists(path));
  // Nothing of the writing is left behind.
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// On loopback without keys only the coordinator's own user comes in.
TEST(CoordinatorFiles, AreForThoseWhoMayConnect) {
  const TemporaryFolder folder;
  const auto mode = [&](const std::string& endpoint, const std::string& key) {
    CoordinatorFile file = example();
    file.endpoint = endpoint;
    file.public_key = key;
    EXPECT_TRUE(write_coordinator_file(folder / "f", file));
    struct stat status = {};
    EXPECT_EQ(stat((folder / "f").c_str(), &status), 0);
    return status.st_mode & 0777U;
  };
  EXPECT_EQ(mode("tcp://127.0.0.1:1", ""), 0600U);
  EXPECT_EQ(mode("tcp://127.0.0.1:1", example().public_key), 0644U);
  EXPECT_EQ(mode("tcp://login1:1", ""), 0644U);
}

TEST(CoordinatorFiles, AreRefusedWhenOthersMayWriteThem) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "f";
  ASSERT_TRUE(write_coordinator_file(path, example()));
  chmod(path.c_str(), 0666);
  EXPECT_THAT(complaint_of(read_coordinator_file(path)), HasSubstr("chmod go-w"));
}

TEST(CoordinatorFiles, ThatCannotBeWrittenSayWhy) {
  EXPECT_EQ(why_not(write_coordinator_file("/no-such-folder/f", example())).where,
            "/no-such-folder/f");
}

}  // namespace
}  // namespace swarmsmith
