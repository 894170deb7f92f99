#include <algorithm>

#include "irace_core/files/options.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kIndent = 6;  // of the explanation of an option

std::string_view heading(IraceGroup group) {
  switch (group) {
    case IraceGroup::Do:
      return "What to do";
    case IraceGroup::Files:
      return "Files";
    case IraceGroup::Instances:
      return "Instances";
    case IraceGroup::Target:
      return "The target";
    case IraceGroup::Budget:
      return "Budget";
    case IraceGroup::Race:
      return "The race";
    case IraceGroup::Capping:
      return "Adaptive capping";
    case IraceGroup::Here:
      return "Output and store";
    case IraceGroup::Old:
      return "Of older versions of irace";
  }
  return {};
}

/// The text, indented and wrapped at the width.
std::string wrapped(const std::string& text) {
  std::string result(kIndent, ' ');
  std::size_t column = kIndent;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    if (column > kIndent && column + 1 + length > kWidth) {
      result += "\n" + std::string(kIndent, ' ');
      column = kIndent;
    } else if (column > kIndent) {
      result += ' ';
      ++column;
    }
    result += text.substr(begin, length);
    column += length;
    begin = end + 1;
  }
  return result + "\n";
}

std::string default_of(const IraceOption& option) {
  if (!option.takes_value() || option.initial.empty() || option.initial == "NA") return {};
  return std::string(option.initial);
}

std::string switches(const IraceOption& option) {
  std::string text(option.short_switch);
  if (!text.empty()) text += ", ";
  return text + std::string(option.long_switch);
}

/// Bars are escaped, since they would end a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string code(std::string_view text) {
  return text.empty() ? std::string() : "`" + std::string(text) + "`";
}

std::string_view meaning_word(IraceMeaning meaning) {
  switch (meaning) {
    case IraceMeaning::Supported:
      return "yes";
    case IraceMeaning::Ignored:
      return "accepted, no meaning";
    case IraceMeaning::Refused:
      return "refused";
    case IraceMeaning::Removed:
      return "of irace 3.5, read with a warning";
    case IraceMeaning::Gone:
      return "renamed";
  }
  return {};
}

}  // namespace

std::string_view irace_placeholder(IraceKind kind) {
  switch (kind) {
    case IraceKind::Action:
    case IraceKind::Flag:
      return "";
    case IraceKind::Bool:
      return "0|1";
    case IraceKind::Natural:
      return "N";
    case IraceKind::Real:
      return "X";
    case IraceKind::Choice:
      return "WORD";
    case IraceKind::Text:
    case IraceKind::Texts:
    case IraceKind::Anything:
      return "TEXT";
    case IraceKind::File:
      return "FILE";
    case IraceKind::Folder:
      return "FOLDER";
    case IraceKind::Program:
      return "PROGRAM";
  }
  return {};
}

std::string irace_explanation(const IraceOption& option) {
  std::string text(option.help);
  if (option.kind == IraceKind::Choice) {
    std::string words;
    for (const std::string& word : irace_words(option))
      words += (words.empty() ? "" : ", ") + word;
    text += ": " + words;
  }
  if (const std::string initial = default_of(option); !initial.empty()) {
    text += " [" + initial + "]";
  }
  if (option.meaning == IraceMeaning::Refused) {
    text += "; refused: " + std::string(option.remark);
  } else if (option.meaning == IraceMeaning::Ignored) {
    text += "; without meaning: " + std::string(option.remark);
  } else if (option.meaning == IraceMeaning::Removed) {
    text += "; better " + std::string(option.remark);
  } else if (!option.remark.empty() && !option.name.empty()) {
    text += "; " + std::string(option.remark);
  }
  return text;
}

std::string irace_option_help() {
  std::string text;
  const IraceOption* last = nullptr;
  for (const IraceOption& option : irace_options()) {
    if (option.long_switch.empty() || option.meaning == IraceMeaning::Gone) continue;
    if (last == nullptr || last->group != option.group) {
      text += (last == nullptr ? "" : "\n") + std::string(heading(option.group)) + ":\n";
    }
    last = &option;
    text += "  " + switches(option);
    if (option.takes_value()) text += " " + std::string(irace_placeholder(option.kind));
    if (!option.name.empty()) text += "   (" + std::string(option.name) + ")";
    text += "\n" + wrapped(irace_explanation(option));
  }
  return text;
}

std::string irace_option_table() {
  std::string text =
      "| in a scenario file | on the command line | default | meaning | here |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const IraceOption& option : irace_options()) {
    const std::string remark = option.remark.empty() ? "" : "; " + std::string(option.remark);
    std::string here(meaning_word(option.meaning));
    if (option.meaning == IraceMeaning::Gone) {
      here += ": write " + code(option.remark);
    } else {
      here += remark;
    }
    text += "| " + code(option.name) + " | " + code(switches(option)) + " | " +
            code(default_of(option)) + " | " + cell(std::string(option.help)) + " | " + cell(here) +
            " |\n";
  }
  return text;
}

}  // namespace swarmsmith
