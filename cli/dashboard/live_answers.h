#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/json.h"
#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The facts about a design that only the store has.
struct StoredDesign {
  std::optional<std::int64_t> alive;
  std::int64_t version = 0;  ///< changes with everything that the pages show of the design
};

/// The current state of the campaigns of a store; a merged store has several.
struct StoredCampaignState {
  std::vector<CampaignStatus> campaigns;
  bool is_live = false;  ///< the state comes from the coordinator that runs it
  std::string digest;    ///< of the campaign, if there is only one
  std::map<DesignId, StoredDesign> designs;
  std::int64_t last_event = 0;
  std::int64_t rejected = 0;                 ///< rejected evaluations, from the store's events
  std::vector<QuarantineStatus> quarantine;  ///< read only if no process is writing the store
};

/// `now`: the status from the coordinator that runs the campaign; null if there is none, and then
/// the state is read from the store. Errors: as for a query.
Expected<StoredCampaignState> read_campaign_state(StoreReader& store, bool is_written,
                                                  const CampaignStatus* now);

/// An element of `campaigns` in the answer `live`. `left_s`: from seconds_left. Campaigns that were
/// merged or imported offer no commands.
JsonObject campaign_json(const std::string& c, const std::filesystem::path& file,
                         const StoredCampaignState& state, double left_s, bool may_act);

/// A problem that the user should know about, and the page that shows it: "fleet", "c1", "c1/d3".
struct Look {
  std::string text;
  std::string page;
};

/// Problems of the coordinator itself, worst first.
std::vector<Look> looks_of(const LiveStatus& status);
/// Problems of a campaign and its designs.
std::vector<Look> looks_of(const std::string& c, const StoredCampaignState& state);
/// [{"text":"2 workers lost","page":"fleet"}].
JsonPiece looks_json(const std::vector<Look>& looks);

/// {"v":1,"causes":[{"name":"barrier","why":"...","todo":"..."}]}: the reasons why slots are idle,
/// and what the user can do.
JsonObject causes_json();

/// Measurements of the last minutes, hours and day since the process began. They are kept here
/// because the store has no times of evaluations.
class History {
 public:
  using Time = std::chrono::system_clock::time_point;

  /// Keeps at most one sample per second.
  void add(const LiveStatus& status, Time now);
  /// {"v":1,"t_s":[...], ...}: the newest samples, one per second for the latest and one per minute
  /// for the oldest. `after`: only samples after this time.
  JsonObject json(double after_s) const;

 private:
  struct Sample {
    double at_s = 0;  ///< seconds since 1970
    double evaluations_per_s = 0;
    SlotTimes times;  ///< shares of slot time since the sample before
    std::int64_t slots = 0;
    std::int64_t ready = 0;
    std::int64_t uncommitted = 0;
  };
  struct Ring {
    double apart_s;
    std::size_t most;
    std::deque<Sample> samples{};
    SlotTimes before{};  ///< at the last sample
    std::int64_t done_before = 0;
  };

  std::vector<Ring> rings_{{1, 600}, {10, 720}, {60, 1440}};
};

}  // namespace swarmsmith::cli
