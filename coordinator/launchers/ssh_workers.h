#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/expected.h"
#include "base/process/child_process.h"
#include "coordinator/launchers/host_file.h"
#include "coordinator/launchers/launch_options.h"
#include "coordinator/launchers/launcher.h"
#include "coordinator/launchers/worker_bundle.h"

namespace swarmsmith {

struct SshWorkersOptions {
  std::vector<SshHost> hosts;
  std::vector<std::string> options;    ///< options for ssh, placed before the fixed ones
  WorkerAddress address;               ///< with the paths for hosts that do not set their own
  std::filesystem::path program;       ///< the same; empty: the result of `find_worker_program`
  std::vector<std::string> arguments;  ///< additional arguments for the worker
  /// Bundles to copy to hosts that lack one and whose line names no program; empty: none.
  std::vector<WorkerBundle> bundles{};
  std::string ssh = "ssh";
  /// The pause before a host is tried again; it doubles each time, up to `longest_pause`.
  Duration first_pause = std::chrono::seconds(1);
  Duration longest_pause = std::chrono::minutes(1);
};

/// The command line with which ssh starts a worker on a host. It contains no secrets.
std::vector<std::string> ssh_words(const SshWorkersOptions& options, const SshHost& host);

/// One worker on each host, each behind its own ssh process.
///
/// The worker watches its standard input, which ends when ssh ends, when this process ends, or when
/// the launcher stops; the worker then drains. So no worker is left behind on a host, whichever of
/// them dies; on a host that has lost its network, the worker ends after ten minutes. A terminal
/// (-tt) would kill the worker by a hangup instead of letting it drain.
///
/// Only a few logins are under way at a time: an sshd, which may be the one that gives access to
/// all hosts, rejects further ones (MaxStartups). In the status, a worker counts as running once it
/// reports that the coordinator has welcomed it.
///
/// With bundles, a host that lacks its bundle gets it through another ssh, and is then tried again.
/// Hosts may share the folder for bundles: the first transfer of each bundle must finish before
/// other hosts get it.
class SshWorkers final : public Launcher {
 public:
  static Expected<SshWorkers> start(SshWorkersOptions options);
  ~SshWorkers() override;
  SshWorkers(SshWorkers&&) noexcept = default;

  /// Errors: no host can have a worker (another build, no bundle for it, another program).
  std::string tend(TimePoint now) override;
  std::string stop(Duration grace) override;
  LauncherStatus status() const override;

 private:
  struct Worker {
    SshHost host;
    const WorkerBundle* sends = nullptr;  ///< the bundle that `ssh` is sending, or null
    const WorkerBundle* after = nullptr;  ///< waits for this bundle's transfer elsewhere
    bool sent = false;                    ///< whether the last successful action was the transfer
    ChildProcess ssh;
    TimePoint started;
    TimePoint start_at;
    Backoff backoff;
    int quick_ends = 0;      ///< ends without an error after a short life, in a row
    bool begun = false;      ///< whether the login has finished
    bool connected = false;  ///< to the coordinator, as reported by the worker
    std::string said;        ///< the last line of its output that is meant for people
    bool refused = false;    ///< refused for good
    std::string trouble;     ///< why it does not run
  };

  explicit SshWorkers(SshWorkersOptions options);
  void launch(Worker& worker, TimePoint now);
  void on_ended(Worker& worker, int status, TimePoint now);
  void on_sent(Worker& worker, bool well, TimePoint now);
  void hear(Worker& worker);
  /// Whether another login may begin.
  bool may_launch(TimePoint now) const;
  void on_lacking(Worker& worker, const WorkerBundle& bundle, TimePoint now);
  bool is_sent_now(const WorkerBundle* bundle) const;

  SshWorkersOptions options_;
  std::map<const WorkerBundle*, TimePoint> sent_;  ///< when the bundle was first sent to any host
  std::vector<Worker> workers_;
  int most_logins_;  ///< at the same time
};

}  // namespace swarmsmith
