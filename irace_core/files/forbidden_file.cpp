#include "irace_core/files/forbidden_file.h"

#include "irace_core/files/internal/line_reader.h"
#include "irace_core/files/internal/read_expression.h"

namespace swarmsmith {

Expected<std::vector<Expression>> parse_forbidden_file(const IraceText& source,
                                                       std::span<const std::string> names,
                                                       std::vector<Error>& warnings) {
  std::vector<Expression> clauses;
  std::size_t number = 0;
  for (const std::string_view text : irace::split_lines(source.text)) {
    irace::LineReader line(source.file, text, ++number);
    if (line.at_comment_or_end()) continue;
    auto clause = irace::read_forbidden_line({std::string(line.rest()), line.place()}, source.file,
                                             names, warnings);
    if (!clause) return Unexpected(clause.error());
    clauses.push_back(std::move(*clause));
  }
  return clauses;
}

}  // namespace swarmsmith
