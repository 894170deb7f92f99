#pragma once

#include <string>

#include "proto/mission.pb.h"
#include "sim/mission/arena.h"

namespace swarmsmith {

/// Arenas and what they are made of, into messages.

void write(Rgb color, pb::Color& out);
void write(Point point, pb::Point& out);
void write(const Pose& pose, pb::Pose& out);
void write(const Disc& disc, pb::Disc& out);
void write(const Rectangle& rectangle, pb::Rectangle& out);
void write(const Outline& outline, pb::Outline& out);
void write(const Arena& arena, pb::Arena& out);

/// And out of them. The first thing that is wrong is kept, and reading goes on; `field` is the path
/// for it.
class ArenaReader {
 public:
  std::string where;
  std::string complaint;

  void complain(const std::string& field, const std::string& text);

  double number(double value, const std::string& field);
  /// Larger than 0.
  double size(double value, const std::string& field);
  Rgb color(const pb::Color& message, const std::string& field);
  Point point(const pb::Point& message, const std::string& field);
  Pose pose(const pb::Pose& message, const std::string& field);
  Disc disc(const pb::Disc& message, const std::string& field);
  Rectangle rectangle(const pb::Rectangle& message, const std::string& field);
  Outline outline(const pb::Outline& message, const std::string& field);
  Arena arena(const pb::Arena& message);

 private:
  Patch patch(const pb::Patch& message, const std::string& field);
};

}  // namespace swarmsmith
