#pragma once

#include <functional>
#include <string>

#include "robot/runtime/roll_call.h"
#include "robot/transport/ends.h"

namespace swarmsmith {

/// A prefix for the ids of orders that no other operator uses.
std::string operator_id();

/// Takes messages from robots until then and passes their states to `hear`; troubles, and texts
/// that are not a state, go to `note`. False: the transport has ended.
bool hear_states(OperatorEnd& end, TimePoint until,
                 const std::function<void(std::size_t, const NodeState&, const Now&)>& hear,
                 const std::function<void(const std::string&)>& note);

void send_order(OperatorEnd& end, const Order& order);

/// The robots, with the operator's information on them, as a table.
std::string roll_table(const RollCall& roll, TimePoint now);
/// The same as a JSON array.
std::string roll_json(const RollCall& roll, TimePoint now);

}  // namespace swarmsmith
