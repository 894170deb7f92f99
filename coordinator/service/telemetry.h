#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/service/coordinator.h"
#include "coordinator/service/live_status.h"
#include "coordinator/service/progress_model.h"
#include "storage/rows.h"

namespace swarmsmith {

/// The rate at which a count grows.
class RateWindow {
 public:
  explicit RateWindow(Duration window) : window_(window) {}

  /// Growth per second over the window, or over a shorter time at first; 0 for the first point.
  double update(TimePoint now, std::int64_t count);

 private:
  Duration window_;
  std::deque<std::pair<TimePoint, std::int64_t>> points_;
};

/// A campaign as it starts.
struct TelemetryCampaign {
  std::string name;
  std::vector<DesignRow> designs;
  // From its store.
  std::vector<DesignStateRow> states;
  std::vector<TestedDesign> tested{};
  std::vector<CommandRow> commands{};
  Searches searches{};
  double max_time = 0;  ///< as in CampaignStatus
  bool costs = false;   ///< as in CampaignStatus
};

/// The live numbers that the event loop adds to the Coordinator's own numbers: it counts rows,
/// frames and commits. Callers pass the time in, so that tests can control it.
class Telemetry {
 public:
  Telemetry(const std::vector<TelemetryCampaign>& campaigns, TimePoint start);

  void on_frame_in(std::size_t bytes) { bytes_in_ += static_cast<std::int64_t>(bytes); }
  void on_frame_out(std::size_t bytes) { bytes_out_ += static_cast<std::int64_t>(bytes); }
  void on_rows(std::size_t index, std::span<const Row> rows, TimePoint now);
  /// The writer has given a unit of rows its ticket.
  void on_appended(std::size_t index, std::uint64_t ticket, TimePoint now);
  void on_committed(std::size_t index, std::uint64_t ticket, TimePoint now);
  void set_wal_bytes(std::size_t index, std::int64_t bytes);
  /// An empty `trouble` means that all is well again.
  void set_trouble(std::size_t index, const std::string& trouble);

  /// The number of row units that are not committed yet.
  std::size_t queued_units() const;
  /// The coordinator's status, with all numbers filled in. The lists are refreshed once a second,
  /// or on every call with `all`.
  LiveStatus status(const Coordinator& coordinator, TimePoint now, bool all = false);

 private:
  struct Campaign {
    ProgressModel progress;
    CampaignStatus status{};
    std::map<DesignId, TimePoint> last_step{};
    std::deque<std::pair<std::uint64_t, TimePoint>> uncommitted{};
  };

  void renew_lists(const Coordinator& coordinator, TimePoint now);

  std::vector<Campaign> campaigns_;
  TimePoint start_;
  TimePoint renewed_;
  std::int64_t bytes_in_ = 0;
  std::int64_t bytes_out_ = 0;
  RateWindow done_{std::chrono::seconds(3)};
  RateWindow used_{std::chrono::minutes(1)};
  std::shared_ptr<const std::vector<WorkerStatus>> fleet_;
  std::shared_ptr<const std::vector<CampaignStatus>> lists_;
};

}  // namespace swarmsmith
