#include "tests/sim/engine/reference_runs.h"

#include <cstdint>

#include "sim/control/machine_text.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {

ReferenceRuns::ReferenceRuns(const char* mission_name)
    : mission(built_in_mission(mission_name).value()),
      instances(reference_instances(mission)),
      flavour(&watermelon_argos3()),
      profile(built_in_profile("argos3").value()) {}

Measured ReferenceRuns::run(const Controller& controller, int seed, int stream,
                            const Recorder& recorder) const {
  return simulate({.controller = controller,
                   .flavour = *flavour,
                   .profile = profile,
                   .mission = mission,
                   .instance = instances.at(static_cast<std::size_t>(seed - 1)),
                   .seed = seed + std::int64_t{1000} * stream},
                  recorder);
}

Machine machine_of(const std::string& text, const Flavour& flavour) {
  return parse_machine(text, flavour).value();
}

}  // namespace swarmsmith
