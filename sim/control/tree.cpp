#include "sim/control/tree.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
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
constexpr int kOldSequenceWithMemory = 0;  ///< as the root in the older form

/// Takes a field that can have only one value in Maple's trees.
std::optional<Error> need_value(Block& block, std::string_view stem, int value,
                                const std::string& meaning) {
  const Expected<Field> field = block.need(stem);
  if (!field) return field.error();
  const Expected<int> number = integer_of(*field);
  if (number && *number == value) return std::nullopt;
  return error_at(field->value, quoted(field->name.text) + " must be " + std::to_string(value) +
                                    ", " + meaning + ": only Maple's trees can be read");
}

/// The fields of a subtree, sorted: some belong to the subtree, the others to its children.
struct SubtreeBlocks {
  Block own;
  std::vector<Block> children;
};

Expected<SubtreeBlocks> blocks_of(const std::string& name, std::span<const Field> fields,
                                  const Token& end, int children, const std::string& between) {
  SubtreeBlocks blocks{Block(name, end), {}};
  for (int i = 0; i < children; ++i)
    blocks.children.emplace_back(name + between + std::to_string(i), end);
  for (const Field& field : fields) {
    if (field.transition >= children) {
      const std::string last = std::to_string(children - 1);
      return Unexpected(error_at(
          field.name, quoted(field.name.text) +
                          (between.empty() ? ": the subtree has the children 0 to " + last
                                           : " is of another condition, but " +
                                                 quoted("--nc" + name) + " announces one")));
    }
    Block& block = field.transition < 0
                       ? blocks.own
                       : blocks.children[static_cast<std::size_t>(field.transition)];
    if (auto error = block.add(field)) return Unexpected(*error);
  }
  return blocks;
}

/// Reads the condition selected by `--c`.
Expected<Condition> read_condition(Block& block, const Flavour& flavour) {
  const Expected<Field> selector = block.need("c");
  if (!selector) return Unexpected(selector.error());
  const auto spec = read_module(*selector, flavour.conditions, flavour);
  if (!spec) return Unexpected(spec.error());
  const auto values = read_parameters(**spec, block, flavour);
  if (!values) return Unexpected(values.error());
  if (auto error = block.check_empty((*spec)->id)) return Unexpected(*error);
  return make_condition((*spec)->module, *values);
}

/// Reads the action selected by `--a`; `last` takes the fields after its parameters.
template <class Last>
Expected<Behaviour> read_action(Block& block, const Flavour& flavour, const Last& last) {
  const Expected<Field> selector = block.need("a");
  if (!selector) return Unexpected(selector.error());
  const auto spec = read_module(*selector, flavour.behaviours, flavour);
  if (!spec) return Unexpected(spec.error());
  const auto values = read_parameters(**spec, block, flavour);
  if (!values) return Unexpected(values.error());
  if (std::optional<Error> error = last()) return Unexpected(std::move(*error));
  if (auto error = block.check_empty((*spec)->id)) return Unexpected(*error);
  return make_behaviour((*spec)->module, *values);
}

Expected<Subtree> read_subtree(int index, std::span<const Field> fields, const Token& end,
                               const Flavour& flavour) {
  auto blocks = blocks_of(std::to_string(index), fields, end, 2, "");
  if (!blocks) return Unexpected(blocks.error());
  if (auto error = need_value(blocks->own, "n", kSelector, "a selector")) return Unexpected(*error);
  if (auto error = need_value(blocks->own, "nchild", 2, "a condition and an action"))
    return Unexpected(*error);
  if (auto error = blocks->own.check_empty("a selector")) return Unexpected(*error);
  Block& waits = blocks->children[0];
  if (auto error = need_value(waits, "n", kCondition, "a condition")) return Unexpected(*error);
  const auto condition = read_condition(waits, flavour);
  if (!condition) return Unexpected(condition.error());
  Block& acts = blocks->children[1];
  if (auto error = need_value(acts, "n", kAction, "an action")) return Unexpected(*error);
  const auto action = read_action(acts, flavour, [&] {
    return need_value(acts, "p", 0, "an action that never reports success");
  });
  if (!action) return Unexpected(action.error());
  return Subtree{*condition, *action};
}

