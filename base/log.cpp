#include "base/log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "base/clock.h"
#include "base/environment.h"
#include "base/log_limiter.h"
#include "base/log_line.h"

namespace swarmsmith {
namespace {

// A signal handler changes it, so it must be lock-free and initialised from the beginning.
std::atomic<int> g_level{static_cast<int>(LogLevel::Info)};
static_assert(std::atomic<int>::is_always_lock_free);

std::string time_text() {
  using std::chrono::milliseconds;
  const auto now = std::chrono::time_point_cast<milliseconds>(std::chrono::system_clock::now());
  const auto ms = (now.time_since_epoch() % std::chrono::seconds(1)).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)), ms);
}

class Log {
 public:
  Log() {
    const std::string words = environment("SWARMSMITH_LOG");
    asked_for_ = !words.empty();
    if (!asked_for_) return;
    const LogSettings settings = parse_log_settings(words);
    json_ = settings.json;
    has_level_ = settings.level.has_value();
    if (settings.level) g_level = static_cast<int>(*settings.level);
    if (settings.unknown.empty()) return;
    const LogField fields[] = {{"word", settings.unknown},
                               {"known", std::string("debug info warning error none text json")}};
    put(LogLevel::Warning, "log", "SWARMSMITH_LOG has an unknown word", fields);
  }
  ~Log() { tell_left_out(true); }

  void write(LogLevel level, std::string_view component, std::string_view event,
             std::span<const LogField> fields) {
    const std::scoped_lock lock(mutex_);
    tell_left_out(false);
    if (limiter_.admit(event, clock_.now())) put(level, component, event, fields);
  }

  bool asked_for() const { return asked_for_; }
  bool has_level() const { return has_level_; }

 private:
  /// Writes each line in one call, so that lines of several processes on one terminal are not
  /// mixed.
  void put(LogLevel level, std::string_view component, std::string_view event,
           std::span<const LogField> fields) {
    const std::string line = log_line(json_, time_text(), level, component, event, fields) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
  }

  void tell_left_out(bool all) {
    for (const LogLimiter::LeftOut& left_out : limiter_.take_left_out(clock_.now(), all)) {
      const LogField fields[] = {{"of", left_out.event}, {"lines", left_out.count}};
      put(LogLevel::Warning, "log", "lines left out", fields);
    }
  }

  std::mutex mutex_;
  SystemClock clock_;
  LogLimiter limiter_;
  bool json_ = false;
  bool asked_for_ = false;
  bool has_level_ = false;
};

Log& the_log() {
  static Log log;
  return log;
}

void on_signal(int signal) {
  const int step = signal == SIGUSR1 ? -1 : 1;
  const int level = g_level.load();
  g_level = std::clamp(level + step, 0, static_cast<int>(LogLevel::None));
}

}  // namespace

void log_event(LogLevel level, std::string_view component, std::string_view event,
               std::span<const LogField> fields) {
  Log& sink = the_log();
  if (level == LogLevel::None || static_cast<int>(level) < g_level.load()) return;
  sink.write(level, component, event, fields);
}

void log_event(LogLevel level, std::string_view component, std::string_view event,
               std::initializer_list<LogField> fields) {
  log_event(level, component, event, std::span(fields.begin(), fields.size()));
}

void set_log_level(LogLevel level) {
  the_log();  // reads the environment first, whose level is then replaced
  g_level = static_cast<int>(level);
}

void set_default_log_level(LogLevel level) {
  if (!the_log().has_level()) g_level = static_cast<int>(level);
}

bool log_is_asked_for() {
  return the_log().asked_for();
}

void change_log_level_by_signals() {
  the_log();
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGUSR1, &action, nullptr);
  sigaction(SIGUSR2, &action, nullptr);
}

}  // namespace swarmsmith
