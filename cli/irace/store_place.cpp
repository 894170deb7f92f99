#include "cli/irace/store_place.h"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "storage/store.h"

namespace swarmsmith::cli {

namespace fs = std::filesystem;

StorePlace::StorePlace(fs::path file, fs::path folder)
    : file_(std::move(file)), folder_(std::move(folder)) {}

StorePlace::StorePlace(StorePlace&& other) noexcept
    : file_(std::move(other.file_)), folder_(std::exchange(other.folder_, {})) {}

StorePlace::~StorePlace() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

StorePlace StorePlace::at(fs::path file) {
  return {std::move(file), {}};
}

StorePlace StorePlace::beside(const fs::path& file, const std::string& ending) {
  return at(file.parent_path() / (file.stem().string() + ending + file.extension().string()));
}

Expected<StorePlace> StorePlace::temporary() {
  std::error_code trouble;
  const fs::path place = fs::temp_directory_path(trouble);
  std::string folder = (place / "swarmsmith-irace-XXXXXX").string();
  if (trouble || mkdtemp(folder.data()) == nullptr) {
    return unexpected(ErrorKind::Unavailable,
                      "no folder for temporary files can be made here; set TMPDIR, or name a store "
                      "with --log-file",
                      place.string());
  }
  return StorePlace(fs::path(folder) / "irace.db", folder);
}

std::optional<std::uint64_t> StorePlace::seed() const {
  std::error_code trouble;
  if (!fs::exists(file_, trouble)) return std::nullopt;
  // An error is reported later, when the store is opened for writing.
  const auto store = StoreReader::open(file_);
  if (!store) return std::nullopt;
  return static_cast<std::uint64_t>((*store)->campaign().seed);
}

}  // namespace swarmsmith::cli
