#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/expected.h"

namespace swarmsmith::cli {

/// Where a run's store is: a file that the user named, or one in a temporary folder that goes with
/// this object.
class StorePlace {
 public:
  static StorePlace at(std::filesystem::path file);
  /// Of a campaign that belongs to another store's: `name-test.db`.
  static StorePlace beside(const std::filesystem::path& file, const std::string& ending);
  /// Unavailable, when there is no place for temporary files.
  static Expected<StorePlace> temporary();

  StorePlace(StorePlace&& other) noexcept;
  StorePlace& operator=(StorePlace&&) = delete;
  ~StorePlace();

  const std::filesystem::path& file() const { return file_; }
  bool is_kept() const { return folder_.empty(); }
  /// The seed of the campaign that the store holds; nothing when there is no store that can be
  /// read.
  std::optional<std::uint64_t> seed() const;

 private:
  StorePlace(std::filesystem::path file, std::filesystem::path folder);

  std::filesystem::path file_;
  std::filesystem::path folder_;  ///< to be removed; empty for none
};

}  // namespace swarmsmith::cli
