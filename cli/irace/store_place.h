#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/expected.h"

namespace swarmsmith::cli {

/// The place of a run's store: a file that the user named, or a file in a temporary folder that is
/// deleted with this object.
class StorePlace {
 public:
  static StorePlace at(std::filesystem::path file);
  /// For a campaign that belongs to the campaign of another store: `name-test.db`.
  static StorePlace beside(const std::filesystem::path& file, const std::string& ending);
  /// Unavailable if there is no place for temporary files.
  static Expected<StorePlace> temporary();

  StorePlace(StorePlace&& other) noexcept;
  StorePlace& operator=(StorePlace&&) = delete;
  ~StorePlace();

  const std::filesystem::path& file() const { return file_; }
  bool is_kept() const { return folder_.empty(); }
  /// The seed of the campaign in the store; empty if there is no readable store.
  std::optional<std::uint64_t> seed() const;

 private:
  StorePlace(std::filesystem::path file, std::filesystem::path folder);

  std::filesystem::path file_;
  std::filesystem::path folder_;  ///< to be deleted; empty: nothing to delete
};

}  // namespace swarmsmith::cli
