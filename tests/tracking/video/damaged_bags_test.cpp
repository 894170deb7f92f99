#include <sys/wait.h>

#include <filesystem>
#include <functional>

#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/support/long_runs.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"
#include "tests/tracking/video/read_apart.h"
#include "tests/tracking/video/written_rosbag2.h"

/// Recordings of ROS 2 that are damaged, or made to do damage: each is refused, or read up to
/// there, with a sentence that names the file; in bounded memory and time.
namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTopic = "/ceiling/image_raw";
constexpr const char* kImage = "sensor_msgs/msg/Image";

BagImage image_of(int number) {
  BagImage image;
  image.stamp = 1'732'391'823'000'000'000 + number * BagTime{40'000'000};
  image.recorded = image.stamp + 3'000'000;
  image.width = static_cast<std::uint32_t>(kMadeSize.width);
  image.height = static_cast<std::uint32_t>(kMadeSize.height);
  image.step = image.width;
  image.data = numbered_picture(number);
  return image;
}

void expect_sane(const ReadApart& read, const std::string& file) {
  ASSERT_TRUE(WIFEXITED(read.status)) << "ended by signal " << WTERMSIG(read.status);
  EXPECT_LE(WEXITSTATUS(read.status), 2) << read.said;
#ifndef SWARMSMITH_SANITIZED  // sanitizers take several times as much
  EXPECT_LT(read.most_memory_mb, 300) << read.said;
#endif
  if (read.said.empty()) {
    EXPECT_EQ(read.status, 0);
    return;
  }
  EXPECT_THAT(read.said, HasSubstr("E_"));
  EXPECT_THAT(read.said, HasSubstr(file));
  EXPECT_LT(read.said.size(), 900U) << read.said.substr(0, 900);
  EXPECT_GE(std::min(read.said.find('\n'), read.said.size()) + 1, read.said.size()) << read.said;
}

std::string le(std::uint64_t value, std::size_t size) {
  return little_endian(value, size);
}

std::string schema(int id, const std::string& type) {
  return mcap_record(3, le(static_cast<std::uint64_t>(id), 2) + counted_text(type) +
                            counted_text("ros2msg") + counted_text("uint8 x"));
}
std::string channel(int id, int schema, const std::string& topic, const std::string& encoding) {
  return mcap_record(4, le(static_cast<std::uint64_t>(id), 2) +
                            le(static_cast<std::uint64_t>(schema), 2) + counted_text(topic) +
                            counted_text(encoding) + le(0, 4));
}
std::string message(int channel, const std::string& content) {
  return mcap_record(
      5, le(static_cast<std::uint64_t>(channel), 2) + le(0, 4) + le(1, 8) + le(1, 8) + content);
}
std::string chunk(std::uint64_t says, const std::string& packing, const std::string& packed) {
  return mcap_record(6, le(0, 8) + le(0, 8) + le(says, 8) + le(0, 4) + counted_text(packing) +
                            le(packed.size(), 8) + packed);
}
std::string mcap(const std::string& records) {
  return kMcapMagic + records + mcap_record(15, le(0, 4)) +
         mcap_record(2, le(0, 8) + le(0, 8) + le(0, 4)) + kMcapMagic;
}

struct Case {
  std::string bytes;
  std::string says;  ///< within the sentence
};

