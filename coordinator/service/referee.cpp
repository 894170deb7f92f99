#include "coordinator/service/referee.h"

#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <deque>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "base/process/child_process.h"
#include "base/text/toml_text.h"
#include "coordinator/launchers/worker_program.h"
#include "coordinator/pool/event_text.h"
#include "coordinator/pool/task_key.h"
#include "coordinator/service/messages.h"
#include "proto/frame_pipe.h"
#include "proto/task_messages.h"
#include "proto/wire.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

/// Limit for the start of the process and its self test, on a busy host.
constexpr auto kReadyWithin = std::chrono::seconds(120);
constexpr int kTries = 3;
/// After this many deaths by its own fault, the evaluation is to blame.
constexpr int kFaults = 2;

/// Whether the program's own fault raises this signal, as opposed to another process.
bool is_fault(int signal) {
  return signal == SIGSEGV || signal == SIGABRT || signal == SIGBUS || signal == SIGFPE ||
         signal == SIGILL || signal == SIGTRAP || signal == SIGSYS;
}

std::string text_of_end(int status) {
  if (WIFSIGNALED(status)) {
    return std::string("was ended by signal ") + std::to_string(WTERMSIG(status)) + " (" +
           strsignal(WTERMSIG(status)) + ")";
  }
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

class ProcessReferee final : public Referee {
 public:
  explicit ProcessReferee(RefereeOptions options)
      : options_(std::move(options)), thread_([this] { work(); }) {}

  ~ProcessReferee() override {
    {
      const std::scoped_lock lock(mutex_);
      stopping_ = true;
      child_.signal(SIGKILL);
    }
    asked_.notify_one();
    thread_.join();
  }

  void judge(AskReferee ask) override {
    {
      const std::scoped_lock lock(mutex_);
      asks_.push_back(std::move(ask));
    }
    asked_.notify_one();
  }

  std::vector<Ruling> take_rulings() override {
    const std::scoped_lock lock(mutex_);
    return std::exchange(rulings_, {});
  }

 private:
  /// The result of one try: a ruling, or how the process ended.
  struct Try {
    std::optional<Ruling> ruling{};
    bool began = false;
    int status = 0;
    std::string trouble{};
  };

  /// Runs in its own thread, because it waits for the process, which dies with this thread.
  void work() {
    // The end of the process is then noticed by an error of write, instead of by SIGPIPE.
    sigset_t pipes;
    sigemptyset(&pipes);
    sigaddset(&pipes, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipes, nullptr);
    while (true) {
      AskReferee ask;
      {
        std::unique_lock lock(mutex_);
        asked_.wait(lock, [this] { return stopping_ || !asks_.empty(); });
        if (stopping_) break;
        ask = std::move(asks_.front());
        asks_.pop_front();
      }
      Ruling ruling = rule_on(ask);
      ruling.key = key_of(ask.task);
      {
        const std::scoped_lock lock(mutex_);
        if (stopping_) break;
        rulings_.push_back(std::move(ruling));
      }
      if (options_.on_ruling) options_.on_ruling();
    }
    end_child();
  }

  bool stopping() {
    const std::scoped_lock lock(mutex_);
    return stopping_;
  }

  Ruling rule_on(const AskReferee& ask) {
    int faults = 0;
    std::string trouble;
    for (int tries = 0; tries < kTries && !stopping(); ++tries) {
      Try one = attempt(ask);
      if (one.ruling) return std::move(*one.ruling);
      trouble = one.trouble;
      const bool is_its_own =
          one.began && WIFSIGNALED(one.status) && is_fault(WTERMSIG(one.status));
      if (is_its_own && ++faults == kFaults) {
        return {.kind = Ruling::Kind::Rejected,
                .reason = "its evaluation kills the process, which " + trouble};
      }
    }
    return {.kind = Ruling::Kind::NoWord, .reason = trouble};
  }

  Try attempt(const AskReferee& ask) {
    if (auto ready = be_ready(); !ready) return {.trouble = to_string(ready.error())};
    google::protobuf::Arena arena;
    SendTasks tasks;
    tasks.tasks.push_back({ask.task, key_of(ask.task), 1});
    std::string frame = frame_of(tasks, {}, arena);
    Try one;
    if (!write_frame(child_.input(), frame)) return ended(false);
    // `began` comes after the process has parsed the scenario, so the time limit of the evaluation
    // counts from there.
    const SteadyTime begun = std::chrono::steady_clock::now();
    if (read_frame_until(child_.output(), kMaxFrameBytes, frame, begun + kReadyWithin) !=
        PipeRead::Frame) {
      return ended(false);
    }
    switch (read_frame_until(child_.output(), kMaxFrameBytes, frame,
                             std::chrono::steady_clock::now() + ask.timeout)) {
      case PipeRead::Frame:
        break;
      case PipeRead::Ended:
        return ended(true);
      case PipeRead::TimedOut:
        end_child();
        return {.ruling = timed_out(ask)};
    }
    return understood(frame);
  }

  Try understood(const std::string& frame) {
    google::protobuf::Arena arena;
    const auto message = decode_to_coordinator(frame, arena);
    if (!message || (*message)->results().results_size() != 1) {
      end_child();
      return {.trouble = "the referee's process sent an unknown message"};
    }
    const Result result = result_of((*message)->results().results(0));
    // Lack of memory is a problem of the host, not of the evaluation.
    if (result.failure == std::bad_alloc().what()) {
      end_child();
      return {.trouble = "this host has too little memory for it"};
    }
    if (!result.failure.empty() || result.rejected) {
      return {.ruling = Ruling{.kind = Ruling::Kind::Rejected, .reason = result.failure}};
    }
    return {.ruling = Ruling{.measured = result.measured}};
  }

  static Ruling timed_out(const AskReferee& ask) {
    const std::chrono::duration<double> limit = ask.timeout;
    return {.kind = Ruling::Kind::TimedOut,
            .reason = "the evaluation of " + name_of(ask.task.key) + " took longer than " +
                      number_text(limit.count()) +
                      " s, on this host itself too: raise `timeout` in [workers] of the campaign's "
                      "file"};
  }

  /// Makes sure that a process is running and waits for tasks.
  Expected<void> be_ready() {
    if (child_.runs()) return {};
    std::filesystem::path program = options_.program;
    if (program.empty()) {
      Expected<std::filesystem::path> found = find_worker_program();
      if (!found) return Unexpected(found.error());
      program = std::move(*found);
    }
    {
      const std::scoped_lock lock(mutex_);
      if (stopping_) return unexpected(ErrorKind::Unavailable, "this program ends", "referee");
      const auto started = child_.start({program.string(), "--referee", "--die-with-parent",
                                         "--parent", std::to_string(getpid())},
                                        ChildProcess::Streams::Spoken);
      if (!started) return started;
    }
    std::string frame;
    if (read_frame_until(child_.output(), kMaxFrameBytes, frame,
                         std::chrono::steady_clock::now() + kReadyWithin) != PipeRead::Frame) {
      return unexpected(ErrorKind::Unavailable, ended(false).trouble, program.string());
    }
    if (!is_ours(frame)) {
      end_child();
      return unexpected(ErrorKind::Conflict,
                        "it is another build: its self test gives other bits; install it again",
                        program.string());
    }
    PoolFacts facts;
    facts.scenario = options_.scenario;
    if (!write_frame(child_.input(), scenario_reply_of(facts, 1))) {
      return unexpected(ErrorKind::Unavailable, ended(false).trouble, program.string());
    }
    return {};
  }

  bool is_ours(const std::string& frame) const {
    google::protobuf::Arena arena;
    const auto message = decode_to_coordinator(frame, arena);
    return message && (*message)->has_hello() &&
           (*message)->hello().engine_version() == options_.engine_version &&
           (*message)->hello().self_test() == options_.self_test;
  }

  /// The result of a try whose process sends nothing any more.
  Try ended(bool began) {
    const std::scoped_lock lock(mutex_);
    std::optional<int> status;
    const SystemClock clock;
    const TimePoint until = clock.now() + std::chrono::seconds(2);
    while (!(status = child_.ended()) && clock.now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!status) {
      child_.finish_by({});
      return {.trouble = "the referee's process does not answer"};
    }
    return {.began = began,
            .status = *status,
            .trouble = "the referee's process " + text_of_end(*status)};
  }

  void end_child() {
    const std::scoped_lock lock(mutex_);
    child_.finish_by({});
  }

  RefereeOptions options_;
  std::mutex mutex_;  ///< guards the members below, and the start and the end of the child
  std::condition_variable asked_;
  std::deque<AskReferee> asks_;
  std::vector<Ruling> rulings_;
  bool stopping_ = false;
  ChildProcess child_;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Referee> make_process_referee(RefereeOptions options) {
  return std::make_unique<ProcessReferee>(std::move(options));
}

}  // namespace swarmsmith
