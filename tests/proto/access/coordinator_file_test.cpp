#include "proto/access/coordinator_file.h"

#include <sys/stat.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "proto/access/allow_list.h"
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

TEST(CoordinatorFiles, ArePrintedForPeopleToo) {
  CoordinatorFile file = example();
  const std::string head =
      "# Address of the coordinator of the campaign beside this file, while it runs:\n"
      "# swarmsmith worker --coordinator THIS_FILE\nformat = 1\nendpoint = \"tcp://login1:5555\"\n";
  const std::string tail = "pid = 4711\nhost = \"login1\"\nstarted = \"2026-11-21T15:37:00Z\"\n";
  EXPECT_EQ(text_of(file), head + "key = \"" + file.public_key + "\"\n" + tail +
                               "http = \"http://127.0.0.1:9347\"\n");
  file.public_key.clear();
  file.http.clear();
  file.insecure_plaintext = true;
  file.others = {"tcp://10.0.0.1:5555", "tcp://[fd00::1]:5555"};
  EXPECT_EQ(text_of(file), head + "others = [\"tcp://10.0.0.1:5555\", \"tcp://[fd00::1]:5555\"]\n" +
                               "insecure_plaintext = true\n" + tail);
}

TEST(CoordinatorFiles, NeedTheirEndpointOnly) {
  const std::string least = "format = 1\nendpoint = \"tcp://a:1\"\n";
  CoordinatorFile file;
  file.endpoint = "tcp://a:1";
  EXPECT_EQ(parse_coordinator_file(least, "f").value(), file);
  EXPECT_EQ(parse_coordinator_file(least + "pid = 0\n", "f").value(), file);
  EXPECT_THAT(complaint_about(least + "pid = -1\n"), HasSubstr("c.db.coordinator:3:7: `pid`"));
  EXPECT_THAT(complaint_about("endpoint = \"tcp://a:1\"\n"),
              HasSubstr("must begin with its format"));
  for (const char* wrong : {"key = 1", "others = 1", "insecure_plaintext = 1", "pid = \"1\"",
                            "host = 1", "started = 1", "http = 1"})
    EXPECT_THAT(complaint_about(least + wrong + "\n"), StartsWith("c.db.coordinator:3:")) << wrong;
}

TEST(CoordinatorFiles, SayWhenTheyWereWritten) {
  const std::string text = wall_clock_text();
  ASSERT_EQ(text.size(), std::string("2026-11-21T15:37:00Z").size());
  const auto day = value_of(date_of(text.substr(0, 10)));
  ASSERT_EQ(text[10], 'T');
  const auto time = std::chrono::sys_days(day) + std::chrono::hours(std::stoi(text.substr(11, 2))) +
                    std::chrono::minutes(std::stoi(text.substr(14, 2))) +
                    std::chrono::seconds(std::stoi(text.substr(17, 2)));
  EXPECT_LT(std::chrono::abs(std::chrono::system_clock::now() - time), std::chrono::minutes(1));
}

TEST(CoordinatorFiles, SayWhatIsWrongAndWhere) {
  EXPECT_THAT(complaint_about("endpoint"), HasSubstr("c.db.coordinator:1:"));
  EXPECT_EQ(complaint_about("format = 1\n"), "c.db.coordinator:1:1: the file needs an `endpoint`");
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"tcp://a:*\"\n"),
              HasSubstr("address to connect to"));
  EXPECT_EQ(complaint_about("format = 1\nendpoint = \"\"\n"),
            "c.db.coordinator:2:12: `endpoint` must be the address to connect to: "
            "\"tcp://HOST:PORT\"");
  EXPECT_THAT(complaint_about("format = 1\nendpoint = 5\n"), HasSubstr("c.db.coordinator:2:12:"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"login1:5555\"\n"),
              HasSubstr("c.db.coordinator:2:12: `endpoint` must be the address to connect to"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"tcp://0.0.0.0:5555\"\n"),
              HasSubstr("address to connect to"));
  EXPECT_THAT(complaint_about("format = 1\nendpoint = \"tcp://a:1\"\nkey = \"x\"\n"),
              HasSubstr("c.db.coordinator:3:7: `key` must be a public key of 40 characters"));
  EXPECT_THAT(
      complaint_about("format = 1\nendpoint = \"tcp://a:1\"\nothers = [\"10.0.0.1\"]\n"),
      HasSubstr("c.db.coordinator:3:10: `others` must be at most 64 addresses to connect to"));
  EXPECT_THAT(complaint_about("format = 2\nendpoint = \"tcp://a:1\"\n"), HasSubstr("newer"));
}

/// Of a host with many addresses: the file has as many of them as its readers take.
TEST(CoordinatorFiles, OfHostsWithManyAddressesCanBeRead) {
  CoordinatorFile file = example();
  for (int i = 1; i <= 100; ++i)
    file.others.push_back("tcp://10.0.0." + std::to_string(i) + ":5555");
  const auto read = value_of(parse_coordinator_file(text_of(file), "f"));
  EXPECT_EQ(read.others, std::vector<std::string>(file.others.begin(), file.others.begin() + 64));
  // One more in a file by hand.
  std::string text = text_of(file);
  const std::string last = "\"tcp://10.0.0.64:5555\"";
  text.replace(text.find(last), last.size(), last + ", " + last);
  EXPECT_THAT(complaint_about(text), HasSubstr("`others` must be at most 64 addresses"));
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
  // Numbers of processes repeat: on another host, and after a restart.
  CoordinatorFile elsewhere = second;
  elsewhere.host = "login2";
  CoordinatorFile later = second;
  later.started = "2026-11-21T15:37:01Z";
  for (const CoordinatorFile& other : {elsewhere, later}) {
    remove_coordinator_file(path, other);
    EXPECT_EQ(read_coordinator_file(path).value(), second);
  }
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
  EXPECT_EQ(why_not(read_coordinator_file(folder / "absent")),
            (Error{ErrorKind::NotFound, "there is no such coordinator file",
                   (folder / "absent").string()}));
}

TEST(CoordinatorFiles, ThatCannotBeWrittenSayWhy) {
  EXPECT_EQ(why_not(write_coordinator_file("/no-such-folder/f", example())),
            (Error{ErrorKind::Unavailable, "cannot be written: No such file or directory",
                   "/no-such-folder/f"}));
  // A folder has the name.
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "f");
  EXPECT_EQ(why_not(write_coordinator_file(folder / "f", example())),
            (Error{ErrorKind::Unavailable, "cannot be written: Is a directory",
                   (folder / "f").string()}));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "nothing of the writing is left behind";
}

}  // namespace
}  // namespace swarmsmith
