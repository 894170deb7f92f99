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
  std::int64_t running = 0;  ///< as the worker last reported
  std::int64_t done = 0;
  std::int64_t failed = 0;
  std::int64_t connections = 0;
  double done_per_s = 0;  ///< over the last few seconds
  double busy = 0;        ///< share of its slots' time in the same period
  double last_heard_s = 0;
};

/// A worker or a group of workers in quarantine: they get no evaluations until a person forgives
/// their principal.
struct QuarantineStatus {
  std::string
      who;  ///< key and address; an address; or "local ..." for a worker that this process started
  std::string reason;
  std::string since;         ///< UTC, in the store's format
  std::int64_t worker = 0;   ///< the only process of `who` that is in quarantine; 0: all of them,
                             ///< or it is not connected
  std::int64_t workers = 0;  ///< how many of them are connected
  double for_s = 0;          ///< seconds since then, if `since` is empty; not in the JSON
};

/// "in quarantine since ...: node@10.0.0.5 (2 workers here): it gave ...".
std::string quarantine_line(const QuarantineStatus& status);
/// Answers to a person who forgives workers. The error begins with kNotInQuarantine.
inline constexpr const char* kNotInQuarantine = "it is not in quarantine";
std::string sentence_of_forgiven(const std::vector<std::string>& names);
Expected<std::string> not_in_quarantine(const std::string& word,
                                        const std::vector<std::string>& known);

struct CampaignStatus {
  std::string name;
  /// As in CampaignStateRow; or "interrupted": the campaign is not finished, and no coordinator
  /// runs it; or "imported": it never ran here.
  std::string state;
  std::string trouble;  ///< why its store cannot write, or why it has stopped; empty if all is well
  std::int64_t queued_units = 0;  ///< row units that its writer has not committed
  std::int64_t wal_bytes = 0;
  /// The total time that the programs of a design's runs may take, if the race's budget is a time
  /// instead of a number of experiments; else 0.
  double max_time = 0;
  bool costs = false;  ///< show means to people as costs, as the programs print them
  std::vector<DesignStatus> designs;
  CampaignMeters meters;
  Histogram commit_time;  ///< from handing a unit of rows to the writer to its commit
  Histogram step_time;    ///< from one step of a design's race to its next

  CampaignTotals totals() const { return totals_of(designs); }
  /// The design's state, or "interrupted" if it was at work and no coordinator runs it.
  std::string_view word_of_design(const DesignStatus& design) const;
};

/// The current state of a coordinator's campaigns, from the coordinator's memory, for people.
/// Counts start with this process.
struct LiveStatus {
  /// Whether the status comes from a running coordinator; false if it comes from a store.
  bool running = true;
  std::int64_t workers = 0;
  std::int64_t slots = 0;
  std::int64_t ready = 0;  ///< tasks that wait for a slot
  std::int64_t leased = 0;
  std::int64_t credit = 0;  ///< tasks that workers want to hold
  std::int64_t done = 0;    ///< outcomes
  std::int64_t rejected = 0;
  std::int64_t failed = 0;  ///< attempts that ended without a score
  std::int64_t requeued = 0;
  std::int64_t expired = 0;  ///< leases that expired
  std::int64_t duplicates = 0;
  std::int64_t conflicts = 0;
  std::int64_t unknown = 0;        ///< results for tasks that do not exist
  std::int64_t unleased = 0;       ///< results of tasks that were never leased to their senders
  std::int64_t audits = 0;         ///< results that were computed again and compared
  std::int64_t rulings = 0;        ///< evaluations of the referee, audits included
  std::int64_t referee_queue = 0;  ///< evaluations that wait for the referee
  std::int64_t lost_workers = 0;
  std::int64_t reconnects = 0;
  std::int64_t malformed = 0;
  std::map<std::string, std::uint64_t> malformed_by;  ///< by the part that was malformed
  /// Messages and rows that were left out because a client was over its budget, by kind.
  std::map<std::string, std::uint64_t> over_budget;
  std::int64_t uncommitted = 0;  ///< outcomes that are not on disk yet
  std::int64_t bytes_in = 0;     ///< of frames
  std::int64_t bytes_out = 0;
  std::int64_t quarantined = 0;   ///< connected workers that get no evaluations
  std::int64_t gone_workers = 0;  ///< workers that left within the last quarter of an hour
  double uptime_s = 0;
  double evaluations_per_s = 0;  ///< over the last few seconds
  double used_per_s = 0;         ///< experiments counted against budgets, over the last minute
  SlotTimes slot_times;
  SlotTimes slot_times_last_minute;
  std::string trouble;      ///< why no store can be written; empty if all is well
  LauncherStatus launcher;  ///< of the workers that this process starts; without a name: none
  /// Other hosts can connect without keys (--insecure).
  bool insecure_plaintext = false;
  std::map<std::string, std::uint64_t> refused;  ///< connections, by reason
  std::vector<QuarantineStatus> quarantine;
  /// Refreshed once a second; shared, because each status is copied. Null only at the beginning.
  std::shared_ptr<const std::vector<WorkerStatus>> fleet;
  std::shared_ptr<const std::vector<CampaignStatus>> campaigns;
};

/// Seconds until the races have used the rest of their budgets at the rate of the last minute; all
/// outputs show it as the expected time. Negative if nothing moves, 0 if nothing is left.
double seconds_left(const LiveStatus& status);

/// One JSON object whose keys are the names of the fields; docs/observability.md describes it.
JsonObject to_json(const LiveStatus& status);
/// The same without `campaigns` and `fleet`.
JsonObject head_json(const LiveStatus& status);
/// The arrays `fleet` and `quarantine` alone.
JsonPiece fleet_json(const LiveStatus& status);
JsonPiece quarantine_json(const std::vector<QuarantineStatus>& quarantine);
/// Reads the text of `to_json`, except the histograms. Errors: not such an object.
Expected<LiveStatus> live_status_of(const std::string& text);

}  // namespace swarmsmith
