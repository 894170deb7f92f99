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

/// What only the store knows of a design.
struct StoredDesign {
  std::optional<std::int64_t> alive;
  std::int64_t version = 0;  ///< moves with all that pages show of it
};

/// The campaigns of a store as they are now: several in a merged store.
struct StoredCampaignState {
  std::vector<CampaignStatus> campaigns;
  bool is_live = false;  ///< told by the coordinator that runs it
  std::string digest;    ///< of the only campaign
  std::map<DesignId, StoredDesign> designs;
  std::int64_t last_event = 0;
  std::int64_t rejected = 0;                 ///< evaluations, as its events say
  std::vector<QuarantineStatus> quarantine;  ///< while no process writes the store
};

/// `now`: what the coordinator that runs it says; null for none, and then from the store. Errors:
/// as a query's.
Expected<StoredCampaignState> read_campaign_state(StoreReader& store, bool is_written,
                                                  const CampaignStatus* now);

/// The element of `campaigns` of `live`. `left_s`: as seconds_left says. There are no acts on
/// campaigns that were merged or imported.
JsonObject campaign_json(const std::string& c, const std::filesystem::path& file,
                         const StoredCampaignState& state, double left_s, bool may_act);

/// Something that a person should know of, and the page that shows it: "fleet", "c1", "c1/d3".
struct Look {
  std::string text;
  std::string page;
};

/// Of the coordinator itself, worst first.
std::vector<Look> looks_of(const LiveStatus& status);
/// Of a campaign and its designs.
std::vector<Look> looks_of(const std::string& c, const StoredCampaignState& state);
/// [{"text":"2 workers lost","page":"fleet"}].
JsonPiece looks_json(const std::vector<Look>& looks);

/// {"v":1,"causes":[{"name":"barrier","why":"...","todo":"..."}]}: why slots idle, and what a
/// person can do.
JsonObject causes_json();

/// Numbers of the last minutes, hours and day, since the process began: evaluations have no time in
/// the store.
class History {
 public:
  using Time = std::chrono::system_clock::time_point;

  /// At most once a second is kept.
  void add(const LiveStatus& status, Time now);
  /// {"v":1,"t_s":[...], ...}: the newest, a second apart at the end, a minute at the beginning.
  /// `after`: only later ones.
  JsonObject json(double after_s) const;

 private:
  struct Sample {
    double at_s = 0;  ///< since 1970
    double evaluations_per_s = 0;
    SlotTimes times;  ///< of the span before, shares of it
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
