#include "storage/internal/candidate_code.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace swarmsmith {
namespace {

/// Maximum number of phrases. Texts that never repeat would otherwise fill the table and the
/// memory.
constexpr std::size_t kMostPhrases = 50'000;
/// Maximum number of parameters in a phrase: each one multiplies the number of phrases by its
/// choices. Measured on a real design of 100,000 evaluations: with 3 the store is 0.1 MB larger;
/// with 6 the phrases take as much space as the codes save.
constexpr std::size_t kMostParameters = 4;
constexpr std::size_t kModulesInPhrase = 2;

/// A member of a flat JSON object, as text.
struct Member {
  std::string_view name;   ///< without quotes
  std::string_view text;   ///< `"name":value`
  std::string_view value;  ///< a string with its quotes, a number, true, false or null
};

bool is_number(std::string_view value) {
  return !value.empty() && (value.front() == '-' || (value.front() >= '0' && value.front() <= '9'));
}

/// The end of the string whose opening quote is at `at`: one past the closing quote.
std::optional<std::size_t> end_of_string(std::string_view text, std::size_t at) {
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '"') return i + 1;
    if (text[i] == '\\') ++i;
  }
  return std::nullopt;
}

/// The end of a number or a word that has no character with a meaning in a code.
std::optional<std::size_t> end_of_word(std::string_view text, std::size_t at) {
  const auto is_part = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '-' || c == '+' || c == '.' ||
           c == 'E';
  };
  std::size_t end = at;
  while (end < text.size() && is_part(text[end]))
    ++end;
  return end == at ? std::nullopt : std::optional(end);
}

/// The members of an object without blanks, arrays or inner objects; empty for any other text.
std::optional<std::vector<Member>> members_of(std::string_view text) {
  if (text.size() < 2 || text.front() != '{' || text.find('\0') != std::string_view::npos)
    return std::nullopt;
  std::vector<Member> members;
  std::size_t at = 1;
  while (at < text.size() && text[at] == '"') {
    const std::size_t begin = at;
    const auto name_end = end_of_string(text, at);
    if (!name_end || *name_end + 1 >= text.size() || text[*name_end] != ':') return std::nullopt;
    const std::size_t value = *name_end + 1;
    const auto end = text[value] == '"' ? end_of_string(text, value) : end_of_word(text, value);
    if (!end || *end >= text.size()) return std::nullopt;
    members.push_back({text.substr(begin + 1, *name_end - begin - 2),
                       text.substr(begin, *end - begin), text.substr(value, *end - value)});
    if (text[*end] == '}' && *end + 1 == text.size()) return members;
    if (text[*end] != ',') return std::nullopt;
    at = *end + 1;
  }
  return std::nullopt;
}

/// The text of a machine, cut before each switch (a blank, a dash, and no digit).
std::vector<std::string_view> switches_of(std::string_view machine) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (std::size_t i = 1; i + 2 < machine.size(); ++i) {
    const char next = machine[i + 2];
    if (machine[i] != ' ' || machine[i + 1] != '-' || next == '.' || (next >= '0' && next <= '9'))
      continue;
    parts.push_back(machine.substr(begin, i - begin));
    begin = i + 1;
  }
  parts.push_back(machine.substr(begin));
  return parts;
}

/// Whether there is a switch for each parameter, which ends with the parameter's number if it has
/// one.
bool run_along(const std::vector<Member>& members, const std::vector<std::string_view>& switches) {
  if (members.size() != switches.size()) return false;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_number(members[i].value) && !switches[i].ends_with(members[i].value)) return false;
  return true;
}

void join(std::optional<std::string>& text, std::string_view more, char between) {
  if (!text) {
    text = more;
  } else {
    *text += between;
    *text += more;
  }
}

/// A text that is different for different phrases. Each part is preceded by its length, or is "-"
/// if the phrase lacks it, so that no content of the parts can make the keys of two phrases equal.
std::string key_of(const Phrase& phrase) {
  std::string key;
  for (const auto* text : {&phrase.machine, &phrase.parameters, &phrase.modules})
    key += *text ? std::to_string((*text)->size()) + "," + **text : "-";
  return key;
}

