#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <queue>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/rng.h"
#include "coordinator/coordinator.h"
#include "tests/cluster/raced_campaign.h"
#include "tests/cluster/simulated_disk.h"
#include "worker/protocol.h"

namespace swarmsmith::cluster {

/// What goes wrong in a schedule, and how often. Everything stops at `until`, after which the
/// campaign must end.
struct Faults {
  double loss = 0;  ///< probability, a message
  double doubled = 0;
  double late = 0;  ///< delayed by seconds, so that later ones overtake
  int cuts = 0;     ///< of one worker's link, one or both ways
  int worker_crashes = 0;
  int worker_drains = 0;
  int coordinator_crashes = 0;
  int pauses = 0;          ///< of a process that lives on
  double slow_commit = 0;  ///< probability, a commit
  Duration until = std::chrono::seconds(0);
};

struct Schedule {
  std::uint64_t seed = 1;
  Faults faults;
  CampaignShape campaign;
};

/// A schedule out of a seed: some kinds of faults, rare or dense.
Schedule schedule_of(std::uint64_t seed);

/// Coordinator and three workers, the real races and protocol code, in one thread on a simulated
/// clock, network and disk. The same schedule gives the same events.
class SimulatedCluster {
 public:
  explicit SimulatedCluster(const Schedule& schedule);

  /// Runs until the campaign is over and every worker is quiet. What went wrong, as a sentence;
  /// empty when all is as it must be.
  std::string run();

  /// Events so far; for the tests' own sanity.
  std::uint64_t events() const { return order_; }
  int crashes() const { return crashes_; }
  /// Evaluations of the last coordinator that were made twice.
  std::uint64_t audited() const { return coordinator_->scheduler().counters().audited; }
  /// Evaluations that killed a worker.
  std::size_t killers() const { return killers_.size(); }

 private:
  static constexpr int kWorkers = 3;
  static constexpr int kCoordinator = -1;

  struct Event {
    TimePoint at;
    std::uint64_t order = 0;
    std::function<void()> what;
    bool operator<(const Event& other) const {
      return std::tie(other.at, other.order) < std::tie(at, order);
    }
  };
  /// A process that can die (its life counts up) and be stopped for a while.
  struct Process {
    int life = 0;
    bool alive = false;
    TimePoint paused_until;
    TimePoint cut_in_until;   ///< messages to it are lost
    TimePoint cut_out_until;  ///< messages from it are lost
  };
  struct Worker {
    Process process;
    std::unique_ptr<WorkerProtocol> protocol;
    int slots = 1;
    PeerId connection = 0;
    std::deque<WorkItem> waiting;
    int running = 0;
    TimePoint tick_at;
  };
  struct Connection {
    int worker = 0;
    int worker_life = 0;
    int coordinator_life = 0;
    bool open = true;
  };
  struct Batch {
    std::uint64_t ticket = 0;
    std::vector<Row> rows;
  };

  // Events.
  void at(TimePoint when, std::function<void()> what);
  void on_process(int process, Duration delay, std::function<void()> what);
  Process& process(int index);
  Duration between(Duration low, Duration high);
  void plan_faults();
  void fail(const std::string& what);

  // Network.
  void transmit(int from, int to, PeerId connection, std::string frame);
  void connect(int worker);
  void to_coordinator(int worker, std::string frame);
  SendStatus to_worker(PeerId peer, const std::string& frame);
  void check_acknowledged(const std::string& frame);

  // Coordinator and its disk.
  void start_coordinator();
  void crash_coordinator();
  void settle_coordinator();
  void tick_coordinator();
  void append(std::vector<Row> rows);
  void commit();
  void write(const std::vector<Row>& rows);
  void check_leases();
  void check_answer();

  // Workers.
  void start_worker(int index);
  void crash_worker(int index);
  void settle_worker(int index);
  void carry_out(int index, WorkerAction& action);
  void start_items(int index);
  void finish_item(int index, const WorkItem& item);
  void schedule_tick(int index);
  bool workers_are_quiet() const;

  Schedule schedule_;
  Rng rng_;
  TimePoint now_{std::chrono::seconds(1000)};
  TimePoint faults_end_;
  std::priority_queue<Event> queue_;
  std::uint64_t order_ = 0;
  std::string failure_;
  int crashes_ = 0;

  Process coordinator_process_;
  std::unique_ptr<RacedCampaign> campaign_;
  std::unique_ptr<Coordinator> coordinator_;
  SimulatedDisk disk_;
  std::deque<Batch> uncommitted_;
  std::uint64_t tickets_ = 0;
  TimePoint last_commit_;

  std::vector<Worker> workers_;
  std::set<PackedKey> failed_;   ///< said once to have no score
  std::set<PackedKey> killers_;  ///< killed a worker
  std::map<PeerId, Connection> connections_;
  PeerId peers_ = 0;
};

}  // namespace swarmsmith::cluster
