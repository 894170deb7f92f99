#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "storage/recover.h"
#include "storage/store.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/synthetic_campaign.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_ahead_log.h"

namespace swarmsmith::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPage = 8192;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// A whole store, which inputs damage.
const std::string& sound_store() {
  static const std::string bytes = [] {
    const TemporaryFolder folder;
    const SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 1});
    {
      const auto store = Store::open(folder / "s.db", campaign.campaign, campaign.designs);
      require(store.has_value(), "a store can be made");
      for (const auto& batch : campaign.batches)
        (*store)->append(batch);
    }
    return bytes_of(folder / "s.db");
  }();
  return bytes;
}

/// An input from the left; zeros after its end.
class Cursor {
 public:
  explicit Cursor(std::string_view input) : input_(input) {}
  bool at_end() const { return input_.empty(); }
  std::uint32_t number(int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i)
      value = value << 8U | static_cast<unsigned char>(text(1)[0]);
    return value;
  }
  std::string text(std::size_t size) {
    std::string taken(input_.substr(0, size));
    input_.remove_prefix(taken.size());
    taken.resize(size, '\0');
    return taken;
  }

 private:
  std::string_view input_;
};

void put(std::string& bytes, std::size_t at, const std::string& change) {
  for (std::size_t i = 0; i < change.size() && at + i < bytes.size(); ++i)
    bytes[at + i] = change[i];
}

}  // namespace

/// Damage, one after the other: 'w' writes bytes somewhere, 'c' cuts the file off, 'f' appends a
/// frame to its log: a page of the file with other bytes in it, under any number. Whatever is left
/// is recovered or refused with a sentence, soon, and what is recovered is a whole store.
void run(std::string_view input) {
  constexpr std::size_t kMostFrames = 200;
  std::string store = sound_store();
  std::vector<LogFrame> frames;
  for (Cursor cursor(input); !cursor.at_end();) {
    const char kind = cursor.text(1)[0];
    if (kind == 'c') {
      store.resize(std::min<std::size_t>(store.size(), cursor.number(3)));
    } else if (kind == 'w') {
      const std::size_t at = cursor.number(3) % (store.size() + 1);
      put(store, at, cursor.text(cursor.number(1)));
    } else if (kind == 'f' && frames.size() < kMostFrames) {
      LogFrame frame{.page = cursor.number(4), .pages_after = cursor.number(4), .bytes = {}};
      const std::size_t from = cursor.number(1) * kPage;
      frame.bytes = from < sound_store().size() ? sound_store().substr(from, kPage) : "";
      frame.bytes.resize(kPage, '\0');
      const std::size_t at = cursor.number(2) % kPage;
      put(frame.bytes, at, cursor.text(cursor.number(1)));
      frames.push_back(std::move(frame));
    }
  }
  const TemporaryFolder folder;
  const fs::path damaged = folder / "damaged.db", out = folder / "out.db";
  write(damaged, store);
  if (!frames.empty()) write(damaged.string() + "-wal", write_ahead_log(frames, kPage));
  auto recovery = Recovery::begin(damaged, out);
  if (!recovery) return require(!recovery.error().message.empty(), "it says why");
  const auto end = (*recovery)->finish();
  recovery->reset();
  if (!end) return require(!end.error().message.empty(), "it says why");
  const auto reader = StoreReader::open(out);
  require(reader.has_value(), "what was recovered is a store");
  require((*reader)->digest() == end->digest, "its digest is the one that was told");
  require((*reader)->integrity().empty(), "it is whole");
}

}  // namespace swarmsmith::fuzz
