#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/text/json.h"
#include "cli/output/query_output.h"
#include "coordinator/service/live_status.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// What the store says of its campaign now: head, designs, the last event.
struct StoredCampaignState {
  Rows campaign;  ///< name, digest, state, used, budget, a row a campaign
  Rows designs;   ///< as `live` has them
  std::string last_event;
  std::int64_t rejected = 0;                 ///< evaluations, as its events say
  std::vector<QuarantineStatus> quarantine;  ///< while no process writes the store
};

/// Errors: as a query's. `stages`: with where searches are that are no iterated races, which the
/// coordinator that runs them knows better.
Expected<StoredCampaignState> read_campaign_state(StoreReader& store, bool is_written, bool stages);

/// The element of `campaigns` of `live`. `now`: of the coordinator that runs it, null for none, and
/// `left_s` as seconds_left says. Nobody acts on campaigns that were merged or imported.
JsonObject campaign_json(const std::string& c, const std::filesystem::path& file,
                         const StoredCampaignState& state, const CampaignStatus* now, double left_s,
                         bool may_act);

/// Something that a person should know of, and the page that shows it: "fleet", "c1", "c1/d3".
struct Look {
  std::string text;
  std::string page;
};

/// Of the coordinator itself, worst first.
std::vector<Look> looks_of(const LiveStatus& status);
/// Of a campaign and its designs. `now`: as for campaign_json.
std::vector<Look> looks_of(const std::string& c, const StoredCampaignState& state,
                           const CampaignStatus* now);
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
