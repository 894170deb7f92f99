#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "robot/transport/messages.h"

namespace swarmsmith {

/// Messages as rows of numbers, the format for transports without a type for a message
/// (docs/robot-messages.md): the fields of `kNumbers`, one after another. A neighbour is d, x, y;
/// optional fields and fields of any length come last. Arrivals are not included.

namespace detail {

class NumberWriter {
 public:
  void operator()(double number) { numbers_.push_back(number); }
  void operator()(std::int64_t number) { numbers_.push_back(static_cast<double>(number)); }
  void operator()(int number) { numbers_.push_back(number); }
  void operator()(const SeenRobot& robot) {
    numbers_.insert(numbers_.end(), {robot.distance_m, robot.direction_x, robot.direction_y});
  }
  template <class Number>
  void operator()(const std::optional<Number>& number) {
    if (number) (*this)(*number);
  }
  template <class List>
  void operator()(const List& list) {
    for (const auto& item : list)
      (*this)(item);
  }
  std::vector<double> take() { return std::move(numbers_); }

 private:
  std::vector<double> numbers_;
};

/// Reads number after number; after a missing or invalid number the result stays invalid.
class NumberReader {
 public:
  explicit NumberReader(const std::vector<double>& numbers) : numbers_(numbers) {}

  void operator()(double& number) {
    if (at_ < numbers_.size()) {
      number = numbers_[at_++];
    } else {
      right_ = false;
    }
  }
  void operator()(std::int64_t& number) {
    constexpr double kLargestWhole = 9007199254740992.0;  // doubles up to here represent all
                                                          // integers
    number = whole(-kLargestWhole, kLargestWhole);
  }
  /// A state of a machine.
  void operator()(int& number) { number = static_cast<int>(whole(0, 1000)); }
  void operator()(SeenRobot& robot) {
    (*this)(robot.distance_m);
    (*this)(robot.direction_x);
    (*this)(robot.direction_y);
  }
  template <class Number>
  void operator()(std::optional<Number>& number) {
    number.reset();
    if (at_ < numbers_.size()) (*this)(number.emplace());
  }
  template <class Number, std::size_t N>
  void operator()(std::array<Number, N>& numbers) {
    for (Number& number : numbers)
      (*this)(number);
  }
  /// Reads all remaining numbers.
  template <class Number>
  void operator()(std::vector<Number>& numbers) {
    numbers.clear();
    while (at_ < numbers_.size())
      (*this)(numbers.emplace_back());
  }
  bool all_read() const { return right_ && at_ == numbers_.size(); }

 private:
  std::int64_t whole(double least, double most) {
    double number = 0;
    (*this)(number);
    if (number >= least && number <= most && number == std::floor(number))
      return static_cast<std::int64_t>(number);
    right_ = false;
    return 0;
  }

  const std::vector<double>& numbers_;
  std::size_t at_ = 0;
  bool right_ = true;
};

}  // namespace detail

template <class Message>
std::vector<double> numbers_of(const Message& message) {
  detail::NumberWriter writer;
  std::apply([&](auto... field) { (writer(message.*field), ...); }, Message::kNumbers);
  return writer.take();
}

/// False, without changing the message, when the count of numbers does not match the message, or
/// when a number is not valid for its field.
template <class Message>
bool read_numbers(const std::vector<double>& numbers, Message& message) {
  Message read = message;  // keeps the fields that are not sent
  detail::NumberReader reader(numbers);
  std::apply([&](auto... field) { (reader(read.*field), ...); }, Message::kNumbers);
  if (!reader.all_read()) return false;
  message = std::move(read);
  return true;
}

}  // namespace swarmsmith
