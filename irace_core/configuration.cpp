#include "irace_core/configuration.h"

#include <limits>

namespace swarmsmith {
namespace {
constexpr double kInactive = std::numeric_limits<double>::quiet_NaN();
}

Configuration::Configuration(std::size_t parameters) : values_(parameters, kInactive) {}

void Configuration::set(std::size_t parameter, double value) {
  values_[parameter] = value != value ? kInactive : value + 0.0;  // -0 + 0 is 0
}

void Configuration::deactivate(std::size_t parameter) {
  values_[parameter] = kInactive;
}

std::uint64_t Configuration::digest() const {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(values_.size()));
  for (const double value : values_)
    digest.add(value);
  return digest.value64();
}

bool operator==(const Configuration& a, const Configuration& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.is_active(i) != b.is_active(i)) return false;
    if (a.is_active(i) && a[i] != b[i]) return false;
  }
  return true;
}

}  // namespace swarmsmith
