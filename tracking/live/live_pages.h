#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/expected.h"
#include "sim/mission/mission.h"
#include "tracking/live/live_state.h"

namespace swarmsmith {

/// The parts of the pictures that do not change from frame to frame.
struct LiveScenery {
  std::optional<View> view;        ///< without it only tags are drawn
  std::optional<Mission> mission;  ///< for drawing its floor and the robots' bodies
};

/// Shows a live camera to browsers of this host, with its own threads: / (a page), /stream.mjpg (a
/// stream of pictures), /frame.jpg (one picture), /state.json.
class LivePages {
 public:
  /// Listens only on 127.0.0.1, because there is no password. `port` 0 chooses a free port.
  /// Conflict if another program uses the port.
  static Expected<std::unique_ptr<LivePages>> start(int port, LiveScenery scenery);
  virtual ~LivePages() = default;

  /// The address of the page: "http://127.0.0.1:8080/".
  virtual std::string address() const = 0;
  /// Whether a browser waits for pictures; colours are only needed in this case.
  virtual bool is_watched() const = 0;
  /// Shows a new state, and a new picture if there is one; the threads of the browsers' requests
  /// draw it.
  virtual void publish(LiveState state, std::optional<ColorImage> picture) = 0;
};

}  // namespace swarmsmith
