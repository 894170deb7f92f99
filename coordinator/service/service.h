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
  /// Port * takes a free one. Empty: "tcp://127.0.0.1:*". Beyond loopback only with keys, or with
  /// `insecure_plaintext`.
  std::string bind;
  SocketOptions socket;
  std::optional<ServerKeys> keys{};
  /// Clients need no key, though other hosts can connect.
  bool insecure_plaintext = false;
  /// A new list of clients when there is one; asked ten times a second, and must not wait.
  std::function<std::optional<std::vector<ListedClient>>()> new_clients{};
  /// Makes the referee for a scenario; it calls the function, from any thread, when it has ruled.
  /// Empty: there is none, so that nothing is audited, and what needs one stops its campaign.
  std::function<std::unique_ptr<Referee>(const std::string& scenario, std::function<void()>)>
      make_referee{};
  /// How long running evaluations are waited for when the campaign is interrupted.
  Duration grace = std::chrono::seconds(5);
};

/// A campaign that is to be run; both must outlive the service.
struct ServiceCampaign {
  std::string digest;
  Store* store = nullptr;  ///< its listener is taken over
  WorkSource* source = nullptr;
  // For people.
  std::string name{};
  std::vector<DesignRow> designs{};
  std::filesystem::path file{};  ///< of the store; empty for none
  Searches searches{};
  double max_time = 0;  ///< as CampaignStatus has it
  bool costs = false;   ///< the same
};

struct ServiceHooks {
  /// Rows of a campaign, just before they are appended to its store; rows of the pool, which every
  /// store has, without a campaign and once.
  std::function<void(std::optional<std::size_t> campaign, std::span<const Row>)> on_rows;
  /// Ten times a second. May add what this process alone knows: `launcher`.
  std::function<void(LiveStatus&)> on_status;
};

struct ServiceEnd {
  enum class How {
    Finished,     ///< everything that was wanted is done and on disk
    Interrupted,  ///< asked to stop; what was accepted is on disk
    Stopped,      ///< the same, but some campaigns could not go on
  };
  How how = How::Finished;
  /// Of each campaign, why it could not go on; empty where it could.
  std::vector<std::string> reasons{};
  /// Of each campaign, what became of its store's file, where it was lost; empty where it was not.
  std::vector<std::string> lost{};
  /// Of each, whether it stopped because its stored scores are wrong, or may be.
  std::vector<bool> distrusted{};
  /// Of each, evaluations that were used and that its store could not write.
  std::vector<std::int64_t> unwritten{};
};

/// A coordinator's loop: socket, clock and stores around a Coordinator. One thread, that of `run`.
class Service {
 public:
  /// Errors: BadInput (no address, or one beyond loopback without keys), Conflict (the port is
  /// taken), Unavailable. The order of `campaigns` is that of the scenario and of the scheduler's
  /// policies.
  static Expected<std::unique_ptr<Service>> open(ServiceOptions options,
                                                 std::vector<ServiceCampaign> campaigns);
  virtual ~Service() = default;

  /// Where workers find it, with the real port.
  virtual const std::string& endpoint() const = 0;

  /// Until all campaigns are over or `stop` is requested: then nothing more is leased, running
  /// evaluations have the grace time, and the stores are flushed. When a store's file is lost, at
  /// once. Call once.
  virtual ServiceEnd run(const std::stop_token& stop, const ServiceHooks& hooks) = 0;
};

}  // namespace swarmsmith
