#include "sim/control/foreign_text.h"

#include <cstddef>

#include "sim/control/internal/fields.h"
#include "sim/control/internal/genome.h"

namespace swarmsmith {
namespace {

/// True for `--robots` and `-n`, but not for a dash or a negative number.
bool is_option(std::string_view word) {
  if (word.starts_with("--")) return true;
  if (word.size() < 2 || word.front() != '-') return false;
  return (word[1] >= 'a' && word[1] <= 'z') || (word[1] >= 'A' && word[1] <= 'Z');
}

}  // namespace

std::optional<std::string> complaint_about_name(std::string_view before) {
  constexpr std::size_t kMost = 8;
  std::string names;
  std::size_t count = 0;
  for (const Token& token : tokens_of(before)) {
    if (!is_option(token.text) || ++count > kMost) continue;
    names += (names.empty() ? "" : ", ") + quoted(token.text);
  }
  if (count == 0) return std::nullopt;
  if (count > kMost) names += ", ...";
  return "unknown options before the machine: " + names +
         "; the machine was made for a program that uses them, and without them it would behave "
         "differently";
}

std::optional<std::string> remark_about(std::string_view text) {
  if (!text.starts_with(kGenomeStart)) return std::nullopt;
  // The programs of genomes with the inputs rm1.1 read everything in the same units.
  const auto network = read_genome(tokens_of(text));
  if (network && network->inputs == NetworkInputs::Rm11) return std::nullopt;
  return "genomes are read as networks with the inputs rm1.2, in the order of their nodes; the "
         "programs that made them read neighbours and floor in other units, so scores differ "
         "(docs/methods.md)";
}

}  // namespace swarmsmith
