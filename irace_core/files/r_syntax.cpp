#include "irace_core/files/r_syntax.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "irace_core/files/internal/r_lexer.h"

namespace swarmsmith::r {
namespace {

constexpr int kDeepestTree = 1000;    // so that recursion over it cannot exhaust the stack
constexpr int kDeepestNesting = 400;  // R itself stops at 50 open parentheses

/// The precedence of operators, loosest first (irace facts, 8.2).
enum Binding {
  kLoosest,
  kOr,
  kAnd,
  kNot,
  kComparison,
  kSum,
  kProduct,
  kPercent,
  kRange,
  kSign,
  kPower
};

/// The binding of a binary operator; nothing for any other token.
std::optional<Binding> binary_binding(const Token& token) {
  struct Entry {
    std::string_view op;
    Binding binding;
  };
  constexpr std::array<Entry, 16> kEntries = {{{"|", kOr},
                                               {"||", kOr},
                                               {"&", kAnd},
                                               {"&&", kAnd},
                                               {"==", kComparison},
                                               {"!=", kComparison},
                                               {"<", kComparison},
                                               {"<=", kComparison},
                                               {">", kComparison},
                                               {">=", kComparison},
                                               {"+", kSum},
                                               {"-", kSum},
                                               {"*", kProduct},
                                               {"/", kProduct},
                                               {":", kRange},
                                               {"^", kPower}}};
  if (token.kind != TokenKind::Operator) return std::nullopt;
  if (token.text.front() == '%') return kPercent;
  for (const Entry& entry : kEntries) {
    if (entry.op == token.text) return entry.binding;
  }
  return std::nullopt;
}

/// A node and the depth of its tree.
struct Tree {
  Node node;
  int depth = 1;
};

class Parser {
 public:
  Parser(std::string_view text, Place start) : lexer_(text, start) {}

  Expected<Node> whole_expression();
  Expected<std::vector<Statement>> statements();

 private:
  Expected<void> advance();
  /// Skips line ends at a place where an expression cannot be complete.
  Expected<void> skip_lines();
  Unexpected found_instead_of(const std::string& wanted) const {
    return bad_input("found " + describe(token_) + ", expected " + wanted, to_string(token_.place));
  }

  Expected<Statement> statement();
  Expected<Tree> expression(Binding loosest);
  Expected<Tree> operand();
  Expected<Tree> prefixed();
  Expected<Tree> parenthesised();
  Expected<Tree> named();
  Expected<Tree> call(std::string function, Place place);
  Expected<Argument> argument(int& depth);
  static Expected<Tree> operation(const Token& op, std::vector<Tree> operands);
  Expected<Tree> literal(Node node);

