#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/rng.h"
#include "coordinator/service/coordinator.h"
#include "tests/cluster/raced_campaign.h"
#include "tests/cluster/simulated_disk.h"
#include "tests/support/hostile_peer.h"
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
  int early_drains = 0;  ///< of a worker that has just started
  int coordinator_crashes = 0;
  int pauses = 0;          ///< of a process that lives on
  double slow_commit = 0;  ///< probability, a commit
  int commands = 0;        ///< of a person who pauses and resumes designs
  int forgivings = 0;      ///< of a person who lets hostile peers work again
  int clock_steps = 0;     ///< of one process's clock, by up to a minute, forwards or back
  int total_crashes = 0;   ///< of coordinator and workers at once
  int full_disks = 0;      ///< for up to 20 s nothing can be committed
  int flaps = 0;           ///< a worker's link goes down and up ten times
  int visits = 0;          ///< of an ordinary client that opens, reads and closes the stores
  Duration until = std::chrono::seconds(0);
};

struct Schedule {
  std::uint64_t seed = 1;
  Faults faults;
  CampaignShape campaign;
  /// A second campaign in the same pool.
  std::optional<CampaignShape> other{};
  bool slow_worker = false;  ///< one of them takes a hundred times as long
  /// Peers that are not workers, until the faults end.
  std::vector<Misdeed> hostile{};
  bool keys = false;  ///< the workers have one key, and all hostile peers another
  std::int64_t audit_every = 10;
  /// The coordinator opens and closes its stores beside SQLite, as it once did after a crash.
  bool closes_beside = false;
};

/// A schedule out of a seed: some kinds of faults, rare or dense.
Schedule schedule_of(std::uint64_t seed);

/// The same with hostile peers, beside faults or none.
Schedule hostile_schedule_of(std::uint64_t seed);

