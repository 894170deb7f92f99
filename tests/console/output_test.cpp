#include "console/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// Both standard streams in one file, as `> FILE 2>&1` has them.
class InOneFile {
 public:
  explicit InOneFile(const std::filesystem::path& path)
      : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600)) {
    flush();
    ::dup2(file_, STDOUT_FILENO);
    ::dup2(file_, STDERR_FILENO);
  }
  ~InOneFile() {
    flush();
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(err_, STDERR_FILENO);
    for (const int open : {file_, out_, err_})
      ::close(open);
  }
  InOneFile(const InOneFile&) = delete;
  InOneFile& operator=(const InOneFile&) = delete;

 private:
  static void flush() {
    standard_output().out.flush();
    std::fflush(nullptr);
  }

  int out_ = ::dup(STDOUT_FILENO);
  int err_ = ::dup(STDERR_FILENO);
  int file_;
};

TEST(Output, OfBothStreamsInOneFileIsWholeLinesInTheirOrder) {
  const TemporaryFolder folder;
  constexpr int kLines = 2000;  // more than any buffer holds
  std::string expected;
  {
    const InOneFile redirected(folder / "log");
    Output output = standard_output();
    for (int i = 0; i < kLines; ++i) {
      (i % 7 == 0 ? output.err : output.out) << "line " << i << " of one log\n";
      expected += "line " + std::to_string(i) + " of one log\n";
    }
  }
  EXPECT_EQ(whole_file(folder / "log"), expected);
}

}  // namespace
}  // namespace swarmsmith
