#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/clock.h"
#include "coordinator/design/task.h"
#include "coordinator/pool/lease_signer.h"
#include "coordinator/pool/task_key.h"
#include "proto/result.h"
#include "proto/socket.h"

namespace swarmsmith {

/// The scheduler's input from messages and its actions, as plain values.

/// A task that a worker reports, and the lease under which it got the task.
struct Hold {
  PackedKey key = 0;
  std::int64_t attempt = 0;
  std::uint64_t signature = 0;  ///< of LeaseSigner; 0 from workers that do not support it
};

/// The information with which a worker introduces itself.
struct WorkerHello {
  std::string identity;  ///< 16 bytes
  std::uint64_t incarnation = 0;
  std::string build;
  int engine_version = 0;
  std::string self_test;
  int slots = 1;
  std::string host;
  std::int64_t pid = 0;
  std::string job;
  std::string cpu;
  std::string client;          ///< name of its key; empty without one
  std::string address;         ///< as the transport reports it, a number without a port
  bool local = false;          ///< whether this process started it
  bool same_scenario = false;  ///< whether `holds` belong to this scenario
  std::vector<Hold> holds;
};

/// The referee's answer: the result of an evaluation in the coordinator's own child process.
struct Ruling {
  enum class Kind {
    Score,
    Rejected,  ///< there is no score: an exception, not a number, or the death of the process
    TimedOut,  ///< it takes longer than the campaign allows
    NoWord,    ///< the referee cannot work, because of a problem with the host
  };
  PackedKey key = 0;
  Kind kind = Kind::Score;
  Measured measured{};
  std::string reason{};  ///< a sentence, unless there is a score
};

struct RunningReport {
  PackedKey key = 0;
  std::int64_t elapsed_ms = 0;
};

/// A worker's report about its slots, in microseconds since its welcome.
struct SlotReport {
  std::int64_t slot_us = 0;
  std::int64_t busy_us = 0;
};

/// The sender of a message, and the message's number.
struct Sender {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
  std::uint64_t sequence = 0;
};

enum class RejectReason { Protocol, Build, Limit };

/// Actions. `incarnation` is that of the worker's last hello.
struct SendWelcome {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
};
struct SendReject {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
  RejectReason reason = RejectReason::Protocol;
  std::string sentence;
};
struct SendTasks {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
  std::vector<LeasedTask> tasks;
  std::size_t bytes = 0;  ///< approximate size on the network
};
/// The worker may forget these results: no rows are written for them.
struct SendAcknowledged {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
  std::vector<PackedKey> keys;
};
struct SendHeartbeat {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
};
/// A message for the person who runs the worker; the worker continues.
struct SendNotice {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
  std::string sentence;
};
struct SendWhoAreYou {
  PeerId peer = 0;
};
struct SendDrain {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
};
/// The first outcome of a task.
struct OutcomeAccepted {
  Outcome outcome;
};
/// A repeated result, with the same bits as the first one or others.
struct OutcomeRepeated {
  PackedKey key = 0;
  std::int64_t worker = 0;
};
/// Two results differ: `Scheduler::on_disputed` needs the task.
struct TaskInDispute {
  std::uint32_t campaign = 0;
  EvaluationKey key;
};
struct ConflictFound {
  std::uint32_t campaign = 0;
  ConflictRow row;
};
struct WorkerChanged {
  WorkerRow row;
};
struct Noted {
  /// None: it belongs to the pool, and the stores of all campaigns get it.
  std::optional<std::uint32_t> campaign;
  EventRow row;
  /// The principal that caused it; empty: a decision made here, which is always written.
  std::string source;
  std::int64_t worker = 0;  ///< the worker named in the text
};
struct FailureKept {
  std::uint32_t campaign = 0;
  FailureRow row;
};
struct AttemptEnded {
  std::uint32_t campaign = 0;
  AttemptRow row;
};
/// Workers of the principal are no longer in quarantine.
struct Forgiven {
  std::string principal;
};
/// The campaign cannot go on.
struct StopCampaign {
  std::uint32_t campaign = 0;
  std::string reason;
  /// Scores in its store are wrong or may be wrong.
  bool distrusted = false;
};
/// The referee must evaluate this task; the next one follows after `on_ruling` for this one.
struct AskReferee {
  Task task;
  Duration timeout{};
};

using SchedulerAction =
    std::variant<SendWelcome, SendReject, SendTasks, SendAcknowledged, SendHeartbeat, SendWhoAreYou,
                 SendDrain, OutcomeAccepted, OutcomeRepeated, TaskInDispute, ConflictFound,
                 WorkerChanged, Noted, FailureKept, AttemptEnded, StopCampaign, AskReferee,
                 SendNotice, Forgiven>;

/// A campaign's settings for its evaluations.
struct CampaignPolicy {
  Duration task_timeout = std::chrono::seconds(30);
  std::int64_t retries = 2;      ///< retries after time-outs, before the campaign stops
  bool stop_on_failure = false;  ///< otherwise an evaluation that fails for good counts as a
                                 ///< rejection
  /// The referee repeats one of this many evaluations, and also the first ones of each principal
  /// before they count; 0: none. Evaluations by programs are not audited.
  std::int64_t audit_every = 200;
};

struct SchedulerOptions {
  Duration heartbeat = std::chrono::seconds(1);
  Duration dead_after = std::chrono::seconds(5);
  Duration resend = std::chrono::seconds(10);
  /// A lease without progress expires after max(lease_floor, lease_factor * running estimate).
  Duration lease_floor = std::chrono::seconds(5);
  int lease_factor = 20;
  /// A task that is leased for longer than max(copy_floor, copy_factor * running estimate) is
  /// copied to an idle slot of another worker. The floor is longer than a task waits in a worker
  /// that has work for 20 ms.
  Duration copy_floor = std::chrono::milliseconds(100);
  int copy_factor = 4;
  /// If a connection closes sooner than this after the last sign of life, its process has died;
  /// broken links are silent, and the transport needs 3 s to notice them.
  Duration silence = std::chrono::milliseconds(2500);
  std::vector<CampaignPolicy> campaigns{CampaignPolicy{}};  ///< Task::campaign is an index
  /// Whether programs evaluate, for all campaigns or none. Then no evaluation is repeated while a
  /// worker that runs it is alive, the first failure is final, and two results may differ.
  bool evaluates_programs = false;
  /// A principal that fails this often where others (with the simulator: the referee) succeed, and
  /// in at least one of twenty of its evaluations, gets no more tasks.
  std::int64_t quarantine_after = 5;
  std::uint32_t max_credit = 4096;
  std::size_t max_workers = 10'000;
  std::size_t max_workers_of_one = 5'000;  ///< for each principal
  LeaseSecret lease_secret{};
  std::vector<Quarantine> quarantined{};  ///< by an earlier process
  int engine_version = 0;
  std::string self_test;          ///< empty: the value of the first worker
  std::int64_t first_worker = 1;  ///< number for the first worker
};

/// Counters for people, since the start.
struct SchedulerCounters {
  std::uint64_t done = 0;
  std::uint64_t rejected = 0;
  std::uint64_t failed = 0;  ///< attempts without a score
  std::uint64_t duplicates = 0;
  std::uint64_t conflicts = 0;
  std::uint64_t unknown = 0;   ///< results of tasks that do not exist
  std::uint64_t unleased = 0;  ///< results of tasks that were never leased to their senders
  std::uint64_t expired = 0;
  std::uint64_t requeued = 0;
  std::uint64_t lost_workers = 0;
  std::uint64_t copies = 0;       ///< second leases because the first worker was slow
  std::uint64_t ahead = 0;        ///< leases of look-ahead tasks
  std::uint64_t audited = 0;      ///< results that the referee evaluated again for comparison
  std::uint64_t rulings = 0;      ///< evaluations of the referee, including audits
  std::uint64_t quarantined = 0;  ///< principals, or processes of principals without a key
  std::uint64_t reconnects = 0;   ///< hellos of workers that had connected before
};

}  // namespace swarmsmith
