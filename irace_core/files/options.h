#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// What an option takes for a value.
enum class IraceKind {
  Action,   ///< nothing: says what to do, as --help
  Flag,     ///< nothing, on a command line; of our own options
  Bool,     ///< 0 or 1, TRUE or FALSE
  Natural,  ///< a whole number, 0 or more
  Real,     ///< a number from 0 to 1
  Choice,   ///< one of `words`
  Text,
  Texts,    ///< a vector of texts or numbers
  File,     ///< a path
  Folder,   ///< a path
  Program,  ///< a path; without a slash it is looked for in PATH first
  Anything  ///< an object of R, which is not looked at
};

/// What becomes of an option here.
enum class IraceMeaning {
  Supported,
  Ignored,  ///< accepted, without a meaning; the remark says why
  Refused,  ///< any value but the default is an error; the remark says what to do
  Removed,  ///< gone since irace 4.0, read with a warning; the remark says what to write now
  Gone,     ///< an older name; the remark says what to write now
};

/// In which part of the help an option is listed.
enum class IraceGroup { Do, Files, Instances, Target, Budget, Race, Capping, Here, Old };

/// An option of irace or of `swarmsmith irace` (irace facts, 22).
struct IraceOption {
  std::string_view name;          ///< in scenario files; empty for what only a command line can say
  std::string_view short_switch;  ///< "-s", or empty
  std::string_view long_switch;   ///< "--scenario", or empty for what only a file can say
  IraceKind kind;
  /// As the value is written on a command line; "NA" for one that is worked out.
  std::string_view initial;
  std::string_view words;  ///< the choices, separated by commas
  IraceGroup group;
  IraceMeaning meaning;
  std::string_view help;    ///< half a sentence
  std::string_view remark;  ///< what is different here, half a sentence; may be empty

  bool takes_value() const;
  /// A path of any kind.
  bool is_path() const;
  /// How messages name it: the scenario file's name, else the long switch.
  std::string_view title() const { return name.empty() ? long_switch : name; }
};

/// All of them, by group, in the order of the help.
std::span<const IraceOption> irace_options();
/// By the name in scenario files; null for none.
const IraceOption* find_irace_option(std::string_view name);
/// By "-s" or "--scenario"; null for none.
const IraceOption* find_irace_switch(std::string_view word);
/// The names of scenario files, for suggestions.
std::vector<std::string> irace_option_names();
/// The long switches, for suggestions.
std::vector<std::string> irace_switches();
/// irace_core speaks of options as of its fields: `max_time` becomes `maxTime`.
std::string with_irace_option_names(std::string_view text);
Error with_irace_option_names(const Error& error);
/// The words of a Choice.
std::vector<std::string> irace_words(const IraceOption& option);
/// What stands for a value in the help: "FILE"; empty where there is none.
std::string_view irace_placeholder(IraceKind kind);
/// Help, choices, default and what is different here, as one paragraph.
std::string irace_explanation(const IraceOption& option);
/// What `--help` prints below the usage line, wrapped at 80 columns.
std::string irace_option_help();
/// The table of options for the documentation, as Markdown.
std::string irace_option_table();

/// A value of an option, of the kind's type: nothing (unset, the default), bool (Action, Flag,
/// Bool), integer (Natural), double (Real), texts (Texts), a text (all others).
using IraceValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// The value that a text stands for, as on a command line: an empty text and NA unset an option of
/// a number, a bool or a choice. The error says what was wanted and has no place.
Expected<IraceValue> irace_value_of(const IraceOption& option, std::string_view text);
/// The reverse, as scenario files write it: texts in quotes, TRUE and FALSE as 1 and 0, nothing as
/// NULL.
std::string irace_value_text(const IraceValue& value);

}  // namespace swarmsmith
