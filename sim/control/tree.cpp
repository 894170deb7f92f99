#include "sim/control/tree.h"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/assert.h"
#include "sim/control/flavour.h"
#include "sim/control/internal/fields.h"
#include "sim/control/internal/module_text.h"

namespace swarmsmith {
namespace {

// Kinds of node in the text.
constexpr int kSelector = 0;
constexpr int kSequenceWithMemory = 3;
constexpr int kAction = 5;
constexpr int kCondition = 6;

/// Takes a field that can have one value alone in Maple's trees.
std::optional<Error> need_value(Block& block, std::string_view stem, int value,
                                const std::string& meaning) {
  const Expected<Field> field = block.need(stem);
  if (!field) return field.error();
  const Expected<int> number = integer_of(*field);
  if (number && *number == value) return std::nullopt;
  return error_at(field->value, quoted(field->name.text) + " must be " + std::to_string(value) +
                                    ", " + meaning + ": only Maple's trees can be read");
}

/// The fields of subtree `index`, sorted into its own and those of its two children.
struct SubtreeBlocks {
  Block own;
  Block condition;
  Block action;
};

Expected<SubtreeBlocks> blocks_of(int index, std::span<const Field> fields, const Token& end) {
  const std::string name = std::to_string(index);
  SubtreeBlocks blocks{Block(name, end), Block(name + "0", end), Block(name + "1", end)};
  for (const Field& field : fields) {
    if (field.transition > 1) {
      return Unexpected(
          error_at(field.name, quoted(field.name.text) + ": a subtree has the children 0 and 1"));
    }
    Block& block = field.transition < 0    ? blocks.own
                   : field.transition == 0 ? blocks.condition
                                           : blocks.action;
    if (auto error = block.add(field)) return Unexpected(*error);
  }
  return blocks;
}

Expected<Condition> read_condition(Block& block, const Flavour& flavour) {
  if (auto error = need_value(block, "n", kCondition, "a condition")) return Unexpected(*error);
  const Expected<Field> selector = block.need("c");
  if (!selector) return Unexpected(selector.error());
  const auto spec = read_module(*selector, flavour.conditions, flavour);
  if (!spec) return Unexpected(spec.error());
  const auto values = read_parameters(**spec, block, flavour);
  if (!values) return Unexpected(values.error());
  if (auto error = block.check_empty(id_of((*spec)->module))) return Unexpected(*error);
  return make_condition((*spec)->module, *values);
}

Expected<Behaviour> read_action(Block& block, const Flavour& flavour) {
  if (auto error = need_value(block, "n", kAction, "an action")) return Unexpected(*error);
  const Expected<Field> selector = block.need("a");
  if (!selector) return Unexpected(selector.error());
  const auto spec = read_module(*selector, flavour.behaviours, flavour);
  if (!spec) return Unexpected(spec.error());
  const auto values = read_parameters(**spec, block, flavour);
  if (!values) return Unexpected(values.error());
  if (auto error = need_value(block, "p", 0, "an action that never reports success"))
    return Unexpected(*error);
  if (auto error = block.check_empty(id_of((*spec)->module))) return Unexpected(*error);
  return make_behaviour((*spec)->module, *values);
}

Expected<Subtree> read_subtree(int index, std::span<const Field> fields, const Token& end,
                               const Flavour& flavour) {
  auto blocks = blocks_of(index, fields, end);
  if (!blocks) return Unexpected(blocks.error());
  if (auto error = need_value(blocks->own, "n", kSelector, "a selector")) return Unexpected(*error);
  if (auto error = need_value(blocks->own, "nchild", 2, "a condition and an action"))
    return Unexpected(*error);
  if (auto error = blocks->own.check_empty("a selector")) return Unexpected(*error);
  const auto condition = read_condition(blocks->condition, flavour);
  if (!condition) return Unexpected(condition.error());
  const auto action = read_action(blocks->action, flavour);
  if (!action) return Unexpected(action.error());
  return Subtree{*condition, *action};
}

}  // namespace

std::optional<Error> check(const Tree& tree, const Flavour& flavour) {
  if (tree.subtrees.empty() || tree.subtrees.size() > kMaxSubtrees) {
    return Error{ErrorKind::BadInput, "a tree has 1 to 4 subtrees", ""};
  }
  for (std::size_t i = 0; i < tree.subtrees.size(); ++i) {
    const auto& [condition, action] = tree.subtrees[i];
    auto complaint =
        complaint_about_module(module_of(condition), parameters_of(condition), flavour);
    if (!complaint)
      complaint = complaint_about_module(module_of(action), parameters_of(action), flavour);
    if (complaint) return Error{ErrorKind::BadInput, *complaint, "subtree " + std::to_string(i)};
  }
  return std::nullopt;
}

Expected<Tree> parse_tree(std::string_view text, const Flavour& flavour) {
  const std::vector<Token> tokens = tokens_of(text);
  std::span<const Token> rest = tokens;
  if (rest[0].text == "--bt-config") rest = rest.subspan(1);
  const auto all = fields_of(rest, Between::Nothing);
  if (!all) return Unexpected(all.error());
  std::span<const Field> fields = *all;
  const Token& end = tokens.back();
  const auto first = [&]() -> const Token& { return fields.empty() ? end : fields[0].name; };
  if (first().text != "--nroot")
    return Unexpected(error_at(first(), "a tree begins with `--nroot`"));
  if (const auto kind = integer_of(fields[0]); !kind || *kind != kSequenceWithMemory) {
    return Unexpected(error_at(fields[0].value,
                               "`--nroot` must be 3, a sequence with memory: only Maple's trees "
                               "can be read"));
  }
  fields = fields.subspan(1);
  if (first().text != "--nchildroot")
    return Unexpected(error_at(first(), "expected `--nchildroot`"));
  const auto count = integer_of(fields[0], 1, kMaxSubtrees);
  if (!count) return Unexpected(count.error());
  fields = fields.subspan(1);
  Tree tree;
  for (int i = 0; i < *count; ++i) {
    std::size_t size = 0;
    while (size < fields.size() && fields[size].state == i)
      ++size;
    if (size == 0)
      return Unexpected(error_at(first(), "expected " + quoted("--n" + std::to_string(i))));
    const Token& block_end = size == fields.size() ? end : fields[size].name;
    auto subtree = read_subtree(i, fields.first(size), block_end, flavour);
    if (!subtree) return Unexpected(subtree.error());
    tree.subtrees.push_back(*subtree);
    fields = fields.subspan(size);
  }
  if (fields.empty()) return tree;
  return Unexpected(
      error_at(first(), "expected the end, since `--nchildroot` is " + std::to_string(*count)));
}

std::string print_tree(const Tree& tree, const Flavour& flavour) {
  if (const auto error = check(tree, flavour)) throw std::invalid_argument(to_string(*error));
  std::string text;
  append_switch(text, "nroot", "", std::to_string(kSequenceWithMemory));
  append_switch(text, "nchildroot", "", std::to_string(tree.subtrees.size()));
  for (std::size_t i = 0; i < tree.subtrees.size(); ++i) {
    const auto& [condition, action] = tree.subtrees[i];
    const std::string own = std::to_string(i);
    append_switch(text, "n", own, std::to_string(kSelector));
    append_switch(text, "nchild", own, "2");
    const ModuleSpec& waits = *flavour.find(module_of(condition));
    append_switch(text, "n", own + "0", std::to_string(kCondition));
    append_switch(text, "c", own + "0", std::to_string(waits.number));
    append_parameters(text, waits, parameters_of(condition), own + "0", flavour);
    const ModuleSpec& acts = *flavour.find(module_of(action));
    append_switch(text, "n", own + "1", std::to_string(kAction));
    append_switch(text, "a", own + "1", std::to_string(acts.number));
    append_parameters(text, acts, parameters_of(action), own + "1", flavour);
    append_switch(text, "p", own + "1", "0");
  }
  return text;
}

TreeControl::TreeControl(const Tree& tree, const Flavour& flavour, Rng rng)
    : tree_(&tree), flavour_(&flavour), rng_(rng), memories_(tree.subtrees.size()) {
  SWARMSMITH_ASSERT(!tree.subtrees.empty() && tree.subtrees.size() <= kMaxSubtrees,
                    "a tree has 1 to 4 subtrees");
}

Command TreeControl::step(Senses& senses) {
  while (true) {
    const auto at = static_cast<std::size_t>(subtree_);
    const Subtree& subtree = tree_->subtrees[at];
    const double probability = enabling_probability(subtree.condition, senses, *flavour_);
    if (!(probability > 0 && rng_.bernoulli(probability)))
      return act(subtree.action, senses, *flavour_, memories_[at], rng_);
    if (at + 1 == tree_->subtrees.size()) {
      subtree_ = 0;
      return {};  // the root succeeds: no action acts in this cycle
    }
    ++subtree_;
  }
}

}  // namespace swarmsmith
