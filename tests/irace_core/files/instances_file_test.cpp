#include "irace_core/files/instances_file.h"

#include <filesystem>
#include <fstream>

#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(InstancesFile, AByteOrderMarkBelongsToNoInstance) {
  EXPECT_THAT(parse_instances("\xef\xbb\xbf"
                              "a\nb\n"),
              ElementsAre("a", "b"));
}

TEST(InstancesFile, CommentsAndBlanksBeforeInstancesGo) {
  EXPECT_THAT(parse_instances("a.tsp\n # all of it\n\t b c  # a part\n\n  \nlast"),
              ElementsAre("a.tsp", "b c  ", "last"));
}

TEST(InstancesFile, LinesEndInEveryWay) {
  EXPECT_THAT(parse_instances("a\r\nb\rc\n\r\n"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(parse_instances(""), IsEmpty());
}

TEST(InstancesFile, AFolderIsPutBeforeEachLine) {
  const TemporaryFolder folder;
  write(folder / "list.txt", "a\nb --size 3\n");
  EXPECT_THAT(read_instances_file(folder / "list.txt", "/data").value(),
              ElementsAre("/data/a", "/data/b --size 3"));
  EXPECT_THAT(read_instances_file(folder / "list.txt", "").value(), ElementsAre("a", "b --size 3"));
}

TEST(InstancesFile, AFileWithoutInstancesOrAFileThatIsMissingIsAnError) {
  const TemporaryFolder folder;
  write(folder / "list.txt", "# nothing\n");
  EXPECT_THAT(read_instances_file(folder / "list.txt", "").error().message,
              HasSubstr("names no instance"));
  const auto missing = read_instances_file(folder / "none.txt", "");
  EXPECT_EQ(missing.error().kind, ErrorKind::NotFound);
  EXPECT_EQ(missing.error().where, (folder / "none.txt").string());
}

TEST(InstancesFile, AFolderIsListedWithAllBelowItSortedByBytes) {
  const TemporaryFolder folder;
  for (const char* name : {"b", "B", "a.9", "a.10", "deep/q", "_u", ".hidden", ".git/w"})
    write(folder / name, "");
  std::vector<std::string> wanted;
  for (const char* name : {"B", "_u", "a.10", "a.9", "b", "deep/q"})
    wanted.push_back((folder / name).string());
  EXPECT_EQ(list_instances(folder.path()).value(), wanted);
}

TEST(InstancesFile, LinksInACircleEnd) {
  const TemporaryFolder folder;
  write(folder / "a", "");
  fs::create_directory_symlink(folder.path(), folder / "one");
  fs::create_directory_symlink(folder.path(), folder / "two");
  EXPECT_THAT(list_instances(folder.path()).value(), ElementsAre((folder / "a").string()));
}

TEST(InstancesFile, EmptyAndMissingFoldersAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THAT(list_instances(folder.path()).error().message, HasSubstr("no files"));
  EXPECT_EQ(list_instances(folder / "none").error().kind, ErrorKind::NotFound);
}

TEST(InstancesFile, WhatIsPrintedReadsBack) {
  Rng rng(11);
  constexpr std::string_view kLetters = "ab \t\"'\\/.-=%$";
  for (int round = 0; round < 300; ++round) {
    std::vector<std::string> instances(1 + rng.below(5));
    for (std::string& instance : instances) {
      instance = "x";
      for (std::uint64_t i = rng.below(8); i > 0; --i)
        instance += kLetters[rng.below(kLetters.size())];
    }
    EXPECT_EQ(parse_instances(print_instances(instances).value()), instances);
  }
}

TEST(InstancesFile, WhatNoListCanSayIsNotPrinted) {
  for (const char* instance : {"", " a", "a#b", "a\nb", "\ta", "a\r"}) {
    EXPECT_FALSE(print_instances(std::vector<std::string>{"ok", instance})) << instance;
  }
}

}  // namespace
}  // namespace swarmsmith
