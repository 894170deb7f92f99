#include "analysis/arena/reading_columns.h"

#include <array>
#include <span>

#include "base/assert.h"
#include "base/math.h"
#include "base/suggestion.h"
#include "sim/mission/trajectory_csv.h"
#include "sim/robot/robot_fields.h"

namespace swarmsmith {
namespace {

using Names = std::vector<std::string>;
using Values = std::vector<double>;

constexpr std::size_t kLidarRays = 719;

/// One sensor: its name, its columns in a swarm of `robots` such robots, and their values. Values
/// beyond the columns are left out.
struct Device {
  Sensor sensor;
  std::string_view name;
  Names (*columns)(int robots, const Robot& robot);
  void (*values)(const Readings& readings, Values& values);
};

std::size_t proximity_sensors(const Robot& robot) {
  return robot.proximity.rays_deg.size();
}

std::size_t light_sensors(const Robot& robot) {
  return robot.light.angles_deg.empty() ? proximity_sensors(robot) : robot.light.angles_deg.size();
}

/// stem0_unit, stem1_unit, ...
Names numbered(std::string_view stem, std::size_t count, std::string_view unit) {
  Names names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(std::string(stem).append(std::to_string(i)).append(unit));
  return names;
}

Names neighbour_columns(int robots, const Robot&) {
  Names names = {"neighbours"};
  for (int i = 0; i + 1 < robots; ++i) {
    const std::string stem = "neighbour" + std::to_string(i);
    names.push_back(stem + "_distance_m");
    names.push_back(stem + "_bearing_rad");
  }
  return names;
}

/// Those of this very cycle, which come last: a radio's list begins with packets that it remembers.
void neighbour_values(const Readings& readings, Values& values) {
  const auto count = static_cast<std::size_t>(readings.neighbour_count);
  SWARMSMITH_ASSERT(count <= readings.neighbours.size(), "the list holds every counted neighbour");
  values.push_back(readings.neighbour_count);
  for (const Neighbour& neighbour : std::span(readings.neighbours).last(count)) {
    values.push_back(neighbour.distance_m);
    values.push_back(atan2(neighbour.direction_y, neighbour.direction_x));
  }
}

const std::array<Device, 12> kDevices = {{
    {Sensor::GroundColor, "ground_color",
     [](int, const Robot&) {
       return Names{"ground_r", "ground_g", "ground_b"};
     },
     [](const Readings& r, Values& values) {
       for (const auto channel : {r.ground_color.r, r.ground_color.g, r.ground_color.b})
         values.push_back(channel);
     }},
    {Sensor::Velocity, "velocity",
     [](int, const Robot&) {
       return Names{"velocity_x_mps", "velocity_y_mps"};
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), {r.velocity_mps.x, r.velocity_mps.y});
     }},
    {Sensor::Accelerometer, "accelerometer",
     [](int, const Robot&) {
       return Names{"acceleration_x_g", "acceleration_y_g", "acceleration_z_g"};
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), {r.acceleration_g.x, r.acceleration_g.y, r.acceleration_g.z});
     }},
    {Sensor::Gyroscope, "gyroscope",
     [](int, const Robot&) {
       return Names{"spin_x_radps", "spin_y_radps", "spin_z_radps"};
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), {r.spin_radps.x, r.spin_radps.y, r.spin_radps.z});
     }},
    {Sensor::Imu, "imu",
     [](int, const Robot&) {
       return Names{"pitch_rad", "roll_rad", "yaw_rad"};
     },
     [](const Readings& r, Values& values) {
       const Orientation& o = r.orientation;
       values.insert(values.end(), {o.pitch_rad, o.roll_rad, o.yaw_rad});
     }},
    {Sensor::FrontLight, "front_light", [](int, const Robot&) { return Names{"front_light_lux"}; },
     [](const Readings& r, Values& values) { values.push_back(r.front_light_lux); }},
    {Sensor::LightRing, "light_ring",
     [](int, const Robot& robot) {
       return numbered("light", light_sensors(robot),
                       kOfLightStrengths.acts_on(robot) ? "_strength" : "_lux");
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), r.light_lux.begin(), r.light_lux.end());
     }},
    {Sensor::Locator, "locator",
     [](int, const Robot&) {
       return Names{"position_x_m", "position_y_m"};
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), {r.position_m.x, r.position_m.y});
     }},
    {Sensor::Quaternion, "quaternion",
     [](int, const Robot&) {
       return Names{"rotation_w", "rotation_x", "rotation_y", "rotation_z"};
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), {r.rotation.w, r.rotation.x, r.rotation.y, r.rotation.z});
     }},
    {Sensor::Proximity, "proximity",
     [](int, const Robot& robot) {
       return numbered("proximity", proximity_sensors(robot),
                       kOfStrengths.acts_on(robot) ? "_strength" : "_m");
     },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), r.proximity_m.begin(), r.proximity_m.end());
     }},
    {Sensor::Lidar, "lidar", [](int, const Robot&) { return numbered("lidar", kLidarRays, "_m"); },
     [](const Readings& r, Values& values) {
       values.insert(values.end(), r.lidar_m.begin(), r.lidar_m.end());
     }},
    {Sensor::Neighbours, "neighbours", neighbour_columns, neighbour_values},
}};

}  // namespace

std::vector<std::string> sensor_names() {
  Names names;
  for (const Device& device : kDevices)
    names.emplace_back(device.name);
  return names;
}

Expected<Sensors> sensors_from_names(std::string_view list) {
  Sensors sensors;
  while (true) {
    const std::size_t end = list.find(',');
    const std::string_view name = list.substr(0, end);
    bool known = name == "all";
    for (const Device& device : kDevices) {
      const bool meant = name == device.name || (name == "all" && device.sensor != Sensor::Lidar);
      if (!meant) continue;
      sensors = sensors | device.sensor;
      known = true;
    }
    if (!known) {
      Names names = sensor_names();
      names.insert(names.begin(), "all");
      return bad_input("there is no sensor `" + std::string(name) + "`" +
                       did_you_mean(name, names) + "; known: " + joined(names));
    }
    if (end == std::string_view::npos) return sensors;
    list.remove_prefix(end + 1);
  }
}

ReadingColumns::ReadingColumns(Sensors sensors, int robots, const Robot& robot)
    : sensors_(sensors) {
  for (const Device& device : kDevices) {
    if (!sensors.has(device.sensor)) continue;
    const Names columns = device.columns(robots, robot);
    names_.insert(names_.end(), columns.begin(), columns.end());
    widths_.push_back(columns.size());
  }
}

std::string leds_text(const Leds& leds) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const Rgb led : leds) {
    text += text.empty() ? "#" : " #";
    for (const unsigned channel : {led.r, led.g, led.b}) {
      text += kDigits[channel / 16];
      text += kDigits[channel % 16];
    }
  }
  return text;
}

void ReadingColumns::append_cells(std::string& line, const Readings* readings) const {
  Values values;
  auto width = widths_.begin();
  for (const Device& device : kDevices) {
    if (!sensors_.has(device.sensor)) continue;
    values.clear();
    if (readings != nullptr) device.values(*readings, values);
    const std::size_t columns = *width++;
    for (std::size_t i = 0; i < columns; ++i) {
      line += ',';
      if (i < values.size()) append_number(line, values[i]);
    }
  }
}

}  // namespace swarmsmith
