#include "irace_core/files/parameter_file.h"

#include <algorithm>

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

void require_same(const ParameterSpace& a, const ParameterSpace& b) {
  require(std::ranges::equal(a.parameters(), b.parameters()), "the same parameters");
  require(std::ranges::equal(a.forbidden(), b.forbidden()), "the same forbidden clauses");
  require(a.digits() == b.digits(), "the same digits");
}

/// The part of `rest` before a line of that mark; `rest` keeps what is behind.
std::string cut(std::string_view& rest, std::string_view mark) {
  const std::size_t end = std::min(rest.find(mark), rest.size());
  std::string part(rest.substr(0, end));
  rest.remove_prefix(std::min(end + mark.size(), rest.size()));
  return part;
}

}  // namespace

/// Parameters, then perhaps "\n@forbidden\n" and a forbidden file, then perhaps "\n@dependency\n"
/// and a dependency file. What is read reads back from what is printed.
void run(std::string_view input) {
  std::string_view dependency = input;
  const std::string before = cut(dependency, "\n@dependency\n");
  std::string_view forbidden = before;
  ParameterSources sources;
  sources.parameters = {cut(forbidden, "\n@forbidden\n"), "p"};
  if (!forbidden.empty()) sources.forbidden = IraceText{std::string(forbidden), "f"};
  if (!dependency.empty()) sources.dependency = IraceText{std::string(dependency), "d"};
  if (input.size() % 2 == 1) sources.digits = 2;
  const auto file = parse_parameter_file(sources);
  if (!file) return require_reasons({file.error()});
  const auto text = print_parameter_file(file->space);
  if (!text) return;  // a value that the format cannot hold, in a text that got by without quotes
  const auto again = parse_parameter_file({{*text, "again"}, {}, {}, {}});
  require(again.has_value(), "what is printed can be read: " + *text);
  require_same(file->space, again->space);
  const auto older = print_irace_35_files(file->space);
  require(older.has_value(), "what irace 4 can hold, irace 3.5 can");
  const auto from_older = parse_parameter_file(
      {{older->parameters, "older"}, IraceText{older->forbidden, "f"}, {}, older->digits});
  require(from_older.has_value(), "what is printed for irace 3.5 can be read");
  require_same(file->space, from_older->space);
}

}  // namespace swarmsmith::fuzz