TEST(DamagedMcap, IsRefusedByItsCause) {
  const TemporaryFolder folder;
  const std::string head = schema(1, kImage) + channel(1, 1, kTopic, "cdr");
  const std::string image = message(1, cdr_of(image_of(0)));
  const std::string zeros = packed_bytes("zstd", std::string(std::size_t{80} << 20, '\0'));
  const std::string long_name(100'000, 'x');
  std::string many;
  for (int i = 0; i < 30'000; ++i)
    many += channel(i, 1, "/a" + std::to_string(i), "cdr") + message(i, "x");
  std::string wide = cdr_of(image_of(0));
  BagImage lies = image_of(0);
  lies.width = UINT32_MAX;
  BagImage far = image_of(0);
  far.step = UINT32_MAX;
  BagImage odd = image_of(0);
  odd.encoding = "\x1b[31m" + long_name;
  const std::vector<Case> cases = {
      {"", "empty"},
      {kMcapMagic, "ends before its first message"},
      {mcap(""), "no messages"},
      {mcap(head), "no messages"},
      {mcap(head + mcap_record(5, "x")), "damaged at byte"},
      {std::string(kMcapMagic) + head + '\5' + le(UINT64_MAX, 8), "ends before its first message"},
      {std::string(kMcapMagic) + '\3' + le(UINT64_MAX, 8), "damaged at byte 8"},
      {std::string(kMcapMagic) + head + image.substr(0, 4000), "ends before its first message"},
      {mcap(chunk(std::uint64_t{1} << 42, "zstd", packed_bytes("zstd", head))), "damaged at byte"},
      {mcap(chunk(500 << 20, "zstd", packed_bytes("zstd", head))), "damaged at byte"},
      {mcap(chunk(500 << 20, "lz4", packed_bytes("lz4", head))), "damaged at byte"},
      {mcap(chunk(head.size() - 9, "zstd", packed_bytes("zstd", head))), "damaged at byte"},
      {mcap(chunk(std::size_t{80} << 20, "zstd", zeros)), "expands to 80 MB"},
      {mcap(chunk(head.size(), "brotli", head)), "packed with `brotli`"},
      {mcap(chunk(head.size(), "\x1b[1m" + long_name, head)), "packed with `"},
      {mcap(chunk(head.size() - 5, "", head.substr(0, head.size() - 5))),
       "goes on beyond its chunk"},
      {mcap(schema(1, "sensor_msgs/msg/" + long_name) + channel(1, 1, kTopic, "cdr") + image),
       "damaged at byte"},
      {mcap(schema(1, kImage) + channel(1, 1, "/" + long_name, "cdr") + image), "damaged at byte"},
      {mcap(schema(1, "a/B") + many), "and 29992 more"},
      {mcap(schema(1, kImage) + many), "and 29992 more"},
      {mcap(schema(1, kImage) + channel(1, 1, kTopic, "protobuf") + image),
       "`protobuf`, which is not read"},
      {mcap(schema(1, "foxglove.CompressedImage") + channel(1, 1, kTopic, "protobuf") + image),
       "no images in this bag"},
      {mcap(channel(1, 7, kTopic, "cdr") + image), "no images in this bag"},
      {mcap(head + message(1, cdr_of(lies))), "pixels are not taken"},
      {mcap(head + message(1, cdr_of(far))), "a row"},
      {mcap(head + message(1, cdr_of(odd))), "xxx...`, which is not read"},
      {mcap(head + message(1, wide.substr(0, 40))), "ends too early"},
      {mcap(head + message(1, std::string("\0\7\0\0", 4) + wide.substr(4))), "00 07"},
      {mcap(head + message(1, packed_bytes("zstd", wide))), "zstd"},
      {mcap(schema(1, "sensor_msgs/msg/CompressedImage") + channel(1, 1, kTopic, "cdr") +
            message(1, cdr_of(BagPacked{}))),
       "an image without bytes"},
  };
  int number = 0;
  for (const Case& one : cases) {
    SCOPED_TRACE(number++);
    write_bytes(folder / "run.mcap", one.bytes);
    const ReadApart read = read_apart(folder / "run.mcap");
    expect_sane(read, folder / "run.mcap");
    EXPECT_THAT(read.said.substr(0, 600), HasSubstr(one.says));
  }
}

TEST(DamagedMcap, NamesThatFillMemoryAreRefused) {
  const TemporaryFolder folder;
  // Each a few kilobytes in the file, and 20 MB in memory.
  std::string records;
  for (int i = 1; i <= 2; ++i) {
    const std::string one = schema(i, std::string(20 << 20, 'x'));
    records += chunk(one.size(), "zstd", packed_bytes("zstd", one));
  }
  write_bytes(folder / "run.mcap", mcap(records));
  const ReadApart read = read_apart(folder / "run.mcap");
  expect_sane(read, folder / "run.mcap");
  EXPECT_THAT(read.said, HasSubstr("damaged at byte"));
}

TEST(DamagedMcap, ThatWasCutIsMarkedSo) {
  const TemporaryFolder folder;
  WrittenMcap bag("zstd");
  for (int i = 0; i < 30; ++i)
    bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
  const std::string whole = bag.finished();
  write_bytes(folder / "run.mcap", whole);
  EXPECT_FALSE(read_apart(folder / "run.mcap").is_odd);
  for (const int tenth : {4, 6, 9}) {
    write_bytes(folder / "run.mcap",
                whole.substr(0, whole.size() * static_cast<unsigned>(tenth) / 10));
    const ReadApart read = read_apart(folder / "run.mcap");
    EXPECT_TRUE(read.is_odd);
    EXPECT_EQ(read.said, "");
    EXPECT_GT(read.frames, 3);
  }
}

TEST(DamagedDb3, IsRefusedByItsCause) {
  const TemporaryFolder folder;
  struct Made {
    std::function<void(WrittenDb3&)> make;
    std::string says;  ///< empty: it reads
  };
  const auto add = [](WrittenDb3& bag) {
    for (int i = 0; i < 3; ++i)
      bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
  };
  const std::string packed = packed_bytes("zstd", cdr_of(image_of(0)));
  const std::vector<Made> cases = {
      {add, ""},
      {[](WrittenDb3&) {}, "no messages"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("CREATE TRIGGER t AFTER INSERT ON messages BEGIN DELETE FROM messages; END");
       },
       ""},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("ALTER TABLE messages RENAME TO m");
         bag.run("CREATE VIEW messages AS SELECT * FROM m");
       },
       "messages is not a table"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("DROP TABLE topics");
       },
       "topics is not a table"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("ALTER TABLE topics RENAME COLUMN type TO kind");
       },
       "no such column: type"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("DROP TABLE messages");
         bag.run(
             "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data BLOB AS "
             "(zeroblob(390000000)))");
         bag.run("INSERT INTO messages(topic_id, timestamp) VALUES(1, 1)");
       },
       "is computed"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("UPDATE messages SET data = 'text'");
       },
       "is not CDR"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("UPDATE messages SET data = ?", &packed);
       },
       "zstd"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("UPDATE messages SET data = zeroblob(10000000)");
       },
       "the encoding ``"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("UPDATE topics SET serialization_format = 'protobuf'");
       },
       "`protobuf`, which is not read"},
      {[&](WrittenDb3& bag) {
         add(bag);
         bag.run("UPDATE topics SET name = printf('%.*c', 100000, 'x'), type = 'a/B'");
       },
       "no images in this bag"},
      {[&](WrittenDb3& bag) {
         bag.run(
             "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 5000) INSERT "
             "INTO topics SELECT i, 't' || i, 'a/B', 'cdr', '' FROM n");
         bag.run(
             "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 5000) INSERT "
             "INTO messages SELECT i, i, i, 'x' FROM n");
       },
       "and 4992 more"},
  };
  int number = 0;
  for (const Made& one : cases) {
    SCOPED_TRACE(number);
    const std::string file = folder / ("run" + std::to_string(number++) + ".db3");
    {
      WrittenDb3 bag(file);
      one.make(bag);
    }
    const ReadApart read = read_apart(file);
    expect_sane(read, file);
    EXPECT_THAT(read.said.substr(0, 600), HasSubstr(one.says));
    if (one.says.empty()) {
      EXPECT_EQ(read.frames, 3) << read.said;
    }
  }
  for (const auto& [bytes, says] : std::vector<Case>{
           {"", "empty"},
           {"SQLite format 3", "is damaged"},
           {std::string("SQLite format 3\0", 16) + std::string(5000, '\1'), "is damaged"},
           {"no database, but text", "or no SQLite file"},
           {whole_file(folder / "run0.db3").substr(0, 20'000), "is damaged"}}) {
    write_bytes(folder / "bad.db3", bytes);
    const ReadApart read = read_apart(folder / "bad.db3");
    expect_sane(read, folder / "bad.db3");
    EXPECT_THAT(read.said, HasSubstr(says));
  }
}

TEST(DamagedBagFolder, IsRefusedByItsCause) {
  const TemporaryFolder folder;
  WrittenMcap bag("zstd");
  for (int i = 0; i < 5; ++i)
    bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
  const std::string parts =
      "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n    - run_0.mcap\n    - "
      "run_1.mcap\n  duration:\n    nanoseconds: 1\n";
  const fs::path run = folder / "run";
  fs::create_directory(run);
  write_bytes(run / "metadata.yaml", parts);
  EXPECT_THAT(read_apart(run).said,
              HasSubstr("metadata.yaml names run_0.mcap, which is not there"));
  write_bytes(run / "run_0.mcap", bag.finished());
  EXPECT_THAT(read_apart(run).said,
              HasSubstr("metadata.yaml names run_1.mcap, which is not there"));
  fs::remove(run / "metadata.yaml");
  EXPECT_EQ(read_apart(run).frames, 5);
  fs::rename(run / "run_0.mcap", run / "run_0.mcap.zstd");
  EXPECT_THAT(read_apart(run).said, HasSubstr("zstd -d"));
  EXPECT_THAT(read_apart(run / "run_0.mcap.zstd").said, HasSubstr("zstd -d"));
}

/// Some bytes changed, cut out, doubled, or the end cut off.
std::string hurt(std::string bytes, Rng& rng) {
  const auto below = [&](std::size_t most) { return rng.below(std::max<std::size_t>(most, 1)); };
  for (std::uint64_t n = 1 + rng.below(5); n > 0; --n) {
    // Lengths and counts lie at the beginning.
    const std::size_t at =
        below(rng.below(2) == 0 ? std::min<std::size_t>(bytes.size(), 500) : bytes.size());
    const std::size_t some = std::min<std::size_t>(1 + below(16), bytes.size() - at);
    switch (rng.below(6)) {
      case 0:
        bytes.erase(at, some);
        break;
      case 1:
        bytes.insert(at, bytes.substr(at, some));
        break;
      case 2:
        bytes.replace(at, some, std::string(some, '\xff'));
        break;
      case 3:
        bytes.resize(rng.below(4) == 0 ? at : bytes.size());
        break;
      default:
        bytes[at] = static_cast<char>(rng.below(256));
        break;
    }
    if (bytes.empty()) break;
  }
  return bytes;
}

void try_hurt(int tries, ReadApart (*read)(const std::string&), std::uint64_t seed) {
  const TemporaryFolder folder;
  Rng rng(seed);
  std::vector<std::pair<std::string, std::string>> files;
  for (const char* packing : {"none", "zstd", "lz4", "bare"}) {
    WrittenMcap bag(packing);
    for (int i = 0; i < 6; ++i) {
      bag.add("/temperature", "sensor_msgs/msg/Temperature", image_of(i).recorded, "xx");
      bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
    }
    files.emplace_back("run.mcap", bag.finished());
  }
  {
    WrittenDb3 bag(folder / "whole.db3");
    for (int i = 0; i < 6; ++i)
      bag.add(kTopic, kImage, image_of(i).recorded, cdr_of(image_of(i)));
  }
  files.emplace_back("run.db3", whole_file(folder / "whole.db3"));
  int read_well = 0;
  for (int i = 0; i < tries; ++i) {
    const auto& [name, bytes] = files[static_cast<std::size_t>(i) % files.size()];
    write_bytes(folder / name, hurt(bytes, rng));
    const ReadApart done = read(folder / name);
    SCOPED_TRACE(name + " " + std::to_string(i));
    expect_sane(done, folder / name);
    if (testing::Test::HasFailure()) {
      fs::copy_file(folder / name, fs::temp_directory_path() / ("hurt_" + name),
                    fs::copy_options::overwrite_existing);
      return;
    }
    read_well += done.said.empty() ? 1 : 0;
  }
  EXPECT_GT(read_well, tries / 20);
  EXPECT_LT(read_well, tries * 19 / 20);
}

TEST(DamagedRecordings, AreReadOrRefusedWhateverIsChanged) {
  try_hurt(times(200, 3000), &read_apart, 46);
}

TEST(DamagedRecordings, ByTheProgram) {
  if (times(0, 1) == 0) GTEST_SKIP() << "skipped: long";
  if (!has_track_program()) GTEST_SKIP() << "skipped: swarmsmith-track is not built";
  try_hurt(300, &detected_apart, 4646);
}

}  // namespace
}  // namespace swarmsmith
