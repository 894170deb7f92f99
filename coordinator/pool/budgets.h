#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.h"
#include "base/rate_limit.h"
#include "proto/socket.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Limits on how much work, disk writing and network traffic other parties can cause a coordinator.
/// A stranger is a principal without an accepted result; a thousand workers of one principal that
/// connect at the same time stay within all of these limits.
struct BudgetOptions {
  // Bytes of rows, and of their lines in the log.
  Rate rows_of_stranger{.burst = 128 << 10, .per_second = 512};
  Rate rows_of_strangers{.burst = 256 << 10, .per_second = 1024};  ///< for all strangers together
  Rate rows_of_known{.burst = 512 << 10, .per_second = 4096};      ///< for each known principal
  Rate hellos_of_peer{.burst = 10, .per_second = 1};
  Rate hellos_of_principal{.burst = 4000, .per_second = 100};
  Rate hellos_of_strangers{.burst = 10'000, .per_second = 500};
  /// Scenarios and statuses are large answers to small requests. A single answer may have any size.
  Rate answers_of_peer{.burst = 20, .per_second = 2};
  Rate answer_bytes{.burst = 16 << 20, .per_second = 128 << 20};
  Rate commands{.burst = 1000, .per_second = 10};
  /// How often an event reports how much was left out.
  Duration tell_every = std::chrono::minutes(1);
};

/// The principal that causes something.
struct Source {
  std::string_view principal;
  bool is_stranger = true;
};

/// Enforces these budgets. Rows and messages beyond them are left out, counted by kind, and
/// reported in events. There is no limit on rows of the answer, on decisions of the coordinator
/// itself, and on its own workers. Pure.
class Budgets {
 public:
  explicit Budgets(const BudgetOptions& options = {});

  bool may_write(const Source& source, std::size_t bytes, TimePoint now);
  bool may_say_hello(PeerId peer, const Source& source, TimePoint now);
  bool may_be_sent(PeerId peer, std::size_t bytes, TimePoint now);
  bool may_command(TimePoint now) { return commands_.take(1, now); }

  void leave_out(std::string_view kind);
  /// Counts by kind, since the start.
  const std::map<std::string, std::uint64_t, std::less<>>& left_out() const { return left_out_; }
  /// Events that report how much was left out since the last events, if it is time to report or
  /// `now_or_never` is set.
  std::vector<EventRow> take_news(TimePoint now, bool now_or_never = false);

 private:
  BudgetOptions options_;
  RateLimits rows_of_stranger_, rows_of_known_;
  RateLimit rows_of_strangers_;
  RateLimits hellos_of_peer_, hellos_of_principal_;
  RateLimit hellos_of_strangers_;
  RateLimits answers_of_peer_;
  RateLimit answer_bytes_;
  RateLimit commands_;
  std::map<std::string, std::uint64_t, std::less<>> left_out_, told_;
  TimePoint tell_again_;
};

/// The approximate size of a row in a store with its indexes, plus its line in the log.
std::size_t bytes_of(const WorkerRow& row);
std::size_t bytes_of(const EventRow& row);
std::size_t bytes_of(const FailureRow& row);
/// For a worker's row that exists already, the size of its log line.
inline constexpr std::size_t kChangeBytes = 150;
inline constexpr std::size_t kConflictBytes = 120;
inline constexpr std::size_t kAttemptBytes = 60;

}  // namespace swarmsmith
