#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A design that was made elsewhere.
struct ImportedDesign {
  DesignRow row;     ///< with the id that it gets here
  std::string name;  ///< as it was called there; may be empty
};

/// What is added to a store as one: all of it, or nothing.
struct Addition {
  /// A campaign of its own, with the state "imported", and its designs, whose ids follow on those
  /// that are there.
  std::optional<CampaignRow> campaign;
  std::vector<ImportedDesign> designs;
  std::vector<EvaluationKey> removed;  ///< evaluations that give way to rows below
  std::vector<Row> rows;
};

/// A store that no campaign is writing, opened to add what came from outside of its races: later
/// scores, and designs that were made elsewhere. Holds the store's lock while it lives. What the
/// store holds is read with a StoreReader beside it.
class StoreAtRest {
 public:
  enum class IfMissing { Refuse, Make };

  /// Opens the store of any campaign, and migrates it; `designs`, of the campaign's file, tell the
  /// flavours, which stores before schema 4 do not. A new store is made without a campaign; it is
  /// gone again when nothing is added. Errors as of Store::open; NotFound with `Refuse`.
  static Expected<std::unique_ptr<StoreAtRest>> open(const std::filesystem::path& path,
                                                     IfMissing if_missing,
                                                     const std::vector<DesignRow>& designs = {});
  virtual ~StoreAtRest() = default;

  /// Whether open() made the file, and nothing was added so far.
  virtual bool is_new() const = 0;

  /// Commits everything or nothing, and waits for the disk. Rows that are already there stay as
  /// they are. Conflict when the ids of the designs do not follow on; Unavailable when the disk
  /// refuses. Throws std::invalid_argument when a number is NaN or infinite.
  virtual Expected<void> add(const Addition& addition) = 0;
};

}  // namespace swarmsmith
