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
  std::vector<std::string> options;    ///< words for ssh, before those that are always there
  WorkerAddress address;               ///< paths as they are on every host that has no others
  std::filesystem::path program;       ///< the same; empty: `find_worker_program`
  std::vector<std::string> arguments;  ///< more of them, for the worker
  /// Sent to hosts whose line names no program, if they have not got theirs yet; empty: none.
  std::vector<WorkerBundle> bundles{};
  std::string ssh = "ssh";
  /// Before a host is tried again; twice as long each time, up to `longest_pause`.
  Duration first_pause = std::chrono::seconds(1);
  Duration longest_pause = std::chrono::minutes(1);
};

/// The words with which ssh starts a worker on a host. Nothing secret is among them.
std::vector<std::string> ssh_words(const SshWorkersOptions& options, const SshHost& host);

/// One worker behind one ssh process on each host.
///
/// The worker watches its standard input, which ends with ssh, with this process, and when the
/// launcher stops: it then drains. So nothing stays behind on a host whichever of them dies; a host
/// that is cut off the network is left after ten minutes by the worker itself. A terminal (-tt)
/// would hang the worker up instead of letting it drain.
///
/// A few logins are under way at a time: an sshd, which may be the one that leads to all hosts,
/// turns others away (MaxStartups). A worker runs for `status` when it says that the coordinator
/// has welcomed it.
///
/// With bundles, a host that lacks its own gets it by another ssh, and is tried again. Hosts may
/// share the folder that it goes to: of each bundle, the first one is waited for by all others.
class SshWorkers final : public Launcher {
 public:
  static Expected<SshWorkers> start(SshWorkersOptions options);
  ~SshWorkers() override;
  SshWorkers(SshWorkers&&) noexcept = default;

  /// Trouble: no host will have a worker (another build, no bundle for it, another program).
  std::string tend(TimePoint now) override;
  std::string stop(Duration grace) override;
  LauncherStatus status() const override;

 private:
  struct Worker {
    SshHost host;
    const WorkerBundle* sends = nullptr;  ///< what `ssh` sends, in place of running a worker
    const WorkerBundle* after = nullptr;  ///< another host's is waited for
    bool sent = false;                    ///< the last thing that ended well was that
    ChildProcess ssh;
    TimePoint started;
    TimePoint start_at;
    Backoff backoff;
    int quick_ends = 0;      ///< without an error, after a short life, in a row
    bool begun = false;      ///< the login is over
    bool connected = false;  ///< to the coordinator, as the worker says
    std::string said;        ///< its last line that is for people
    bool refused = false;    ///< for good
    std::string trouble;     ///< why it does not run
  };

  explicit SshWorkers(SshWorkersOptions options);
  void launch(Worker& worker, TimePoint now);
  void on_ended(Worker& worker, int status, TimePoint now);
  void on_sent(Worker& worker, bool well, TimePoint now);
  void hear(Worker& worker);
  /// Whether one more login may begin.
  bool may_launch(TimePoint now) const;
  void on_lacking(Worker& worker, const WorkerBundle& bundle, TimePoint now);
  bool is_sent_now(const WorkerBundle* bundle) const;

  SshWorkersOptions options_;
  std::map<const WorkerBundle*, TimePoint> sent_;  ///< when it first was, to any host
  std::vector<Worker> workers_;
  int most_logins_;  ///< under way at a time
};

}  // namespace swarmsmith
