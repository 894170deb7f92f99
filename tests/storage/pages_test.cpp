#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "storage/internal/page_image.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_ahead_log.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kPage = 512;

/// A database file written by hand: bytes 0, but for the header.
class Pages : public testing::Test {
 protected:
  Pages() {
    bytes.replace(0, 16, "SQLite format 3\0", 16);
    put(16, 2, kPage);
  }

  /// A big-endian number of `count` bytes.
  void put(std::size_t at, std::size_t count, std::uint64_t value) {
    for (std::size_t i = count; i-- > 0; value >>= 8U)
      bytes[at + i] = static_cast<char>(value & 0xffU);
  }
  PageImage image() const {
    std::ofstream(path, std::ios::binary) << bytes;
    return value_of(PageImage::read(path));
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder / "s.db";
  std::string bytes = std::string(200 * kPage, '\0');
};

TEST_F(Pages, FreeOnesAreListedByTheirTrunks) {
  put(32, 4, 2);
  put(kPage + 4, 4, 3);
  for (std::uint64_t i = 0; i < 3; ++i)
    put(kPage + 8 + 4 * i, 4, 10 + i);
  EXPECT_THAT(image().free_pages(), ElementsAre(2, 10, 11, 12));
}

TEST_F(Pages, ATrunkListsNoMoreThanItHolds) {
  put(32, 4, 2);
  put(kPage + 4, 4, 0xffffffff);
  EXPECT_EQ(image().free_pages().size(), 1 + (kPage / 4 - 2));
}

TEST_F(Pages, OfALogWithAnotherSizeAreNotTaken) {
  for (const std::size_t size : {kPage, 2 * kPage}) {
    std::ofstream(path.string() + "-wal", std::ios::binary)
        << write_ahead_log({{.page = 2, .pages_after = 200, .bytes = std::string(size, 'x')}},
                           static_cast<std::uint32_t>(size));
    EXPECT_EQ(image().page(2)[0], size == kPage ? 'x' : 0) << size;
  }
}

TEST_F(Pages, BehindSixteenMegabytesAreReadToo) {
  bytes.resize(17U << 20U);
  bytes[(16U << 20U) - 1] = 'a';
  bytes[16U << 20U] = 'b';
  const PageImage read = image();
  EXPECT_EQ(read.page((16U << 20U) / kPage).back(), 'a');
  EXPECT_EQ(read.page((16U << 20U) / kPage + 1).front(), 'b');
}

}  // namespace
}  // namespace swarmsmith
