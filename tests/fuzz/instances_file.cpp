#include "irace_core/files/instances_file.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Every text is a list of instances, which reads back from what is printed.
void run(std::string_view input) {
  const std::vector<std::string> instances = parse_instances(input);
  const auto printed = print_instances(instances);
  require(printed.has_value(), "what was read from a list can be printed as one");
  require(parse_instances(*printed) == instances, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
