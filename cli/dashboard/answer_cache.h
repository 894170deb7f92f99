#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace swarmsmith::cli {

/// An answer as it is sent.
struct KeptAnswer {
  int status = 200;
  std::string type;
  std::string packed;  ///< the body, compressed by gzip
  std::string etag;
  double seconds = 0;  ///< time that the computation took
  /// Whether the answer may be kept: it is not an error and was not truncated.
  bool is_good = true;
  bool is_final = false;  ///< it never changes
};

/// A cache of answers that are the same for all clients. Equal questions at the same time share one
/// computation. The least recently used answers are dropped first.
class AnswerCache {
 public:
  using Answer = std::shared_ptr<const KeptAnswer>;
  using Clock = std::chrono::steady_clock;

  explicit AnswerCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Returns the answer to `question`. Calls `make` unless a valid answer is kept or being
  /// computed: one that is final, that has the same `stamp` (empty: not known), or whose
  /// computation began at `oldest` or later. Sets `shared` if nothing was computed for this call.
  Answer get(const std::string& question, const std::string& stamp, Clock::time_point oldest,
             const std::function<KeptAnswer()>& make, bool& shared);

  /// Whether a computation is running or waits for its turn. Set by the thread that computes.
  using Turn = std::shared_ptr<std::atomic<bool>>;
  /// An answer, or the progress of its computation.
  struct SoFar {
    Answer answer;         ///< null until the computation ends
    double seconds = 0;    ///< since the computation began, or how long it took
    bool goes_on = false;  ///< running: it does not wait for its turn
    bool shared = false;   ///< see `get`
  };
  /// Like `get`, but computes in a separate thread without a time limit. If the answer takes longer
  /// than `patience`, the next client joins the same computation; its answer is then valid for
  /// kLate in any case, so that the client can fetch it although the store keeps changing.
  SoFar get_within(const std::string& question, const std::string& stamp, Clock::time_point oldest,
                   std::function<KeptAnswer()> make, const Turn& turn,
                   std::chrono::milliseconds patience);
  static constexpr std::chrono::seconds kLate{30};

  /// Marks kept answers as outdated, except final ones.
  void forget();
  /// Waits until all threads of get_within have ended.
  void wait_for_all();
  ~AnswerCache() { wait_for_all(); }

 private:
  struct Kept {
    std::string question;
    std::string stamp;
    Clock::time_point when;
    Answer answer;
    Clock::time_point until{};  ///< valid until then in any case
  };
  using Order = std::list<Kept>;  ///< most recently used first

  /// The caller holds the mutex, also for the next two functions.
  Answer kept_for(const std::string& question, const std::string& stamp, Clock::time_point oldest,
                  bool& is_late);
  void keep(const std::string& question, const std::string& stamp, Clock::time_point when,
            const Answer& answer, Clock::time_point until = {});
  void finish(const std::string& question, const std::string& stamp, std::uint64_t number,
              const Answer& answer);
  static std::size_t weight(const Kept& kept);

  std::size_t most_bytes_;
  std::mutex mutex_;
  Order order_;
  std::map<std::string, Order::iterator> kept_;
  struct UnderWay {
    std::uint64_t number;
    Clock::time_point when;
    std::shared_future<Answer> answer;
    std::uint64_t forgotten = 0;
    Turn turn{};
    bool is_late = false;  ///< a client has to ask again for the answer
  };
  std::map<std::string, UnderWay> under_way_;  ///< the newest computation for each question
  std::uint64_t begun_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t forgotten_ = 0;
  std::condition_variable none_works_;
  int working_ = 0;  ///< threads of get_within
};

/// Lets a limited number of threads run at a time, queues a limited number, and refuses the others.
class Turnstile {
 public:
  Turnstile(int at_a_time, int waiting) : at_a_time_(at_a_time), most_waiting_(waiting) {}

  /// Permission to run, as long as the object exists.
  class Pass {
   public:
    explicit Pass(Turnstile& turnstile) : turnstile_(&turnstile) {}
    ~Pass();
    Pass(Pass&& other) noexcept : turnstile_(std::exchange(other.turnstile_, nullptr)) {}
    Pass& operator=(Pass&& other) noexcept {
      std::swap(turnstile_, other.turnstile_);
      return *this;
    }

   private:
    Turnstile* turnstile_;
  };
  /// Waits for a pass. Empty if too many threads wait already, after `patience`, or once it is
  /// closed.
  std::optional<Pass> enter(std::chrono::milliseconds patience = std::chrono::hours(1));
  /// Refuses all waiting threads and all later ones.
  void close();
  /// The number of waiting threads.
  int waiting();

 private:
  int at_a_time_;
  int most_waiting_;
  std::mutex mutex_;
  std::condition_variable left_;
  int inside_ = 0;
  int waiting_ = 0;
  bool closed_ = false;
};

}  // namespace swarmsmith::cli
