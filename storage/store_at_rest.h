#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/real_runs.h"
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
/// scores, designs that were made elsewhere, and real runs. Holds the store's lock while it lives.
/// What the store holds is read with a StoreReader beside it.
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

  /// The same for a real run. A run whose key is there already, from the same inputs (candidate,
  /// mission, arena file, log, calibrations), is left as it is. Conflict when its inputs are others
  /// (it wants `rescore`); NotFound when the store has no such candidate. A new store gets a
  /// campaign without designs, which says that nothing raced there. Throws std::invalid_argument
  /// when a number is NaN or infinite, or a calibration is named that is not among the rows.
  virtual Expected<RealRunWritten> add_real_run(const RealRunRows& rows) = 0;
  /// Replaces all of a run that follows from its sightings and its inputs, the inputs too, and adds
  /// the score to its history. Sightings, frame times and floor tags stay as they were: BadInput
  /// when `rows` is another run (by its key) or has other sightings. NotFound when there is none.
  virtual Expected<void> rescore_real_run(RealRunId id, const RealRunRows& rows) = 0;
  /// A person's word. BadInput for a verdict that is none, or without a name or a reason; NotFound.
  virtual Expected<void> add_override(const RealOverrideRow& row) = 0;
};

}  // namespace swarmsmith
