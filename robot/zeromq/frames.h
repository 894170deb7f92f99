#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "robot/transport/messages.h"

namespace swarmsmith {

/// Messages as frames of text, so that a driver in any language can send them: the name of the
/// topic, the stamp in nanoseconds (0: none), and the numbers of `numbers_of`, separated by blanks;
/// "ranges 0 0.31 inf nan ...". Numbers have the shortest digits that read back to the same bits.
/// For "order" and "state" a JSON object follows directly after the name.

/// Empty for messages that are not sent.
std::string frame_of(const ToRobot& message);
std::string frame_of(const FromRobot& message);

/// Reads a frame; `arrival.at` is not set. Nothing: the topic does not exist, or the numbers do not
/// match it.
std::optional<ToRobot> message_to_robot(std::string_view frame);
std::optional<FromRobot> message_from_robot(std::string_view frame);

/// Whether drivers may send the frame although nodes do not use it: "imu" and "odom".
bool is_unused_frame(std::string_view frame);

/// The first frame of a connection. A driver, world or operator sends "hello driver" or "hello
/// operator"; the node answers "hello NAME TOPIC...", with the topics that it needs.
std::string hello_frame(const std::vector<std::string>& words);
/// The words after "hello"; nothing when the frame is of another kind.
std::optional<std::vector<std::string>> hello_of(std::string_view frame);

}  // namespace swarmsmith
