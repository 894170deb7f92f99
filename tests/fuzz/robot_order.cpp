#include "robot/runtime/node_state.h"
#include "robot/runtime/order.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// What comes from the network to nodes and operators: refused with a reason, or read to what
/// prints and reads back. A start has a name that can be part of a file's name.
void run(std::string_view input) {
  if (const auto order = parse_order(input)) {
    const auto again = parse_order(order_text(*order));
    require(again.has_value(), "an order that is printed can be read");
    require(again->kind == order->kind && again->id == order->id && again->run == order->run &&
                again->robots == order->robots &&
                again->seed.has_value() <= order->seed.has_value(),
            "an order that is printed reads back as the same");
    if (order->kind == Order::Kind::Start) {
      require(is_plain_name(order->run), "a start has a plain name");
      require(order->seconds > 0 && order->seconds <= 86'400, "a start has an end");
    }
    OrderDoor door("rvr1");
    static_cast<void>(door.refusal(*order, 1e9));
    static_cast<void>(door.is_for_this_robot(*order));
  } else {
    require(!order.error().message.empty(), "a refusal has a reason");
  }
  if (const auto state = parse_state(input)) {
    const auto again = parse_state(state_text(*state));
    require(again.has_value() && again->phase == state->phase && again->reasons == state->reasons,
            "a state that is printed reads back");
  } else {
    require(!state.error().message.empty(), "a refusal has a reason");
  }
}

}  // namespace swarmsmith::fuzz
