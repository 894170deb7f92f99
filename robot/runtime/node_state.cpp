#include "robot/runtime/node_state.h"

#include "robot/runtime/internal/json_fields.h"

namespace swarmsmith {

std::string state_text(const NodeState& state) {
  JsonFieldWriter writer;
  visit_state_fields(state, writer);
  return writer.text();
}

Expected<NodeState> parse_state(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return bad_input("a node's state is a JSON object");
  JsonFieldReader reader(json);
  NodeState state;
  visit_state_fields(state, reader);
  if (!reader.error().empty()) return bad_input(reader.error());
  return state;
}

}  // namespace swarmsmith
