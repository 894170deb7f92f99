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

/// Removes the next word from the text and returns it; empty at the end.
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

template <class Message>
inline constexpr bool kIsText =
    std::is_same_v<Message, OrderMessage> || std::is_same_v<Message, StateMessage>;

/// Reads the frame if it is of this topic.
template <class Message, class Variant>
void read_as(std::string_view topic, std::string_view rest, std::optional<Variant>& found) {
  if constexpr (kTravels<Message>) {
    if (topic != Message::kTopic) return;
    Message message;
    std::vector<double> numbers;
    if constexpr (kIsText<Message>) {
      if (rest.empty()) return;
      message.text = rest.substr(1);
      found = std::move(message);
    } else if (read_frame(rest, message.arrival.stamp_ns, numbers) &&
               read_numbers(numbers, message)) {
      found = std::move(message);
    }
  }
}

template <class... Messages>
std::string frame_text(const std::variant<Messages...>& message) {
  return std::visit(
      [](const auto& one) -> std::string {
        using Message = std::decay_t<decltype(one)>;
        if constexpr (!kTravels<Message>) {
          return {};
        } else if constexpr (kIsText<Message>) {
          return std::string(Message::kTopic) + ' ' + one.text;
        } else {
          std::string text = Message::kTopic + (' ' + std::to_string(one.arrival.stamp_ns));
          for (const double number : numbers_of(one))
            append(text, number);
          return text;
        }
      },
      message);
}

template <class... Messages>
void read_any(std::string_view frame, std::optional<std::variant<Messages...>>& found) {
  const std::string_view topic = next_word(frame);
  (read_as<Messages>(topic, frame, found), ...);
}

}  // namespace

std::string frame_of(const ToRobot& message) {
  return frame_text(message);
}

std::string frame_of(const FromRobot& message) {
  return frame_text(message);
}

std::optional<ToRobot> message_to_robot(std::string_view frame) {
  std::optional<ToRobot> found;
  read_any(frame, found);
  return found;
}

std::optional<FromRobot> message_from_robot(std::string_view frame) {
  std::optional<FromRobot> found;
  read_any(frame, found);
  return found;
}

bool is_unused_frame(std::string_view frame) {
  const std::string_view topic = next_word(frame);
  return topic == "imu" || topic == "odom";
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
