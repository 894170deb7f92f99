#include "analysis/records/names.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {

bool NameOrder::operator()(std::string_view a, std::string_view b) const {
  constexpr std::string_view kLast = "real";
  return std::pair(a == kLast, a) < std::pair(b == kLast, b);
}

std::string as_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace swarmsmith