/// Takes `text` from the front of `from`, if it is there.
bool take(std::string_view& from, std::string_view text) {
  if (!from.starts_with(text)) return false;
  from.remove_prefix(text.size());
  return true;
}

bool take(std::string_view& from, std::int64_t& number) {
  const auto [end, error] = std::from_chars(from.data(), from.data() + from.size(), number);
  if (error != std::errc()) return false;
  from.remove_prefix(static_cast<std::size_t>(end - from.data()));
  return true;
}

/// Calls `on_piece` with each phrase of {"1":"56","2":"0.5"} and the number after it. False when
/// `on_piece` returns false, or the text is not a code.
template <class OnPiece>
bool each_piece(std::string_view code, OnPiece on_piece) {
  if (!take(code, "{")) return false;
  do {
    std::int64_t number = 0;
    if (!take(code, "\"") || !take(code, number) || !take(code, "\":\"")) return false;
    const std::string_view value = code.substr(0, code.find('"'));
    if (!on_piece(number, value)) return false;
    code.remove_prefix(value.size());
    if (!take(code, "\"")) return false;
  } while (take(code, ","));
  return code == "}";
}

/// The same for [3,4].
template <class OnPhrase>
bool each_phrase(std::string_view code, OnPhrase on_phrase) {
  if (!take(code, "[")) return false;
  do {
    std::int64_t number = 0;
    if (!take(code, number) || !on_phrase(number, std::string_view())) return false;
  } while (take(code, ","));
  return code == "]";
}

}  // namespace

void PhraseBook::clear() {
  phrases_.clear();
  numbers_.clear();
  open_.clear();
  last_ = 0;
  left_ = kAlwaysAllowed;
}

void PhraseBook::load(const sqlite::Connection& connection) {
  clear();
  sqlite::Statement row(connection, "SELECT id, machine, parameters, modules FROM phrase");
  const auto text = [&row](int column) {
    return row.is_null(column) ? std::nullopt : std::optional(row.text(column));
  };
  while (row.step())
    add(row.integer(0), {.machine = text(1), .parameters = text(2), .modules = text(3)});
  left_ += kMostTimesFile * sqlite::integer_of(connection, "PRAGMA page_count") *
           sqlite::integer_of(connection, "PRAGMA page_size");
}

void PhraseBook::add(std::int64_t number, Phrase phrase) {
  // A phrase before a number ends with the parameter's name, so `open_` need not be stored.
  if (phrase.parameters && phrase.parameters->ends_with("\":")) {
    const std::string before = phrase.parameters->substr(0, phrase.parameters->size() - 2);
    open_.emplace(before.substr(before.rfind('"') + 1));
  }
  numbers_.emplace(key_of(phrase), number);
  phrases_.emplace(number, std::move(phrase));
  last_ = std::max(last_, number);
}

std::optional<std::vector<PhraseBook::Piece>> PhraseBook::cut_parameters(
    const std::string& parameters, const std::string& machine) {
  const auto members = members_of(parameters);
  if (!members) return std::nullopt;
  const auto switches = switches_of(machine);
  // SQLite's operators treat a zero byte as the end of a text.
  const bool with_machine =
      run_along(*members, switches) && machine.find('\0') == std::string::npos;
  std::vector<Piece> pieces(1);
  std::size_t in_piece = 0;
  for (std::size_t i = 0; i < members->size(); ++i) {
    const Member& member = (*members)[i];
    const bool number = is_number(member.value);
    const bool small = member.value.size() == 1 && member.value != "9";
    const std::string name(member.name);
    if (number && !small) open_.insert(name);
    const bool ends = number && open_.contains(name);
    if (in_piece++ == kMostParameters && !ends) {
      pieces.emplace_back();
      in_piece = 1;
    }
    Piece& piece = pieces.back();
    const std::size_t cut = ends ? member.value.size() : 0;
    join(piece.phrase.parameters, member.text.substr(0, member.text.size() - cut), ',');
    if (with_machine)
      join(piece.phrase.machine, switches[i].substr(0, switches[i].size() - cut), ' ');
    if (!ends) continue;
    piece.number = member.value;
    in_piece = 0;
    if (i + 1 < members->size()) pieces.emplace_back();
  }
  return pieces;
}

