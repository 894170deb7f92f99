#include "irace_core/files/r_syntax.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

int depth(const r::Node& node) {
  int deepest = 0;
  if (const auto* call = std::get_if<r::Call>(&node.what)) {
    for (const r::Argument& argument : call->arguments)
      deepest = std::max(deepest, depth(argument.value));
  }
  return deepest + 1;
}

}  // namespace

/// Statements are read, or refused at a place within the text; no tree is too deep.
void run(std::string_view input) {
  const auto statements = r::parse_statements(input);
  if (!statements) return require_reasons({statements.error()});
  for (const r::Statement& statement : *statements)
    require(depth(statement.value) <= 1000, "trees are not deeper than 1000");
}

}  // namespace swarmsmith::fuzz
