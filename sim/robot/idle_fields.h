#pragma once

#include <any>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sim/robot/fields.h"

namespace swarmsmith {

/// A field that has no effect on a robot.
struct IdleField {
  std::string device;
  std::string key;
  std::string_view robots;  ///< the robots on which it has an effect, from FieldUse
  bool differs = false;     ///< whether its value differs from the first robot's or profile's
};

/// The visitor of two robots, or two profiles, that compares the fields without effect on `robot`.
/// The fields of the second one get the values of the first one, unless it is constant.
class IdleFields {
 public:
  explicit IdleFields(const Robot& robot) : robot_(&robot) {}

  /// Must be called between the two visits.
  void compare() { compares_ = true; }
  /// The fields without effect in the second one.
  const std::vector<IdleField>& found() const { return found_; }

  void device(std::string_view name) { device_ = name; }
  template <class Visit>
  void only(const FieldUse& use, const Visit& visit) {
    if (use.acts_on(*robot_)) return;
    use_ = &use;
    visit();
    use_ = nullptr;
  }
  template <class Visit>
  void later(bool /*is_ideal*/, const Visit& visit) {
    visit();
  }
  template <class Value>
  void number(std::string_view key, Value& value, FieldLimits) {
    look_at(key, value);
  }
  template <class Value>
  void numbers(std::string_view key, Value& value, FieldLimits) {
    look_at(key, value);
  }
  template <class Value>
  void count(std::string_view key, Value& value, int, int) {
    look_at(key, value);
  }
  template <class Value>
  void flag(std::string_view key, Value& value) {
    look_at(key, value);
  }
  template <class Value, class Choices>
  void choice(std::string_view key, Value& value, const Choices&) {
    look_at(key, value);
  }
  template <class Value>
  void colors(std::string_view key, Value& value) {
    look_at(key, value);
  }
  template <class Value>
  void beat(std::string_view key, Value& value) {
    look_at(key, value);
  }
  // Fields of these kinds have an effect on all robots.
  template <class Value>
  void outline(const Value&) {}
  template <class Value>
  void angles(std::string_view, const Value&) {}
  template <class Value>
  void points(std::string_view, const Value&) {}
  template <class Value>
  void point(std::string_view, const Value&, FieldLimits) {}
  template <class Value>
  void delays(std::string_view, const Value&) {}
  void period(std::string_view, double, double) {}

 private:
  template <class Value>
  void look_at(std::string_view key, Value& value) {
    if (use_ == nullptr) return;
    if (!compares_) {
      first_.emplace_back(value);
      return;
    }
    const auto& first = std::any_cast<const std::remove_const_t<Value>&>(first_.at(next_++));
    found_.push_back({std::string(device_), std::string(key), use_->robots, value != first});
    if constexpr (!std::is_const_v<Value>) value = first;
  }

  const Robot* robot_;
  const FieldUse* use_ = nullptr;  ///< of the fields being visited; null: they have an effect
  std::string_view device_;
  bool compares_ = false;
  std::vector<std::any> first_;
  std::size_t next_ = 0;
  std::vector<IdleField> found_;
};

}  // namespace swarmsmith
