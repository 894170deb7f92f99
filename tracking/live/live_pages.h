#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/expected.h"
#include "sim/mission/mission.h"
#include "tracking/live/live_state.h"

namespace swarmsmith {

/// What is known beside the frames.
struct LiveScenery {
  std::optional<View> view;        ///< without it only tags are drawn
  std::optional<Mission> mission;  ///< its floor is drawn, and its robots' bodies
};

/// Shows a live camera to browsers of this host, from threads of its own: / (a page),
/// /stream.mjpg (pictures, one after the other), /frame.jpg (one picture), /state.json.
class LivePages {
 public:
  /// Listens on 127.0.0.1 alone: there is no password. `port` 0: a free one. Conflict when another
  /// program has the port.
  static Expected<std::unique_ptr<LivePages>> start(int port, LiveScenery scenery);
  virtual ~LivePages() = default;

  /// "http://127.0.0.1:8080/".
  virtual std::string address() const = 0;
  /// Whether a browser waits for pictures: only then they need colours.
  virtual bool is_watched() const = 0;
  /// What is shown from now on; drawing is done by the threads of those who ask. Without a picture
  /// only the state is new.
  virtual void publish(LiveState state, std::optional<ColorImage> picture) = 0;
};

}  // namespace swarmsmith
