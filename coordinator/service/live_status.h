#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/json.h"
#include "coordinator/launchers/launcher.h"
#include "coordinator/pool/campaign_meters.h"
#include "coordinator/pool/slot_times.h"
#include "coordinator/service/progress_model.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A worker as it is now. Times in seconds.
struct WorkerStatus {
  std::int64_t number = 0;  ///< WorkerRow::id
  std::string state;        ///< "connected", "quarantined", "gone"
  std::string host;
  std::string job;
  std::string client;
  std::int64_t slots = 0;
  std::int64_t held = 0;     ///< leases
  std::int64_t running = 0;  ///< as it last said
  std::int64_t done = 0;
  std::int64_t failed = 0;
  std::int64_t connections = 0;
  double done_per_s = 0;  ///< over the last seconds
  double busy = 0;        ///< share of its slots' time over the same
  double last_heard_s = 0;
};

/// Workers that get nothing, until a person forgives who answers for them.
struct QuarantineStatus {
  std::string
      who;  ///< key and address; an address; "local ..." of a worker that this process started
  std::string reason;
  std::string since;         ///< UTC, as stores have it
  std::int64_t worker = 0;   ///< the one process of `who` that is meant; 0: all, or not here
  std::int64_t workers = 0;  ///< of them that are connected
  double for_s = 0;          ///< the same as `since`, where that is empty: not in the JSON
};

/// "in quarantine since ...: node@10.0.0.5 (2 workers here): it gave ...".
std::string quarantine_line(const QuarantineStatus& status);
/// What a person reads who lets them work again, or who meant another worker: with that in it.
inline constexpr const char* kNotInQuarantine = "it is not in quarantine";
std::string sentence_of_forgiven(const std::vector<std::string>& names);
Expected<std::string> not_in_quarantine(const std::string& word,
                                        const std::vector<std::string>& known);

struct CampaignStatus {
  std::string name;
  /// As CampaignStateRow; "interrupted": it is not finished, and no coordinator runs it;
  /// "imported": it never ran here.
  std::string state;
  std::string trouble;  ///< why its store cannot write, or why it is stopped; empty when well
  std::int64_t queued_units = 0;  ///< row units that its writer has not committed
  std::int64_t wal_bytes = 0;
  /// What the programs of a design's runs may take together, where that is the budget of its race,
  /// and no number of experiments; else 0.
  double max_time = 0;
  bool costs = false;  ///< people see means as costs, as the programs print them
  std::vector<DesignStatus> designs;
  CampaignMeters meters;
  Histogram commit_time;  ///< from a unit of rows given to the writer to its commit
  Histogram step_time;    ///< from one step of a design's race to its next

  CampaignTotals totals() const { return totals_of(designs); }
  /// The design's state; "interrupted" if it was at work and no coordinator runs it.
  std::string_view word_of_design(const DesignStatus& design) const;
};

/// How a coordinator's campaigns are right now; from the coordinator's memory, for people. Counts
/// are since the start of this process.
struct LiveStatus {
  /// A coordinator says it; false for what its store says while none does.
  bool running = true;
  std::int64_t workers = 0;
  std::int64_t slots = 0;
  std::int64_t ready = 0;  ///< tasks that wait for a slot
  std::int64_t leased = 0;
  std::int64_t credit = 0;  ///< tasks that workers want to hold
  std::int64_t done = 0;    ///< outcomes
  std::int64_t rejected = 0;
  std::int64_t failed = 0;  ///< attempts without a score
  std::int64_t requeued = 0;
  std::int64_t expired = 0;  ///< leases whose time was over
  std::int64_t duplicates = 0;
  std::int64_t conflicts = 0;
  std::int64_t unknown = 0;        ///< results that were not asked for
  std::int64_t unleased = 0;       ///< results of tasks that their senders were never given
  std::int64_t audits = 0;         ///< results that were made again, and compared
  std::int64_t rulings = 0;        ///< evaluations of the referee, audits included
  std::int64_t referee_queue = 0;  ///< evaluations that wait for it
  std::int64_t lost_workers = 0;
  std::int64_t reconnects = 0;
  std::int64_t malformed = 0;
  std::map<std::string, std::uint64_t> malformed_by;  ///< by the part that was wrong
  /// What others wanted beyond their budgets, and was left out, by kind.
  std::map<std::string, std::uint64_t> over_budget;
  std::int64_t uncommitted = 0;  ///< outcomes that are not on disk yet
  std::int64_t bytes_in = 0;     ///< of frames
  std::int64_t bytes_out = 0;
  std::int64_t quarantined = 0;   ///< workers that are here and get nothing
  std::int64_t gone_workers = 0;  ///< that were there within the last quarter of an hour
  double uptime_s = 0;
  double evaluations_per_s = 0;  ///< over the last seconds
  double used_per_s = 0;         ///< experiments of budgets, over the last minute
  SlotTimes slot_times;
  SlotTimes slot_times_last_minute;
  std::string trouble;      ///< why nothing can be written; empty when well
  LauncherStatus launcher;  ///< of workers that this process starts; without name: none
  /// Other hosts can connect without keys (--insecure).
  bool insecure_plaintext = false;
  std::map<std::string, std::uint64_t> refused;  ///< connections, by reason
  std::vector<QuarantineStatus> quarantine;
  /// Refreshed once a second; shared, since each status is copied. Never null after the first.
  std::shared_ptr<const std::vector<WorkerStatus>> fleet;
  std::shared_ptr<const std::vector<CampaignStatus>> campaigns;
};

/// Seconds until races have used the rest at the rate of the last minute, the expected time of
/// every output; negative when nothing moves, 0 when nothing is left.
double seconds_left(const LiveStatus& status);

/// One JSON object with the fields by name; docs/observability.md describes it.
JsonObject to_json(const LiveStatus& status);
/// The same without `campaigns` and `fleet`.
JsonObject head_json(const LiveStatus& status);
/// The arrays `fleet` and `quarantine` alone.
JsonPiece fleet_json(const LiveStatus& status);
JsonPiece quarantine_json(const std::vector<QuarantineStatus>& quarantine);
/// `to_json` back, without histograms. Errors: no such object.
Expected<LiveStatus> live_status_of(const std::string& text);

}  // namespace swarmsmith
