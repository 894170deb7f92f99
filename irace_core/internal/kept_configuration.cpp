#include "irace_core/internal/kept_configuration.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/assert.h"

namespace swarmsmith::irace {
namespace {

// One byte per parameter: a whole number below kWhole, or kOther followed by the bits of the value.
// A run of inactive parameters is kInactive followed by a byte with its length.
constexpr int kWhole = 254;
constexpr unsigned char kOther = 254;
constexpr unsigned char kInactive = 255;
constexpr std::size_t kLongestRun = 255;

bool is_small(double value) {
  // Infinity fails the second comparison, so that it is never converted.
  return value >= 0 && value < kWhole && value == static_cast<double>(static_cast<int>(value));
}

std::string pack(const Configuration& configuration) {
  std::string packed;
  for (std::size_t i = 0; i < configuration.size();) {
    std::size_t run = 0;
    while (i + run < configuration.size() && run < kLongestRun && !configuration.is_active(i + run))
      ++run;
    if (run > 0) {
      packed += static_cast<char>(kInactive);
      packed += static_cast<char>(run);
      i += run;
      continue;
    }
    const double value = configuration[i++];
    // Most values are indices of choices and small integers, which need one byte.
    if (is_small(value)) {
      packed += static_cast<char>(static_cast<unsigned char>(value));
      continue;
    }
    packed += static_cast<char>(kOther);
    // All bits of the value. The packed form never leaves the process, so the byte order does not
    // matter.
    packed.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  // A string that grew may have reserved more memory than it needs.
  packed.shrink_to_fit();
  return packed;
}

/// `configuration` must have the right number of parameters, all of them inactive.
void unpack(const std::string& packed, Configuration& configuration) {
  std::size_t parameter = 0;
  for (std::size_t i = 0; i < packed.size();) {
    const auto kind = static_cast<unsigned char>(packed[i++]);
    if (kind == kInactive) {
      parameter += static_cast<unsigned char>(packed[i++]);
    } else if (kind == kOther) {
      double value = 0;
      std::memcpy(&value, packed.data() + i, sizeof value);
      i += sizeof value;
      configuration.set(parameter++, value);
    } else {
      configuration.set(parameter++, kind);
    }
  }
  SWARMSMITH_ASSERT(parameter == configuration.size(), "a packed configuration has all parameters");
}

std::size_t size_of(const std::string& packed) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const auto kind = static_cast<unsigned char>(packed[i]);
    size += kind == kInactive ? static_cast<unsigned char>(packed[++i]) : 1U;
    if (kind == kOther) i += sizeof(double);
  }
  return size;
}

}  // namespace

const Configuration& KeptConfiguration::get() const {
  if (packed_.empty()) return configuration_;
  configuration_ = Configuration(size_of(packed_));
  unpack(packed_, configuration_);
  // It stays unpacked, so that a reference to it is valid until the next put_away().
  packed_ = {};
  return configuration_;
}

void KeptConfiguration::put_away() {
  if (!packed_.empty()) return;
  packed_ = pack(configuration_);
  configuration_ = {};
}

}  // namespace swarmsmith::irace
