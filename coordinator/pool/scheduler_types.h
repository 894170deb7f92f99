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

/// What the scheduler sees of messages, and what it wants to be done: plain values.

/// A task that a worker says it has, and the lease by which it was given.
struct Hold {
  PackedKey key = 0;
  std::int64_t attempt = 0;
  std::uint64_t signature = 0;  ///< LeaseSigner; 0 from workers that do not know of it
};

/// How a worker introduces itself.
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
  std::string client;          ///< name of its key; empty without
  std::string address;         ///< as the transport sees it, a number without a port
  bool local = false;          ///< this process started it
  bool same_scenario = false;  ///< whether `holds` are of this campaign
  std::vector<Hold> holds;
};

/// The referee's word: what an evaluation gives in a process of the coordinator's own.
struct Ruling {
  enum class Kind {
    Score,
    Rejected,  ///< it has no score: an exception, not a number, or the death of the process
    TimedOut,  ///< it takes longer than the campaign allows
    NoWord,    ///< the referee cannot do its work, for a reason of the host
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

/// What a worker says of its slots, in microseconds since its welcome.
struct SlotReport {
  std::int64_t slot_us = 0;
  std::int64_t busy_us = 0;
};

/// Who sent a message, and as which of its messages.
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
  std::size_t bytes = 0;  ///< about, on the wire
};
/// The worker may forget these results: there is nothing to write for them.
struct SendAcknowledged {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
  std::vector<PackedKey> keys;
};
struct SendHeartbeat {
  PeerId peer = 0;
  std::uint64_t incarnation = 0;
};
/// What a person at the worker should know; it goes on.
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
/// A result that was known before, with the same bits or others.
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
  /// None: of the pool, and for the stores of all campaigns.
  std::optional<std::uint32_t> campaign;
  EventRow row;
  /// The principal whose doing it is; empty: it was decided here, and is always written.
  std::string source;
  std::int64_t worker = 0;  ///< that the text names
};
struct FailureKept {
  std::uint32_t campaign = 0;
  FailureRow row;
};
struct AttemptEnded {
  std::uint32_t campaign = 0;
  AttemptRow row;
};
/// Workers of the principal are in quarantine no longer.
struct Forgiven {
  std::string principal;
};
/// A campaign cannot go on.
struct StopCampaign {
  std::uint32_t campaign = 0;
  std::string reason;
  /// Scores in its store are wrong, or may be.
  bool distrusted = false;
};
/// The referee is to evaluate: the next one follows when `on_ruling` has told of this one.
struct AskReferee {
  Task task;
  Duration timeout{};
};

using SchedulerAction =
    std::variant<SendWelcome, SendReject, SendTasks, SendAcknowledged, SendHeartbeat, SendWhoAreYou,
                 SendDrain, OutcomeAccepted, OutcomeRepeated, TaskInDispute, ConflictFound,
                 WorkerChanged, Noted, FailureKept, AttemptEnded, StopCampaign, AskReferee,
                 SendNotice, Forgiven>;

/// What a campaign says of its evaluations.
struct CampaignPolicy {
  Duration task_timeout = std::chrono::seconds(30);
  std::int64_t retries = 2;      ///< after time-outs, before the campaign stops
  bool stop_on_failure = false;  ///< else an evaluation that fails for good is a rejection
  /// One evaluation of so many is made again by the referee, and the first ones of each principal
  /// before they count; 0: none. Programs are not audited.
  std::int64_t audit_every = 200;
};

struct SchedulerOptions {
  Duration heartbeat = std::chrono::seconds(1);
  Duration dead_after = std::chrono::seconds(5);
  Duration resend = std::chrono::seconds(10);
  /// A lease without progress expires after max(lease_floor, lease_factor * running estimate).
  Duration lease_floor = std::chrono::seconds(5);
  int lease_factor = 20;
  /// A task that is out longer than max(copy_floor, copy_factor * running estimate) goes to an idle
  /// slot elsewhere too. The floor is above what a task waits in a worker that has work for 20 ms.
  Duration copy_floor = std::chrono::milliseconds(100);
  int copy_factor = 4;
  /// A connection that breaks sooner than this after the last sign of life was closed by the death
  /// of its process; links die silently, and the transport needs 3 s to notice.
  Duration silence = std::chrono::milliseconds(2500);
  std::vector<CampaignPolicy> campaigns{CampaignPolicy{}};  ///< Task::campaign is an index
  /// Of all campaigns or of none: evaluations by programs: none is run a second time while a worker
  /// that runs it is alive, a first failure is final, and two results of one evaluation may differ.
  bool evaluates_programs = false;
  /// A principal that fails so often where others (with the simulator: the referee) succeed, and at
  /// one of twenty of its evaluations, gets no more.
  std::int64_t quarantine_after = 5;
  std::uint32_t max_credit = 4096;
  std::size_t max_workers = 10'000;
  std::size_t max_workers_of_one = 5'000;  ///< that one principal answers for
  LeaseSecret lease_secret{};
  std::vector<Quarantine> quarantined{};  ///< by an earlier process
  int engine_version = 0;
  std::string self_test;          ///< empty: that of the first worker
  std::int64_t first_worker = 1;  ///< number of the first worker that comes
};

/// Numbers for people, counted since the start.
struct SchedulerCounters {
  std::uint64_t done = 0;
  std::uint64_t rejected = 0;
  std::uint64_t failed = 0;  ///< attempts without a score
  std::uint64_t duplicates = 0;
  std::uint64_t conflicts = 0;
  std::uint64_t unknown = 0;   ///< results of tasks that were not asked for
  std::uint64_t unleased = 0;  ///< results of tasks that their senders were never given
  std::uint64_t expired = 0;
  std::uint64_t requeued = 0;
  std::uint64_t lost_workers = 0;
  std::uint64_t copies = 0;       ///< second leases of stragglers
  std::uint64_t ahead = 0;        ///< leases of look-ahead
  std::uint64_t audited = 0;      ///< results that the referee made again, to compare
  std::uint64_t rulings = 0;      ///< evaluations of the referee, audits included
  std::uint64_t quarantined = 0;  ///< principals, or processes without a key
  std::uint64_t reconnects = 0;   ///< hellos of workers that had been here before
};

}  // namespace swarmsmith