/// Reads a subtree in the form of 2018: `--nc0 1` with condition `--c0x0`, then the action `--a0`.
Expected<Subtree> read_old_subtree(int index, std::span<const Field> fields, const Token& end,
                                   const Flavour& flavour) {
  const std::string name = std::to_string(index);
  const auto count = std::ranges::find_if(
      fields, [&](const Field& field) { return field.name.text == "--nc" + name; });
  if (count != fields.end() && count->value.text != "1") {
    return Unexpected(error_at(count->value, "a subtree of " + std::string(count->value.text) +
                                                 " conditions; only trees with one per subtree can "
                                                 "be read, as Maple's"));
  }
  auto blocks = blocks_of(name, fields, end, 1, "x");
  if (!blocks) return Unexpected(blocks.error());
  if (auto error = need_value(blocks->own, "n", kSelector, "a selector")) return Unexpected(*error);
  if (const auto one = blocks->own.need("nc"); !one) return Unexpected(one.error());
  const auto condition = read_condition(blocks->children[0], flavour);
  if (!condition) return Unexpected(condition.error());
  const auto action = read_action(blocks->own, flavour, [] { return std::optional<Error>(); });
  if (!action) return Unexpected(action.error());
  return Subtree{*condition, *action};
}

/// The differences between the two forms, apart from their subtrees.
struct Form {
  std::string_view root;
  int root_kind;
  std::string_view count;
  Between between;
  Expected<Subtree> (*subtree)(int, std::span<const Field>, const Token&, const Flavour&);
};

constexpr Form kNewForm = {"--nroot", kSequenceWithMemory, "--nchildroot", Between::Nothing,
                           read_subtree};
constexpr Form kOldForm = {"--rootnode", kOldSequenceWithMemory, "--nchildsroot", Between::Cross,
                           read_old_subtree};

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
  const Form& form = rest[0].text == kOldForm.root ? kOldForm : kNewForm;
  const auto all = fields_of(rest, form.between);
  if (!all) return Unexpected(all.error());
  std::span<const Field> fields = *all;
  const Token& end = tokens.back();
  const auto first = [&]() -> const Token& { return fields.empty() ? end : fields[0].name; };
  if (first().text != form.root)
    return Unexpected(error_at(first(), "a tree begins with `--nroot` or `--rootnode`"));
  if (const auto kind = integer_of(fields[0]); !kind || *kind != form.root_kind) {
    return Unexpected(
        error_at(fields[0].value, quoted(form.root) + " must be " + std::to_string(form.root_kind) +
                                      ", a sequence with memory: only Maple's trees can be read"));
  }
  fields = fields.subspan(1);
  if (first().text != form.count) return Unexpected(expected_error(form.count, first()));
  const auto count = integer_of(fields[0], 1, kMaxSubtrees);
  if (!count) return Unexpected(count.error());
  fields = fields.subspan(1);
  Tree tree;
  for (int i = 0; i < *count; ++i) {
    std::size_t size = 0;
    while (size < fields.size() && fields[size].state == i)
      ++size;
    if (size == 0) return Unexpected(expected_error("--n" + std::to_string(i), first()));
    const Token& block_end = size == fields.size() ? end : fields[size].name;
    auto subtree = form.subtree(i, fields.first(size), block_end, flavour);
    if (!subtree) return Unexpected(subtree.error());
    tree.subtrees.push_back(std::move(*subtree));
    fields = fields.subspan(size);
  }
  if (fields.empty()) return tree;
  return Unexpected(error_at(first(), "expected the end, since " + quoted(form.count) + " is " +
                                          std::to_string(*count) + ", found " +
                                          quoted(first().text)));
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
