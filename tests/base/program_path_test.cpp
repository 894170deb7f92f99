#include "base/program_path.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

class ProgramPath : public ::testing::Test {
 protected:
  void SetUp() override {
    write("first/tool", false);
    write("second/tool", true);
    write("third/tool", true);
    fs::create_directories(folder_.path() / "zero/tool");
  }

  void write(const std::string& name, bool may_run) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "#!/bin/sh\n";
    const auto run = fs::perms::owner_exec;
    fs::permissions(file, run, may_run ? fs::perm_options::add : fs::perm_options::remove);
  }
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(ProgramPath, TheFirstThatMayBeRun) {
  const std::string path = in("zero") + ":" + in("first") + ":" + in("second") + ":" + in("third");
  EXPECT_EQ(program_in(path, "tool"), fs::path(in("second/tool")));
  EXPECT_EQ(program_in(in("first"), "tool"), std::nullopt);
  EXPECT_EQ(program_in("", "tool"), std::nullopt);
}

TEST_F(ProgramPath, RelativeFoldersHaveNoSay) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path() / "second");
  EXPECT_EQ(program_in(":.:../second:" + in("third"), "tool"), fs::path(in("third/tool")));
  EXPECT_EQ(program_in("::", "tool"), std::nullopt);
  fs::current_path(before);
}

TEST_F(ProgramPath, AFolderIsNoProgram) {
  EXPECT_FALSE(may_be_run(in("zero/tool")));
  EXPECT_FALSE(may_be_run(in("first/tool")));
  EXPECT_TRUE(may_be_run(in("second/tool")));
}

}  // namespace
}  // namespace swarmsmith
