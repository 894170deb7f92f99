#include "robot/zeromq/frames.h"

#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "robot/transport/numbers.h"

namespace swarmsmith {

namespace {

constexpr std::string_view kHello = "hello";

void append(std::string& text, double value) {
  std::array<char, 40> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text += ' ';
  text.append(buffer.data(), end);
}

/// Cuts the next word off; empty at the end.
std::string_view next_word(std::string_view& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return text = {};
  text.remove_prefix(begin);
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

bool read_frame(std::string_view text, std::int64_t& stamp_ns, std::vector<double>& numbers) {
  const auto read = [](std::string_view word, auto& value) {
    const char* end = word.data() + word.size();
    const auto [at, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && at == end;
  };
  if (!read(next_word(text), stamp_ns)) return false;
  while (true) {
    const std::string_view word = next_word(text);
    if (word.empty()) return true;
    if (!read(word, numbers.emplace_back())) return false;
  }
}

/// Reads the frame if it is of this topic; whether it was.
template <class Message, class Variant>
bool read_as(std::string_view topic, std::string_view rest, std::optional<Variant>& found) {
  if (topic != Message::kTopic) return false;
  Message message;
  std::vector<double> numbers;
  if (read_frame(rest, message.arrival.stamp_ns, numbers) && read_numbers(numbers, message))
    found = std::move(message);
  return true;
}

}  // namespace

template <class Message>
std::string frame_of(const Message& message) {
  std::string text(Message::kTopic);
  if constexpr (std::is_same_v<Message, OrderMessage> || std::is_same_v<Message, StateMessage>) {
    return text + ' ' + message.text;
  } else {
    text += ' ' + std::to_string(message.arrival.stamp_ns);
    for (const double number : numbers_of(message))
      append(text, number);
    return text;
  }
}

template std::string frame_of(const RangesMessage&);
template std::string frame_of(const GroundColorMessage&);
template std::string frame_of(const ScanMessage&);
template std::string frame_of(const NeighboursMessage&);
template std::string frame_of(const LightMessage&);
template std::string frame_of(const ImuMessage&);
template std::string frame_of(const OdometryMessage&);
template std::string frame_of(const BatteryMessage&);
template std::string frame_of(const DrivenMessage&);
template std::string frame_of(const SensesMessage&);
template std::string frame_of(const OrderMessage&);
template std::string frame_of(const WheelsMessage&);
template std::string frame_of(const LedsMessage&);
template std::string frame_of(const StateMessage&);
template std::string frame_of(const AnswerMessage&);

std::optional<ToRobot> message_to_robot(std::string_view frame) {
  const std::string_view topic = next_word(frame);
  std::optional<ToRobot> found;
  if (topic == OrderMessage::kTopic) {
    if (!frame.empty()) found = OrderMessage{{}, std::string(frame.substr(1))};
    return found;
  }
  (void)(read_as<RangesMessage>(topic, frame, found) ||
         read_as<GroundColorMessage>(topic, frame, found) ||
         read_as<ScanMessage>(topic, frame, found) ||
         read_as<NeighboursMessage>(topic, frame, found) ||
         read_as<LightMessage>(topic, frame, found) || read_as<ImuMessage>(topic, frame, found) ||
         read_as<OdometryMessage>(topic, frame, found) ||
         read_as<BatteryMessage>(topic, frame, found) ||
         read_as<DrivenMessage>(topic, frame, found) ||
         read_as<SensesMessage>(topic, frame, found));
  return found;
}

std::optional<FromRobot> message_from_robot(std::string_view frame) {
  const std::string_view topic = next_word(frame);
  std::optional<FromRobot> found;
  if (topic == StateMessage::kTopic) {
    if (!frame.empty()) found = StateMessage{{}, std::string(frame.substr(1))};
    return found;
  }
  (void)(read_as<WheelsMessage>(topic, frame, found) || read_as<LedsMessage>(topic, frame, found) ||
         read_as<AnswerMessage>(topic, frame, found));
  return found;
}

std::string hello_frame(const std::vector<std::string>& words) {
  std::string text(kHello);
  for (const std::string& word : words)
    text += ' ' + word;
  return text;
}

std::optional<std::vector<std::string>> hello_of(std::string_view frame) {
  if (next_word(frame) != kHello) return std::nullopt;
  std::vector<std::string> words;
  while (true) {
    const std::string_view word = next_word(frame);
    if (word.empty()) return words;
    words.emplace_back(word);
  }
}

}  // namespace swarmsmith
