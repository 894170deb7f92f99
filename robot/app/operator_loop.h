#pragma once

#include <functional>
#include <string>

#include "robot/runtime/roll_call.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// The beginning of orders' ids that no other operator has.
std::string operator_id();

/// Takes what robots say until then and hands their states to `hear`; troubles and texts that are
/// not a state to `note`. False: the transport has ended.
bool hear_states(OperatorEnd& end, TimePoint until,
                 const std::function<void(std::size_t, const NodeState&, const Now&)>& hear,
                 const std::function<void(const std::string&)>& note);

void send_order(OperatorEnd& end, const Order& order);

/// Robots and what the operator knows of them, as a table.
std::string roll_table(const RollCall& roll, TimePoint now);
/// The same as a JSON array.
std::string roll_json(const RollCall& roll, TimePoint now);

}  // namespace swarmsmith
