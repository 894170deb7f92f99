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

/// How fast a count grows.
class RateWindow {
 public:
  explicit RateWindow(Duration window) : window_(window) {}

  /// Growth a second over the window, or over less while it is not full; 0 for the first point.
  double update(TimePoint now, std::int64_t count);

 private:
  Duration window_;
  std::deque<std::pair<TimePoint, std::int64_t>> points_;
};

/// What a campaign is when it starts.
struct TelemetryCampaign {
  std::string name;
  std::vector<DesignRow> designs;
  // Of its store.
  std::vector<DesignStateRow> states;
  std::vector<TestedDesign> tested{};
  std::vector<CommandRow> commands{};
  Searches searches{};
  double max_time = 0;  ///< as CampaignStatus has it
  bool costs = false;   ///< the same
};

/// The live numbers that a coordinator's loop adds to those of the Coordinator: they come from
/// rows, frames and commits as they pass. Time comes in, so that it can be tested.
class Telemetry {
 public:
  Telemetry(const std::vector<TelemetryCampaign>& campaigns, TimePoint start);

  void on_frame_in(std::size_t bytes) { bytes_in_ += static_cast<std::int64_t>(bytes); }
  void on_frame_out(std::size_t bytes) { bytes_out_ += static_cast<std::int64_t>(bytes); }
  void on_rows(std::size_t index, std::span<const Row> rows, TimePoint now);
  /// A unit of rows got its ticket from the writer.
  void on_appended(std::size_t index, std::uint64_t ticket, TimePoint now);
  void on_committed(std::size_t index, std::uint64_t ticket, TimePoint now);
  void set_wal_bytes(std::size_t index, std::int64_t bytes);
  /// Empty: well again.
  void set_trouble(std::size_t index, const std::string& trouble);

  /// Units of rows that no writer has committed.
  std::size_t queued_units() const;
  /// The coordinator's status with everything in it; the lists are renewed once a second, or when
  /// `all` of it is asked for.
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
