#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/design/work_source.h"
#include "coordinator/service/coordinator.h"
#include "coordinator/service/live_status.h"
#include "coordinator/service/referee.h"
#include "proto/socket.h"
#include "storage/store.h"

namespace swarmsmith {

struct ServiceOptions {
  CoordinatorOptions coordinator;
  /// The port * chooses a free port. Empty: "tcp://127.0.0.1:*". An address beyond loopback needs
  /// keys or `insecure_plaintext`.
  std::string bind;
  SocketOptions socket;
  std::optional<ServerKeys> keys{};
  /// Clients need no key, although other hosts can connect.
  bool insecure_plaintext = false;
  /// Returns a new list of clients if there is one; called ten times a second, and must not wait.
  std::function<std::optional<std::vector<ListedClient>>()> new_clients{};
  /// Makes the referee for a scenario; the referee calls the given function, from any thread, after
  /// each ruling. Empty: there is no referee, so nothing is audited, and a result that needs a
  /// ruling stops its campaign.
  std::function<std::unique_ptr<Referee>(const std::string& scenario, std::function<void()>)>
      make_referee{};
  /// How long to wait for running evaluations when the campaign is interrupted.
  Duration grace = std::chrono::seconds(5);
};

/// A campaign to run; the store and the source must outlive the service.
struct ServiceCampaign {
  std::string digest;
  Store* store = nullptr;  ///< the service installs its own listener
  WorkSource* source = nullptr;
  // For display only.
  std::string name{};
  std::vector<DesignRow> designs{};
  std::filesystem::path file{};  ///< the store's file; empty for none
  Searches searches{};
  double max_time = 0;  ///< as in CampaignStatus
  bool costs = false;   ///< as in CampaignStatus
};

struct ServiceHooks {
  /// Gets the rows of a campaign just before they are appended to its store. Rows of the pool,
  /// which every store gets, come once and without a campaign.
  std::function<void(std::optional<std::size_t> campaign, std::span<const Row>)> on_rows;
  /// Called ten times a second. May fill in `launcher`, which only the caller knows.
  std::function<void(LiveStatus&)> on_status;
};

struct ServiceEnd {
  enum class How {
    Finished,     ///< everything that the campaigns wanted is done and on disk
    Interrupted,  ///< stopped on request; everything that was accepted is on disk
    Stopped,      ///< as Finished or Interrupted, but some campaigns could not go on
  };
  How how = How::Finished;
  /// For each campaign, why it could not go on; empty if it could.
  std::vector<std::string> reasons{};
  /// For each campaign, what happened to its store's file if it was lost; else empty.
  std::vector<std::string> lost{};
  /// For each campaign, whether it stopped because its stored scores are wrong or may be wrong.
  std::vector<bool> distrusted{};
  /// For each campaign, the number of used evaluations that its store could not write.
  std::vector<std::int64_t> unwritten{};
};

/// The coordinator's event loop: socket, clock and stores around a Coordinator. Everything runs in
/// the thread that calls `run`.
class Service {
 public:
  /// Errors: BadInput (no address, or one beyond loopback without keys), Conflict (the port is
  /// taken), Unavailable. `campaigns` must have the same order as the scenario and the scheduler's
  /// policies.
  static Expected<std::unique_ptr<Service>> open(ServiceOptions options,
                                                 std::vector<ServiceCampaign> campaigns);
  virtual ~Service() = default;

  /// The address where workers connect, with the real port.
  virtual const std::string& endpoint() const = 0;

  /// Runs until all campaigns are over or `stop` is requested. Then it leases nothing more, gives
  /// running evaluations the grace time, and flushes the stores. If a store's file is lost, it ends
  /// at once. Call only once.
  virtual ServiceEnd run(const std::stop_token& stop, const ServiceHooks& hooks) = 0;
};

}  // namespace swarmsmith
