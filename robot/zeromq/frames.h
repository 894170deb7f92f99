#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "robot/transport/messages.h"

namespace swarmsmith {

/// Messages as frames of text, so that a driver in any language can send them: the topic's name,
/// the stamp in nanoseconds (0: none), and the numbers of `numbers_of`, with blanks between;
/// "ranges 0 0.31 inf nan ...". Numbers have the shortest digits that read back to the same bits.
/// "order" and "state" have their JSON object behind the name alone.

/// Empty for what does not travel.
std::string frame_of(const ToRobot& message);
std::string frame_of(const FromRobot& message);

/// A frame that was read; `arrival.at` is not set. Nothing: no such topic, or other numbers than it
/// has.
std::optional<ToRobot> message_to_robot(std::string_view frame);
std::optional<FromRobot> message_from_robot(std::string_view frame);

/// Whether drivers may send the frame though nodes have no use for it: "imu" and "odom".
bool is_unused_frame(std::string_view frame);

/// The first words of a connection. A driver, world or operator says "hello driver" or "hello
/// operator"; the node answers "hello NAME TOPIC...", with the topics that it needs.
std::string hello_frame(const std::vector<std::string>& words);
/// The words behind "hello"; nothing when the frame is something else.
std::optional<std::vector<std::string>> hello_of(std::string_view frame);

}  // namespace swarmsmith
