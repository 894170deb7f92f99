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

/// The type of an option's value.
enum class IraceKind {
  Action,   ///< no value: an action, such as --help
  Flag,     ///< no value, and only on a command line; for our own options
  Bool,     ///< 0 or 1, TRUE or FALSE
  Natural,  ///< a whole number that is 0 or more
  Real,     ///< a number from 0 to 1
  Choice,   ///< one of `words`
  Text,
  Texts,    ///< a vector of texts or numbers
  File,     ///< a path
  Folder,   ///< a path
  Program,  ///< a path; a name without a slash is searched for in PATH first
  Anything  ///< an object of R, whose value is ignored
};

/// How this program treats an option.
enum class IraceMeaning {
  Supported,
  Ignored,  ///< accepted, but without effect; the remark gives the reason
  Refused,  ///< any value except the default is an error; the remark says what to do
  Removed,  ///< removed in irace 4.0, read with a warning; the remark gives the replacement
  Gone,     ///< an older name; the remark gives the replacement
};

/// The section of the help in which an option is listed.
enum class IraceGroup { Do, Files, Instances, Target, Budget, Race, Capping, Here, Old };

/// An option of irace or of `swarmsmith irace` (irace facts, 22).
struct IraceOption {
  /// The name in scenario files; empty for options that exist only on the command line.
  std::string_view name;
  std::string_view short_switch;  ///< "-s", or empty
  std::string_view long_switch;   ///< "--scenario", or empty for options that exist only in files
  IraceKind kind;
  /// The default as it is written on a command line; "NA" if it is computed.
  std::string_view initial;
  std::string_view words;  ///< the choices, separated by commas
  IraceGroup group;
  IraceMeaning meaning;
  std::string_view help;    ///< a phrase, not a full sentence
  std::string_view remark;  ///< the difference from irace, also a phrase; may be empty

  bool takes_value() const;
  /// Whether the value is a path of any kind.
  bool is_path() const;
  /// The option's name in messages: the name in scenario files, otherwise the long switch.
  std::string_view title() const { return name.empty() ? long_switch : name; }
};

/// All options, by group, in the order of the help.
std::span<const IraceOption> irace_options();
/// The option with this name in scenario files; null if there is none.
const IraceOption* find_irace_option(std::string_view name);
/// The option with the switch "-s" or "--scenario"; null if there is none.
const IraceOption* find_irace_switch(std::string_view word);
/// The names in scenario files, for suggestions.
std::vector<std::string> irace_option_names();
/// The long switches, for suggestions.
std::vector<std::string> irace_switches();
/// Replaces the field names that irace_core uses for options: `max_time` becomes `maxTime`.
std::string with_irace_option_names(std::string_view text);
Error with_irace_option_names(const Error& error);
/// The possible values of a Choice.
std::vector<std::string> irace_words(const IraceOption& option);
/// The placeholder for a value in the help: "FILE"; empty if there is none.
std::string_view irace_placeholder(IraceKind kind);
/// Help, choices, default and the difference from irace, as one paragraph.
std::string irace_explanation(const IraceOption& option);
/// The text that `--help` prints after the usage line, wrapped at 80 columns.
std::string irace_option_help();
/// The table of options for the documentation, as Markdown.
std::string irace_option_table();

/// A value of an option, of the type of its kind: monostate (unset, the default), bool (Action,
/// Flag, Bool), integer (Natural), double (Real), several texts (Texts), a text (all others).
using IraceValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// The value of a text, as on a command line. For options with a number, a bool or a choice, an
/// empty text and NA unset the option. The error says what was expected, and has no place.
Expected<IraceValue> irace_value_of(const IraceOption& option, std::string_view text);
/// The reverse, in the form of scenario files: texts in quotes, TRUE and FALSE as 1 and 0, no value
/// as NULL.
std::string irace_value_text(const IraceValue& value);

}  // namespace swarmsmith
