#include "robot/world/faults.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/math.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {

namespace {

constexpr std::int64_t kMostValues = 100'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::string_view, 5> kSensors = {
    RangesMessage::kTopic, GroundColorMessage::kTopic, ScanMessage::kTopic,
    NeighboursMessage::kTopic, LightMessage::kTopic};

bool read_kind(std::string_view text, Fault& fault) {
  if (text == "silent") {
    fault.kind = Fault::Kind::Silent;
  } else if (text == "nan") {
    fault.kind = Fault::Kind::Nan;
  } else if (text == "turned") {
    fault.kind = Fault::Kind::Turned;
    return fault.sensor == ScanMessage::kTopic;
  } else {
    const std::int64_t length = integer_in(text).value_or(-1);
    fault.kind = Fault::Kind::Length;
    fault.length = static_cast<int>(std::clamp<std::int64_t>(length, 0, kMostValues));
    return length == fault.length && fault.sensor != GroundColorMessage::kTopic &&
           fault.sensor != NeighboursMessage::kTopic;
  }
  return true;
}

bool read_times(std::string_view text, Fault& fault) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return false;
  const std::string_view to = text.substr(dash + 1);
  fault.from_s = number_in(text.substr(0, dash)).value_or(-1);
  fault.to_s = to.empty() ? std::numeric_limits<double>::infinity() : number_in(to).value_or(-1);
  return fault.from_s >= 0 && fault.to_s > fault.from_s;
}

/// Sets values to NaN, or changes their number to the length in `fault`: the first values are kept,
/// additional ones are infinity.
void spoil(std::vector<double>& values, const Fault& fault) {
  if (fault.kind == Fault::Kind::Nan) std::fill(values.begin(), values.end(), kNan);
  if (fault.kind == Fault::Kind::Length)
    values.resize(static_cast<std::size_t>(fault.length), std::numeric_limits<double>::infinity());
}

void spoil(RangesMessage& message, const Fault& fault) {
  // One sensor that is off is enough.
  if (fault.kind == Fault::Kind::Nan && !message.ranges_m.empty()) {
    message.ranges_m.front() = kNan;
  } else {
    spoil(message.ranges_m, fault);
  }
}

void spoil(GroundColorMessage& message, const Fault&) {
  message.r = message.g = message.b = kNan;
}

void spoil(ScanMessage& message, const Fault& fault) {
  std::vector<double>& ranges_m = message.ranges_m;
  if (fault.kind == Fault::Kind::Nan) spoil(ranges_m, fault);
  if (fault.kind == Fault::Kind::Length) {
    // One revolution with this number of values: each is the nearest old value.
    const auto length = static_cast<std::size_t>(fault.length);
    std::vector<double> values;
    for (std::size_t i = 0; i < length; ++i)
      values.push_back(ranges_m[i * ranges_m.size() / length]);
    ranges_m = std::move(values);
    message.angle_increment_rad = 2 * kPi / std::max(1, fault.length);
    message.angle_max_rad =
        message.angle_min_rad + message.angle_increment_rad * (fault.length - 1);
  }
  if (fault.kind == Fault::Kind::Turned) {
    const auto half = static_cast<std::ptrdiff_t>(ranges_m.size() / 2);
    std::rotate(ranges_m.begin(), ranges_m.begin() + half, ranges_m.end());
    const double turn = message.angle_increment_rad * static_cast<double>(half);
    message.angle_min_rad += turn - 2 * kPi;
    message.angle_max_rad += turn - 2 * kPi;
  }
}

void spoil(NeighboursMessage& message, const Fault&) {
  message.robots.assign(1, {kNan, kNan, kNan});
}

void spoil(LightMessage& message, const Fault& fault) {
  spoil(message.lux, fault);
}

}  // namespace

Expected<Fault> parse_fault(std::string_view text) {
  const auto wrong = [&] {
    return bad_input(
        "write ROBOT:SENSOR:WHAT:FROM-TO, such as rvr1:ranges:silent:10-10.3; sensors: ranges, "
        "ground_color, scan, neighbours, light; what: silent, nan, turned (scan) or a number of "
        "values (ranges, scan, light); times in seconds of the run, without TO: until its end",
        std::string(text));
  };
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 4 || parts[0].empty()) return wrong();
  Fault fault;
  fault.robot = parts[0];
  if (std::ranges::find(kSensors, parts[1]) == kSensors.end()) return wrong();
  fault.sensor = parts[1];
  if (!read_kind(parts[2], fault) || !read_times(parts[3], fault)) return wrong();
  return fault;
}

FaultySensors::FaultySensors(std::vector<Fault> faults, const std::string& robot)
    : faults_(std::move(faults)) {
  std::erase_if(faults_, [&](const Fault& fault) { return fault.robot != robot; });
}

std::optional<ToRobot> FaultySensors::pass(ToRobot message, double time_s) const {
  const bool is_sent = std::visit(
      [&](auto& one) {
        using Message = std::decay_t<decltype(one)>;
        if constexpr (requires(const Fault& fault) { spoil(one, fault); }) {
          const auto fault = std::ranges::find_if(faults_, [&](const Fault& known) {
            return known.sensor == Message::kTopic && known.at(time_s);
          });
          if (fault == faults_.end()) return true;
          if (fault->kind == Fault::Kind::Silent) return false;
          spoil(one, *fault);
        }
        return true;
      },
      message);
  if (!is_sent) return std::nullopt;
  return message;
}

}  // namespace swarmsmith
