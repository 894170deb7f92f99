#include "robot/app/machine_word.h"

#include <utility>

#include "base/text/whole_file.h"
#include "robot/runtime/robot_kind.h"
#include "sim/control/flavour_file.h"
#include "sim/engine/fitting.h"
#include "sim/files/machine_file.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

Expected<FiledMachine> filed_machine(const std::string& word) {
  if (architecture_of_text(word))
    return FiledMachine{.head = {}, .name = "", .text = word, .place = "--machine"};
  const auto text = read_file(word, "machine");
  if (!text) return Unexpected(text.error());
  auto machines = parse_machine_file(*text, word);
  if (!machines) return Unexpected(machines.error().front());
  if (machines->size() > 1) {
    return bad_input("the file has " + std::to_string(machines->size()) +
                         " machines, but a robot runs only one: write it into its own file "
                         "(swarmsmith export demo.db --design d1 -o best.fsm)",
                     word);
  }
  return std::move(machines->front());
}

}  // namespace

Expected<RobotMachine> robot_machine(const std::string& word, std::string flavour,
                                     std::optional<TurnClock> turn_clock, const Robot& kind) {
  const auto filed = filed_machine(word);
  if (!filed) return Unexpected(filed.error());
  if (flavour.empty()) flavour = filed->head.flavour;
  if (flavour.empty()) {
    return bad_input(
        "the machine does not name its flavour, and its meaning depends on the "
        "flavour: give --flavour",
        filed->place);
  }
  if (!turn_clock) turn_clock = filed->head.turn_clock;
  const Flavour* own = filed->head.own_flavour;
  if (flavour != filed->head.flavour) {
    auto given = find_flavour_file(flavour, {});
    if (!given) return Unexpected(given.error().front());
    flavour = given->name;
    own = kept_flavour(std::move(*given));
  }
  const auto found = find_flavour(flavour, own);
  if (!found) return Unexpected(found.error());
  Flavour known = **found;
  if (turn_clock) known.exploration.turn_clock = *turn_clock;
  if (const auto& mission = filed->head.mission) {
    if (auto why = other_robot("the machine", mission->mission.robot, kind))
      return bad_input(std::move(*why), filed->place);
  }
  if (const auto why = misfit(known, kind))
    return bad_input(*why + "; give a machine of another flavour, or another --kind of robot",
                     filed->place);
  auto controller = parse_controller(filed->text, known);
  if (!controller) {
    Error error = controller.error();
    error.where = filed->place + (error.where.empty() ? "" : ", " + error.where);
    return Unexpected(std::move(error));
  }
  if (const auto complaint = complaint_about_running(*controller, known))
    return bad_input(*complaint, filed->place);
  return RobotMachine{std::move(known), std::move(*controller)};
}

Expected<Robot> find_kind(const std::string& word) {
  auto robot = find_robot(word, {});
  if (!robot) return Unexpected(robot.error().front());
  if (auto why = no_node_drives(*robot)) return bad_input(std::move(*why), "--kind " + word);
  return std::move(*robot);
}

}  // namespace swarmsmith