  Lexer lexer_;
  Token token_;          ///< the next token
  int parentheses_ = 0;  ///< inside parentheses, line ends are blanks
  int nesting_ = 0;
};

Expected<void> Parser::advance() {
  do {
    auto token = lexer_.next();
    if (!token) return Unexpected(token.error());
    token_ = std::move(*token);
  } while (token_.kind == TokenKind::LineEnd && parentheses_ > 0);
  return {};
}

Expected<void> Parser::skip_lines() {
  while (token_.kind == TokenKind::LineEnd) {
    if (auto moved = advance(); !moved) return moved;
  }
  return {};
}

Expected<Tree> Parser::literal(Node node) {
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  return Tree{std::move(node)};
}

Expected<Tree> Parser::operation(const Token& op, std::vector<Tree> operands) {
  Call call{op.text, {}};
  int depth = 0;
  for (Tree& operand : operands) {
    depth = std::max(depth, operand.depth);
    call.arguments.push_back({{}, std::move(operand.node)});
  }
  if (depth + 1 > kDeepestTree) {
    return bad_input("this expression is too long: split it up", to_string(op.place));
  }
  return Tree{{std::move(call), op.place}, depth + 1};
}

/// A prefix operator applies to everything after it that binds more tightly than the operator.
Expected<Tree> Parser::prefixed() {
  const Token op = token_;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  auto operand = expression(op.is("!") ? kNot : kSign);
  if (!operand) return operand;
  std::vector<Tree> operands;
  operands.push_back(std::move(*operand));
  return operation(op, std::move(operands));
}

Expected<Tree> Parser::parenthesised() {
  const Place open = token_.place;
  ++parentheses_;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  auto inner = expression(kLoosest);
  if (!inner) return inner;
  if (!token_.is(")")) return found_instead_of("')' for the '(' at " + to_string(open));
  --parentheses_;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  return inner;
}

Expected<Argument> Parser::argument(int& depth) {
  const bool may_be_name = token_.kind == TokenKind::Name || token_.kind == TokenKind::Text;
  const std::string name = token_.text;
  auto value = expression(kLoosest);
  if (!value) return Unexpected(value.error());
  Argument argument{{}, std::move(value->node)};
  depth = std::max(depth, value->depth);
  const bool is_name = may_be_name && value->depth == 1;
  if (!token_.is("=") || !is_name) return argument;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  auto named_value = expression(kLoosest);
  if (!named_value) return Unexpected(named_value.error());
  depth = std::max(depth, named_value->depth);
  return Argument{name, std::move(named_value->node)};
}

/// Parses a call, from the opening parenthesis on.
Expected<Tree> Parser::call(std::string function, Place place) {
  const Place open = token_.place;
  Call call{std::move(function), {}};
  int depth = 0;
  ++parentheses_;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  while (!token_.is(")")) {
    auto next = argument(depth);
    if (!next) return Unexpected(next.error());
    call.arguments.push_back(std::move(*next));
    if (token_.is(")")) break;
    if (!token_.is(",")) return found_instead_of("',' or ')' for the '(' at " + to_string(open));
    if (auto moved = advance(); !moved) return Unexpected(moved.error());
    if (token_.is(")")) return found_instead_of("another argument after ','");
  }
  --parentheses_;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  if (depth + 1 > kDeepestTree) {
    return bad_input("this expression is too long: split it up", to_string(place));
  }
  return Tree{{std::move(call), place}, depth + 1};
}

/// Parses a name, a constant that is written like one, or a call.
Expected<Tree> Parser::named() {
  constexpr std::array<std::string_view, 9> kReserved = {
      "function", "if", "else", "for", "while", "repeat", "break", "next", "in"};
  const Token name = token_;
  if (!name.quoted) {
    if (std::find(kReserved.begin(), kReserved.end(), name.text) != kReserved.end()) {
      return bad_input("found '" + name.text + "': programs in R are not read here, only values",
                       to_string(name.place));
    }
    if (name.text == "TRUE") return literal({Logical{true}, name.place});
    if (name.text == "FALSE") return literal({Logical{false}, name.place});
    if (name.text == "NULL") return literal({Null{}, name.place});
    if (name.text == "NA") return literal({Logical{}, name.place});
    using Limits = std::numeric_limits<double>;
    if (name.text == "Inf") return literal({Number{Limits::infinity()}, name.place});
    if (name.text == "NaN") return literal({Number{Limits::quiet_NaN()}, name.place});
  }
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  if (token_.is("(")) return call(name.text, name.place);
  return Tree{{Name{name.text}, name.place}};
}

Expected<Tree> Parser::operand() {
  if (auto skipped = skip_lines(); !skipped) return Unexpected(skipped.error());
  switch (token_.kind) {
    case TokenKind::Number:
      return literal({token_.number, token_.place});
    case TokenKind::Text:
      return literal({Text{token_.text}, token_.place});
    case TokenKind::Name:
      return named();
    case TokenKind::Operator:
      if (token_.is("(")) return parenthesised();
      if (token_.is("!") || token_.is("-") || token_.is("+")) return prefixed();
      break;
    case TokenKind::LineEnd:
    case TokenKind::End:
      break;
  }
  return found_instead_of("a value, a name or '('");
}

/// Parses everything from here on whose operators bind more tightly than `loosest`, or equally
/// tightly for the prefix operators and ^, which group to the right.
Expected<Tree> Parser::expression(Binding loosest) {
  if (++nesting_ > kDeepestNesting) {
    return bad_input("this expression is nested too deeply", to_string(token_.place));
  }
  auto left = operand();
  bool compared = false;
  while (left) {
    const std::optional<Binding> binding = binary_binding(token_);
    if (!binding || *binding < loosest) break;
    if (*binding == kComparison && compared) {
      return bad_input("found a second comparison; write a < b & b < c for a < b < c",
                       to_string(token_.place));
    }
    compared = *binding == kComparison;
    const Token op = token_;
    if (auto moved = advance(); !moved) return Unexpected(moved.error());
    auto right = expression(*binding == kPower ? kPower : static_cast<Binding>(*binding + 1));
    if (!right) return right;
    std::vector<Tree> operands;
    operands.push_back(std::move(*left));
    operands.push_back(std::move(*right));
    left = operation(op, std::move(operands));
  }
  --nesting_;
  return left;
}

Expected<Node> Parser::whole_expression() {
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  auto tree = expression(kLoosest);
  if (!tree) return Unexpected(tree.error());
  if (auto skipped = skip_lines(); !skipped) return Unexpected(skipped.error());
  if (token_.is("=")) return found_instead_of("an operator; to compare write ==");
  if (token_.kind != TokenKind::End) return found_instead_of("an operator or the end");
  return std::move(tree->node);
}

Expected<Statement> Parser::statement() {
  Statement statement{{}, {}, token_.place};
  auto tree = expression(kLoosest);
  if (!tree) return Unexpected(tree.error());
  if (token_.is("=") || token_.is("<-")) {
    if (const auto* name = std::get_if<Name>(&tree->node.what)) statement.name = name->value;
    if (const auto* text = std::get_if<Text>(&tree->node.what)) statement.name = text->value;
    if (statement.name.empty()) return found_instead_of("a name before it");
    if (auto moved = advance(); !moved) return Unexpected(moved.error());
    tree = expression(kLoosest);
    if (!tree) return Unexpected(tree.error());
  } else if (token_.is("->")) {
    if (auto moved = advance(); !moved) return Unexpected(moved.error());
    if (token_.kind != TokenKind::Name) return found_instead_of("a name after it");
    statement.name = token_.text;
    if (auto moved = advance(); !moved) return Unexpected(moved.error());
  }
  statement.value = std::move(tree->node);
  return statement;
}

Expected<std::vector<Statement>> Parser::statements() {
  std::vector<Statement> all;
  if (auto moved = advance(); !moved) return Unexpected(moved.error());
  for (;;) {
    while (token_.is(";") || token_.kind == TokenKind::LineEnd) {
      if (auto moved = advance(); !moved) return Unexpected(moved.error());
    }
    if (token_.kind == TokenKind::End) return all;
    auto next = statement();
    if (!next) return Unexpected(next.error());
    all.push_back(std::move(*next));
    const bool ended =
        token_.is(";") || token_.kind == TokenKind::LineEnd || token_.kind == TokenKind::End;
    if (!ended) return found_instead_of("an operator or the end of the line");
  }
}

}  // namespace

std::string to_string(Place place) {
  return std::to_string(place.line) + ":" + std::to_string(place.column);
}

std::optional<bool> logical_of(const Node& node) {
  if (const auto* logical = std::get_if<Logical>(&node.what)) return logical->value;
  const auto* name = std::get_if<Name>(&node.what);
  if (name != nullptr && name->value == "T") return true;
  if (name != nullptr && name->value == "F") return false;
  return std::nullopt;
}

Expected<Node> parse_expression(std::string_view text, Place start) {
  return Parser(text, start).whole_expression();
}

Expected<std::vector<Statement>> parse_statements(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    text.remove_prefix(kByteOrderMark.size());
  }
  return Parser(text, {}).statements();
}

}  // namespace swarmsmith::r
