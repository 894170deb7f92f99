#include "robot/world/faults.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

namespace swarmsmith {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 3.141592653589793;

constexpr std::array<std::pair<std::string_view, Fault::Sensor>, 5> kSensors = {
    {{"ranges", Fault::Sensor::Ranges},
     {"ground_color", Fault::Sensor::GroundColor},
     {"scan", Fault::Sensor::Scan},
     {"neighbours", Fault::Sensor::Neighbours},
     {"light", Fault::Sensor::Light}}};

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t next = text.find(at);
    parts.push_back(text.substr(0, next));
    if (next == std::string_view::npos) return parts;
    text.remove_prefix(next + 1);
  }
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && at == end;
}

bool read_kind(std::string_view text, Fault& fault) {
  if (text == "silent") {
    fault.kind = Fault::Kind::Silent;
  } else if (text == "nan") {
    fault.kind = Fault::Kind::Nan;
  } else if (text == "turned") {
    fault.kind = Fault::Kind::Turned;
    return fault.sensor == Fault::Sensor::Scan;
  } else {
    constexpr int kMostValues = 100'000;
    fault.kind = Fault::Kind::Length;
    return read_number(text, fault.length) && fault.length >= 0 && fault.length <= kMostValues &&
           fault.sensor != Fault::Sensor::GroundColor && fault.sensor != Fault::Sensor::Neighbours;
  }
  return true;
}

bool read_times(std::string_view text, Fault& fault) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos || !read_number(text.substr(0, dash), fault.from_s))
    return false;
  fault.to_s = std::numeric_limits<double>::infinity();
  const std::string_view to = text.substr(dash + 1);
  return (to.empty() || read_number(to, fault.to_s)) && fault.from_s >= 0 &&
         fault.to_s > fault.from_s;
}

/// Other values in place of the first ones.
void spoil(std::vector<double>& values) {
  std::fill(values.begin(), values.end(), kNan);
}

/// As many values, which are what the sensor saw as far as they go.
void resize(std::vector<double>& values, int length) {
  values.resize(static_cast<std::size_t>(length), std::numeric_limits<double>::infinity());
}

}  // namespace

Expected<Fault> parse_fault(std::string_view text) {
  const auto wrong = [&] {
    return bad_input(
        "write ROBOT:SENSOR:WHAT:FROM-TO, such as rvr1:ranges:silent:10-10.3; sensors: ranges, "
        "ground_color, scan, neighbours, light; what: silent, nan, turned (scan) or a number of "
        "values (ranges, scan, light); seconds of the run, without TO for good",
        std::string(text));
  };
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 4 || parts[0].empty()) return wrong();
  Fault fault;
  fault.robot = parts[0];
  const auto* sensor = std::find_if(kSensors.begin(), kSensors.end(),
                                    [&](const auto& known) { return known.first == parts[1]; });
  if (sensor == kSensors.end()) return wrong();
  fault.sensor = sensor->second;
  if (!read_kind(parts[2], fault) || !read_times(parts[3], fault)) return wrong();
  return fault;
}

FaultySensors::FaultySensors(std::vector<Fault> faults, const std::string& robot)
    : faults_(std::move(faults)) {
  std::erase_if(faults_, [&](const Fault& fault) { return fault.robot != robot; });
}

const Fault* FaultySensors::find(Fault::Sensor sensor, double time_s) const {
  const auto found = std::find_if(faults_.begin(), faults_.end(), [&](const Fault& fault) {
    return fault.sensor == sensor && fault.at(time_s);
  });
  return found == faults_.end() ? nullptr : &*found;
}

std::optional<RangesMessage> FaultySensors::pass(RangesMessage message, double time_s) const {
  const Fault* fault = find(Fault::Sensor::Ranges, time_s);
  if (fault == nullptr) return message;
  if (fault->kind == Fault::Kind::Silent) return std::nullopt;
  // One sensor that is off is enough.
  if (fault->kind == Fault::Kind::Nan && !message.ranges_m.empty()) message.ranges_m.front() = kNan;
  if (fault->kind == Fault::Kind::Length) resize(message.ranges_m, fault->length);
  return message;
}

std::optional<GroundColorMessage> FaultySensors::pass(GroundColorMessage message,
                                                      double time_s) const {
  const Fault* fault = find(Fault::Sensor::GroundColor, time_s);
  if (fault == nullptr) return message;
  if (fault->kind == Fault::Kind::Silent) return std::nullopt;
  message.r = message.g = message.b = kNan;
  return message;
}

std::optional<ScanMessage> FaultySensors::pass(ScanMessage message, double time_s) const {
  const Fault* fault = find(Fault::Sensor::Scan, time_s);
  if (fault == nullptr) return message;
  switch (fault->kind) {
    case Fault::Kind::Silent:
      return std::nullopt;
    case Fault::Kind::Nan:
      spoil(message.ranges_m);
      break;
    case Fault::Kind::Length: {
      // One turn in so many values: each the nearest of the old ones.
      const auto length = static_cast<std::size_t>(fault->length);
      std::vector<double> values;
      for (std::size_t i = 0; i < length; ++i)
        values.push_back(message.ranges_m[i * message.ranges_m.size() / length]);
      message.ranges_m = std::move(values);
      message.angle_increment_rad = 2 * kPi / std::max(1, fault->length);
      message.angle_max_rad =
          message.angle_min_rad + message.angle_increment_rad * (fault->length - 1);
      break;
    }
    case Fault::Kind::Turned: {
      const auto half = static_cast<std::ptrdiff_t>(message.ranges_m.size() / 2);
      std::rotate(message.ranges_m.begin(), message.ranges_m.begin() + half,
                  message.ranges_m.end());
      const double turn = message.angle_increment_rad * static_cast<double>(half);
      message.angle_min_rad += turn - 2 * kPi;
      message.angle_max_rad += turn - 2 * kPi;
      break;
    }
  }
  return message;
}

std::optional<NeighboursMessage> FaultySensors::pass(NeighboursMessage message,
                                                     double time_s) const {
  const Fault* fault = find(Fault::Sensor::Neighbours, time_s);
  if (fault == nullptr) return message;
  if (fault->kind == Fault::Kind::Silent) return std::nullopt;
  message.robots.assign(1, {kNan, kNan, kNan});
  return message;
}

std::optional<LightMessage> FaultySensors::pass(LightMessage message, double time_s) const {
  const Fault* fault = find(Fault::Sensor::Light, time_s);
  if (fault == nullptr) return message;
  if (fault->kind == Fault::Kind::Silent) return std::nullopt;
  if (fault->kind == Fault::Kind::Nan) spoil(message.lux);
  if (fault->kind == Fault::Kind::Length) resize(message.lux, fault->length);
  return message;
}

}  // namespace swarmsmith
