#include "tracking/video/internal/iso_time.h"

#include <chrono>
#include <string>

namespace swarmsmith {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Parses a text from its front.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  std::optional<int> number(std::size_t digits) {
    if (rest_.size() < digits) return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      if (!is_digit(rest_[i])) return std::nullopt;
      value = 10 * value + (rest_[i] - '0');
    }
    rest_.remove_prefix(digits);
    return value;
  }
  bool one_of(std::string_view signs) {
    if (rest_.empty() || signs.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// Reads a fraction: digits after a point. After another separator, only three, six or nine
  /// digits are a fraction; others may be a counter.
  double fraction() {
    const std::string_view before = rest_;
    const bool is_point = one_of(".,");
    std::size_t digits = 0;
    if (is_point || one_of("-_")) {
      while (digits < rest_.size() && is_digit(rest_[digits]))
        ++digits;
    }
    if (digits == 0 || (!is_point && (digits > 9 || digits % 3 != 0))) {
      rest_ = before;
      return 0;
    }
    double value = 0;
    double unit = 0.1;
    for (; !rest_.empty() && is_digit(rest_.front()); unit /= 10) {
      if (unit > 1e-9) value += unit * (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    return value;
  }
  /// Offset of the zone from UTC, in seconds.
  std::optional<int> zone() {
    if (one_of("Zz")) return 0;
    const bool behind = !rest_.empty() && rest_.front() == '-';
    if (!one_of("+-")) return 0;
    const auto hours = number(2);
    one_of(":");
    const auto minutes = rest_.empty() ? std::optional(0) : number(2);
    if (!hours || !minutes) return std::nullopt;
    return (behind ? -60 : 60) * (60 * *hours + *minutes);
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

/// With `whole`, nothing may follow the date.
std::optional<double> read(std::string_view text, bool whole) {
  using namespace std::chrono;
  Reader reader(text);
  const auto years = reader.number(4);
  if (!years || !reader.one_of("-_.")) return std::nullopt;
  const auto months = reader.number(2);
  if (!months || !reader.one_of("-_.")) return std::nullopt;
  const auto days = reader.number(2);
  if (!days || !reader.one_of("Tt _-")) return std::nullopt;
  const auto hours = reader.number(2);
  if (!hours || !reader.one_of(":-_.h")) return std::nullopt;
  const auto minutes = reader.number(2);
  if (!minutes || !reader.one_of(":-_.m")) return std::nullopt;
  const auto seconds = reader.number(2);
  if (!seconds || *hours > 23 || *minutes > 59 || *seconds > 60) return std::nullopt;
  const double part = reader.fraction();
  const auto zone = whole ? reader.zone() : std::optional(0);
  if (!zone || (whole && !reader.at_end())) return std::nullopt;
  const year_month_day date{year(*years), month(static_cast<unsigned>(*months)),
                            day(static_cast<unsigned>(*days))};
  if (!date.ok()) return std::nullopt;
  const auto since = sys_days(date).time_since_epoch();
  return static_cast<double>(std::chrono::seconds(since).count() + 3600 * *hours + 60 * *minutes +
                             *seconds - *zone) +
         part;
}

}  // namespace

std::optional<double> iso_time(std::string_view text) {
  return read(text, true);
}

std::optional<double> iso_time_in(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size(); ++begin) {
    if (!is_digit(text[begin]) || (begin > 0 && is_digit(text[begin - 1]))) continue;
    if (const auto found = read(text.substr(begin), false)) return found;
  }
  return std::nullopt;
}

}  // namespace swarmsmith