std::optional<std::vector<std::int64_t>> PhraseBook::numbers_of(const std::vector<Piece>& pieces,
                                                                const OnNew& on_new) {
  std::vector<std::string> keys;
  std::size_t unknown = 0;
  for (const Piece& piece : pieces) {
    keys.push_back(key_of(piece.phrase));
    unknown += numbers_.contains(keys.back()) ? 0U : 1U;
  }
  if (numbers_.size() + unknown > kMostPhrases) return std::nullopt;
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!numbers_.contains(keys[i])) {
      const std::int64_t number = last_ + 1;
      on_new(number, pieces[i].phrase);
      add(number, pieces[i].phrase);
    }
    numbers.push_back(numbers_.at(keys[i]));
  }
  return numbers;
}

void PhraseBook::encode_parameters(const OnNew& on_new, StoredTexts& stored) {
  const auto pieces = cut_parameters(stored.parameters, stored.machine);
  if (!pieces) return;
  const auto numbers = numbers_of(*pieces, on_new);
  if (!numbers) return;
  std::string code;
  for (std::size_t i = 0; i < pieces->size(); ++i) {
    const std::string number = std::to_string((*numbers)[i]);
    code.append(i == 0 ? "{\"" : ",\"").append(number).append("\":\"");
    code.append((*pieces)[i].number).append("\"");
  }
  stored.code = code + "}";
  stored.parameters.clear();
  if (pieces->front().phrase.machine) stored.machine.clear();
}

void PhraseBook::encode_modules(const OnNew& on_new, StoredTexts& stored) {
  const auto modules = members_of(stored.modules);
  if (!modules) return;
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < modules->size(); ++i) {
    if (i % kModulesInPhrase == 0) pieces.emplace_back();
    join(pieces.back().phrase.modules, (*modules)[i].text, ',');
  }
  const auto numbers = numbers_of(pieces, on_new);
  if (!numbers) return;
  std::string code;
  for (const std::int64_t number : *numbers)
    code.append(code.empty() ? "[" : ",").append(std::to_string(number));
  stored.module_code = code + "]";
  stored.modules.clear();
}

StoredTexts PhraseBook::encode(const CandidateRow& row, const OnNew& on_new) {
  StoredTexts stored{.machine = row.machine,
                     .parameters = row.parameters,
                     .modules = row.modules,
                     .code = {},
                     .module_code = {}};
  encode_parameters(on_new, stored);
  encode_modules(on_new, stored);
  return stored;
}

bool PhraseBook::decode(const StoredTexts& stored, CandidateRow& row) {
  row.machine = stored.machine;
  row.parameters = stored.parameters;
  row.modules = stored.modules;
  for (const std::string* text : {&row.machine, &row.parameters, &row.modules})
    if (text->size() > kMostTextBytes) return false;
  std::optional<std::string> machine, parameters, modules;
  const auto extend = [&](std::optional<std::string>& text, const std::optional<std::string>& more,
                          std::string_view number, char between) {
    if (!more) return true;
    const std::size_t bytes = more->size() + number.size() + 1;
    left_ -= static_cast<std::int64_t>(bytes);
    if (left_ < 0 || (text ? text->size() : 0) + bytes > kMostTextBytes) return false;
    join(text, *more, between);
    *text += number;
    return true;
  };
  const auto say = [&](std::int64_t number, std::string_view value) {
    const auto known = phrases_.find(number);
    if (known == phrases_.end()) return false;
    return extend(machine, known->second.machine, value, ' ') &&
           extend(parameters, known->second.parameters, value, ',') &&
           extend(modules, known->second.modules, value, ',');
  };
  if (stored.code) {
    if (!each_piece(*stored.code, say)) return false;
    if (row.machine.empty()) row.machine = machine.value_or("");
    row.parameters = "{" + parameters.value_or("") + "}";
  }
  if (stored.module_code) {
    if (!each_phrase(*stored.module_code, say)) return false;
    row.modules = "{" + modules.value_or("") + "}";
  }
  return true;
}

}  // namespace swarmsmith
