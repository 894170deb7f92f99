#include "tracking/video/internal/natural_order.h"

#include <cstddef>

namespace swarmsmith {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Reads a number from the front of a text, without its leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end]))
    ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  while (number.size() > 1 && number.front() == '0')
    number.remove_prefix(1);
  return number;
}

}  // namespace

bool comes_before(std::string_view a, std::string_view b) {
  std::string_view x = a;
  std::string_view y = b;
  while (!x.empty() && !y.empty()) {
    if (is_digit(x.front()) && is_digit(y.front())) {
      const std::string_view m = take_number(x);
      const std::string_view n = take_number(y);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (x.front() != y.front()) {
        return static_cast<unsigned char>(x.front()) < static_cast<unsigned char>(y.front());
      }
      x.remove_prefix(1);
      y.remove_prefix(1);
    }
  }
  // "7.png" and "07.png" differ only in zeros.
  if (x.empty() && y.empty()) return a < b;
  return x.empty();
}

}  // namespace swarmsmith
