#include "irace_core/files/foreign_space.h"

#include <algorithm>

#include "irace_core/files/parameter_file.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Spaces of other tools. What is read reads back from irace's text of it, and the first
/// configuration is one of the space.
void run(std::string_view input) {
  const IraceText source{std::string(input), "p"};
  for (const auto& parse : {parse_pcs_file, parse_config_space}) {
    const auto read = parse(source, {});
    if (!read) {
      require(!read.error().where.empty(), "an error has a place");
      continue;
    }
    const auto again = parse_parameter_file({{read->text, "again"}, {}, {}, {}});
    require(again.has_value(), "what is printed can be read: " + read->text);
    require(std::ranges::equal(read->space.parameters(), again->space.parameters()),
            "the same parameters");
    require(std::ranges::equal(read->space.forbidden(), again->space.forbidden()),
            "the same forbidden clauses");
    if (read->initial) require(read->space.check(*read->initial).has_value(), "defaults fit");
  }
}

}  // namespace swarmsmith::fuzz