/// What the simulated workers are sent, and know again.
inline constexpr const char* kScenario = "scenario";

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
  /// Until all campaigns were over.
  Duration took() const { return over_ - begun_; }
  /// How often hostile peers did what they are after.
  std::uint64_t acts(Misdeed misdeed) const;
  /// How often a person ended a quarantine.
  int forgiven() const { return forgiven_; }
  /// Why the campaign says that its answer cannot be had; empty when it came to its end.
  const std::string& stopped() const { return stopped_; }
  /// Wrong scores that are on disk.
  std::size_t lies() const { return lies_.size(); }
  /// Whether the answer is wrong by lies that no audit chose.
  bool escaped() const { return escaped_; }
  /// What the schedulers did, those of coordinators that crashed included.
  const SchedulerCounters& counters() const { return counters_; }

 private:
  static constexpr int kWorkers = 3;
  static constexpr int kCoordinator = -1;
  static constexpr int kNoWorker = -2;
  static constexpr PeerId kPerson = 1'000'000'000;

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
    Duration skew{0};         ///< its host's clock less the true time
  };
  struct Worker {
    Process process;
    std::unique_ptr<WorkerProtocol> protocol;
    int slots = 1;
    int slowness = 1;
    int early_drains = 0;  ///< that are to come
    PeerId connection = 0;
    std::deque<LeasedTask> waiting;
    int running = 0;
    TimePoint tick_at;
  };
  struct Stranger {
    HostilePeer peer;
    PeerId connection = 0;
  };
  struct Connection {
    int worker = 0;  ///< kNoWorker: a stranger's
    std::size_t stranger = 0;
    int worker_life = 0;
    int coordinator_life = 0;
    bool open = true;
    int unread = 0;  ///< frames that the coordinator has not read yet
    /// When the last frame arrives there, and here, of those that are not late.
    TimePoint to_coordinator;
    TimePoint to_worker;
  };
  struct Batch {
    std::uint64_t ticket = 0;
    std::vector<Row> rows;
  };
  /// A campaign, and the disk with its store.
  struct Running {
    CampaignShape shape;
    SimulatedDisk disk{};
    std::unique_ptr<RacedCampaign> source{};
    std::deque<Batch> uncommitted{};
    std::uint64_t tickets = 0;
    TimePoint last_commit{};
    std::map<PackedKey, Truth> truths{};  ///< of all that was ever asked for; without the campaign
  };

  // Events.
  void at(TimePoint when, std::function<void()> what);
  void on_process(int process, Duration delay, std::function<void()> what);
  Process& process(int index);
  Duration between(Duration low, Duration high);
  TimePoint clock(int index) { return now_ + process(index).skew; }
  void plan_faults();
  void plan_commands();
  void command(pb::Command_Kind kind, std::int64_t design);
  void resume_all();
  void forgive();
  void drain_worker(int worker, Duration after);
  void flap(int worker, int times);
  void fail(const std::string& what);

  // Network.
  void transmit(int from, int to, PeerId connection, std::string frame);
  void connect(int worker);
  void to_coordinator(int worker, std::string frame);
  SendStatus to_worker(PeerId peer, const std::string& frame);
  void frame_arrives(const Peer& peer, const std::string& frame);
  bool judge_gone();
  void check_acknowledged(const std::string& frame);
  void check_confirmed(const std::string& frame);
  void check_promises();

  // Coordinator and its disk.
  void start_coordinator();
  void crash_coordinator();
  void settle_coordinator();
  void judge(const AskReferee& ask);
  void tick_coordinator();
  void append(std::uint32_t campaign, std::vector<Row> rows);
  void commit(std::uint32_t campaign);
  void write(Running& running, const std::vector<Row>& rows);
  void check_leases();
  void check_slot_times();
  void check_answer(Running& running);
  void count();

  // Strangers.
  void invite_strangers();
  void visit(std::size_t index);
  void tick_stranger(std::size_t index);
  void settle_stranger(std::size_t index);
  void hang_up(std::size_t index);
  void cut_strangers_off();
  bool is_stranger(PeerId peer) const { return connections_.at(peer).worker == kNoWorker; }
  void note_leases_of_strangers(const std::string& frame);
  void to_stranger(PeerId peer, const std::string& frame);
  Peer stranger_at(PeerId connection) const;
  Peer worker_at(PeerId connection) const;
  void check_row(const Running& running, const Row& row);
  void check_trust();
  void on_stopped(const std::string& reason, bool distrusted);
  bool is_excused();

  // Workers.
  void start_worker(int index);
  void crash_worker(int index);
  void settle_worker(int index);
  void carry_out(int index, WorkerAction& action);
  void start_items(int index);
  void finish_item(int index, const LeasedTask& item);
  void schedule_tick(int index);
  bool workers_are_quiet() const;

  Schedule schedule_;
  Rng rng_;
  TimePoint now_{std::chrono::seconds(1000)};
  TimePoint begun_ = now_;
  TimePoint over_;
  TimePoint faults_end_;
  std::priority_queue<Event> queue_;
  std::uint64_t order_ = 0;
  std::string failure_;
  int crashes_ = 0;
  int forgiven_ = 0;
  SchedulerCounters counters_;

  Process coordinator_process_;
  std::vector<Running> campaigns_;
  std::unique_ptr<Coordinator> coordinator_;
  TimePoint disk_full_until_;

  std::vector<Stranger> strangers_;
  std::set<PackedKey> leased_to_strangers_;
  std::set<PackedKey> lies_;  ///< on disk
  std::string stopped_;
  bool escaped_ = false;
  bool left_out_audits_ = false;
  std::vector<Worker> workers_;
  std::set<PackedKey> failed_;  ///< said once to have no score
  std::set<PackedKey> acknowledged_;
  std::size_t confirmed_ = 0;    ///< commands on disk when the last one was confirmed
  std::set<PackedKey> killers_;  ///< killed a worker
  std::map<PeerId, Connection> connections_;
  PeerId peers_ = 0;
  std::set<PeerId> gone_;  ///< a frame could not be sent to them
};

}  // namespace swarmsmith::cluster
