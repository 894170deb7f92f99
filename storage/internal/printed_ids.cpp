#include "storage/internal/printed_ids.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>
#include <vector>

#include "base/id.h"

namespace swarmsmith {
namespace {

struct Token {
  enum class Kind { Word, Text, Sign } kind = Kind::Sign;
  std::string_view text;  ///< including its quotes
};
using Tokens = std::vector<Token>;

bool is_of_word(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '$' ||
         (static_cast<unsigned char>(letter) & 0x80U) != 0;
}

/// Length of the token at the beginning of `rest`: a quoted text, a comment, a word, or a sign.
std::size_t length_of(std::string_view rest) {
  const auto until = [&](std::string_view end, std::size_t from) {
    const std::size_t at = rest.find(end, from);
    return at == std::string_view::npos ? rest.size() : at + end.size();
  };
  if (rest.starts_with("--")) return until("\n", 2);
  if (rest.starts_with("/*")) return until("*/", 2);
  if (rest.front() == '[') return until("]", 1);
  if (std::string_view("'\"`").find(rest.front()) != std::string_view::npos) {
    std::size_t end = until(rest.substr(0, 1), 1);
    while (end < rest.size() && rest[end] == rest.front())  // a doubled quote is part of the text
      end = until(rest.substr(0, 1), end + 1);
    return end;
  }
  if (is_of_word(rest.front()))
    return static_cast<std::size_t>(std::ranges::find_if_not(rest, is_of_word) - rest.begin());
  constexpr std::array<std::string_view, 5> kSigns = {"==", "<=", ">=", "<>", "!="};
  return std::ranges::any_of(kSigns, [&](auto sign) { return rest.starts_with(sign); }) ? 2 : 1;
}

Tokens tokens_of(std::string_view sql) {
  Tokens tokens;
  for (std::size_t at = 0; at < sql.size();) {
    const std::string_view text = sql.substr(at, length_of(sql.substr(at)));
    at += text.size();
    const bool is_space = std::isspace(static_cast<unsigned char>(text.front())) != 0;
    if (is_space || text.starts_with("--") || text.starts_with("/*")) continue;
    Token::Kind kind = Token::Kind::Sign;
    if (text.front() == '\'') kind = Token::Kind::Text;
    if (is_of_word(text.front()) ||
        std::string_view("\"`[").find(text.front()) != std::string_view::npos)
      kind = Token::Kind::Word;
    tokens.push_back({kind, text});
  }
  return tokens;
}

bool is_word(const Token& token, std::string_view word) {
  return std::ranges::equal(token.text, word, [](char a, char b) {
    return std::toupper(static_cast<unsigned char>(a)) == b;
  });
}

bool compares(const Token& token) {
  constexpr std::array<std::string_view, 8> kSigns = {"=", "==", "<", ">", "<=", ">=", "<>", "!="};
  return std::ranges::find(kSigns, token.text) != kSigns.end();
}

/// The letter of the ids in a column with this name; 0 for other columns.
char letter_of(const Token& token) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kColumns = {{{"DESIGN", 'd'},
                                                                          {"CANDIDATE", 'c'},
                                                                          {"PARENT", 'c'},
                                                                          {"BEST_CANDIDATE", 'c'},
                                                                          {"BEST", 'c'}}};
  if (token.kind != Token::Kind::Word) return 0;
  Token name = token;
  if (!is_of_word(name.text.front()) && name.text.size() > 2)
    name.text = name.text.substr(1, name.text.size() - 2);
  const auto found = std::ranges::find_if(
      kColumns, [&](const auto& column) { return is_word(name, column.first); });
  return found == kColumns.end() ? '\0' : found->second;
}

/// The letter of the column that the text at `place` is compared with; the column may be before or
/// after it.
char letter_beside(const Tokens& tokens, std::size_t place) {
  const auto before = [&](std::size_t back) {
    return back <= place ? tokens[place - back] : Token{};
  };
  std::size_t back = 1;
  // IN ('c1', 'c2')
  while (before(back).text == "," && before(back + 1).kind == Token::Kind::Text)
    back += 2;
  if (before(back).text == "(" && is_word(before(back + 1), "IN")) {
    back += 2;
  } else if (back > 1) {
    return 0;
  } else if (is_word(before(1), "AND") && is_word(before(3), "BETWEEN")) {
    back = 4;
  } else if (is_word(before(1), "BETWEEN") || compares(before(1))) {
    back = 2;
  } else if (is_word(before(1), "IS") || (is_word(before(1), "NOT") && is_word(before(2), "IS"))) {
    back = is_word(before(1), "IS") ? 2 : 3;
  } else {
    back = 0;
  }
  if (back > 0) return letter_of(before(is_word(before(back), "NOT") ? back + 1 : back));
  std::size_t next = place + 2;
  if (next >= tokens.size() || !compares(tokens[place + 1])) return 0;
  while (next + 2 < tokens.size() && tokens[next + 1].text == ".")
    next += 2;
  return letter_of(tokens[next]);
}

/// The number in 'c812' or 'd3'.
std::optional<std::int64_t> number_in(std::string_view quoted) {
  if (quoted.size() < 4) return std::nullopt;
  const std::string_view text = quoted.substr(1, quoted.size() - 2);
  if (const auto id = id_from_text<CandidateTag>(text)) return id->value;
  if (const auto id = id_from_text<DesignTag>(text)) return id->value;
  return std::nullopt;
}

}  // namespace

std::string with_numbers_of_ids(std::string_view sql) {
  std::string result;
  std::size_t copied = 0;
  const auto lacks = [&](std::string_view part) {
    return sql.find(part) == std::string_view::npos;
  };
  if (lacks("'c") && lacks("'d")) return std::string(sql);
  const Tokens tokens = tokens_of(sql);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string_view text = tokens[i].text;
    if (tokens[i].kind != Token::Kind::Text) continue;
    const auto number = number_in(text);
    if (!number || letter_beside(tokens, i) != text[1]) continue;
    const auto at = static_cast<std::size_t>(text.data() - sql.data());
    result += sql.substr(copied, at - copied);
    result += std::to_string(*number);
    copied = at + text.size();
  }
  result += sql.substr(copied);
  return result;
}

}  // namespace swarmsmith
