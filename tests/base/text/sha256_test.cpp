#include "base/text/sha256.h"

#include <filesystem>
#include <fstream>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const TemporaryFolder folder;
  // FIPS 180-4's example, the empty text, and more than one block of reading.
  write(folder / "a", "abc");
  EXPECT_EQ(*sha256_of_file(folder / "a"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1} << 18, (std::size_t{1} << 20) + 7}) {
    const std::string bytes(size, 'x');
    write(folder / "b", bytes);
    EXPECT_EQ(*sha256_of_file(folder / "b"), sha256_of(bytes));
  }
}

TEST(Sha256, OfAFolderIsThatOfNamesAndBytes) {
  const TemporaryFolder folder;
  write(folder / "2.png", "two");
  write(folder / "1.png", "one");
  const std::string first = *sha256_of_file(folder.path());
  EXPECT_EQ(first, sha256_of(sha256_of("one") + "  1.png\n" + sha256_of("two") + "  2.png\n"));
  write(folder / ".hidden", "x");
  EXPECT_EQ(*sha256_of_file(folder.path()), first);
  std::filesystem::rename(folder / "2.png", folder / "3.png");
  EXPECT_NE(*sha256_of_file(folder.path()), first);
}

TEST(Sha256, SaysWhatCannotBeRead) {
  const TemporaryFolder folder;
  const Error none = why_not(sha256_of_file(folder / "none.mp4"));
  EXPECT_EQ(none.kind, ErrorKind::NotFound);
  EXPECT_THAT(none.where, HasSubstr("none.mp4"));
}

}  // namespace
}  // namespace swarmsmith
