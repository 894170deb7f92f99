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

/// An answer as it goes out.
struct KeptAnswer {
  int status = 200;
  std::string type;
  std::string packed;  ///< its bytes, by gzip
  std::string etag;
  double seconds = 0;  ///< that it took
  /// It is worth keeping: no error, and not cut short.
  bool is_good = true;
  bool is_final = false;  ///< it stays as it is
};

/// Answers that are the same for all clients: equal questions at the same time share one
/// computation, and the newest answers are kept, least recently used ones dropped.
class AnswerCache {
 public:
  using Answer = std::shared_ptr<const KeptAnswer>;
  using Clock = std::chrono::steady_clock;

  explicit AnswerCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// The answer to `question`, made by `make` unless one is kept, or under way, that is final, that
  /// was made of the same `stamp` (empty: of no known one), or whose making began at `oldest` or
  /// later. `shared` is set when nothing was made for this question.
  Answer get(const std::string& question, const std::string& stamp, Clock::time_point oldest,
             const std::function<KeptAnswer()>& make, bool& shared);

  /// Of a computation: whether it goes on, or waits for its turn. Set by who computes.
  using Turn = std::shared_ptr<std::atomic<bool>>;
  /// An answer, or how far it is.
  struct SoFar {
    Answer answer;         ///< null while it is not there
    double seconds = 0;    ///< since its making began, or that it took
    bool goes_on = false;  ///< it does not wait for its turn
    bool shared = false;   ///< see `get`
  };
  /// The same, made in a thread of its own that lives as long as it takes. When the answer is not
  /// there after `patience`, the next client finds it under way; then, whatever it is, it is
  /// the answer for the next kLate, so that it can be fetched from a store that goes on.
  SoFar get_within(const std::string& question, const std::string& stamp, Clock::time_point oldest,
                   std::function<KeptAnswer()> make, const Turn& turn,
                   std::chrono::milliseconds patience);
  static constexpr std::chrono::seconds kLate{30};

  /// What was kept may be wrong now, but for what is final.
  void forget();
  /// Until no thread of get_within works.
  void wait_for_all();
  ~AnswerCache() { wait_for_all(); }

 private:
  struct Kept {
    std::string question;
    std::string stamp;
    Clock::time_point when;
    Answer answer;
    Clock::time_point until{};  ///< it is the answer in any case
  };
  using Order = std::list<Kept>;  ///< newest use first

  /// Holding the mutex, as the next two.
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
    bool is_late = false;  ///< a client has to ask again
  };
  std::map<std::string, UnderWay> under_way_;  ///< the newest of each question
  std::uint64_t begun_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t forgotten_ = 0;
  std::condition_variable none_works_;
  int working_ = 0;  ///< threads of get_within
};

/// Runs at most so many at a time, queues so many, and refuses the others.
class Turnstile {
 public:
  Turnstile(int at_a_time, int waiting) : at_a_time_(at_a_time), most_waiting_(waiting) {}

  /// A place, while it lives.
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
  /// Waits for a place; nothing when too many wait already, after `patience`, or once it is closed.
  std::optional<Pass> enter(std::chrono::milliseconds patience = std::chrono::hours(1));
  /// Turns away all who wait, and all who come.
  void close();
  /// How many wait now.
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
