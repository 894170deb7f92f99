#include "irace_core/files/command_line.h"

#include <utility>

#include "base/suggestion.h"

namespace swarmsmith {
namespace {

/// Reads the arguments one after the other.
class WordReader {
 public:
  WordReader(std::span<const std::string> words, const std::filesystem::path& folder)
      : words_(words), folder_(folder) {}

  IraceCommandLineOrErrors read() {
    while (next_ < words_.size())
      read_option(words_[next_++]);
    if (!errors_.empty()) return tl::unexpected(std::move(errors_));
    line_.action = action();
    return std::move(line_);
  }

 private:
  void read_option(const std::string& word) {
    if (!word.starts_with('-') || word == "-") {
      complain(word, "is not an option and belongs to none; values of options follow their names");
      return;
    }
    const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    const std::string name = word.substr(0, equals);
    const IraceOption* option = find_irace_switch(name);
    if (option == nullptr) {
      complain_unknown(name);
      // The next argument is most likely the option's value, so there is no separate error for it.
      const bool is_alone = equals == std::string::npos;
      if (is_alone && next_ < words_.size() && !words_[next_].starts_with('-')) ++next_;
      return;
    }
    if (equals != std::string::npos) {
      set(*option, name, word.substr(equals + 1));
    } else if (!takes_next_word(*option)) {
      set(*option, name, "1");
    } else if (next_ < words_.size()) {
      set(*option, name, words_[next_++]);
    } else {
      complain(name, "needs a value after it");
    }
  }

  /// `-q` may be given without a value; a 0 or 1 after it can only be its value. In irace every
  /// flag takes the next argument, whatever it is (irace facts, 25.13).
  bool takes_next_word(const IraceOption& option) const {
    if (option.name != "quiet") return option.takes_value();
    return next_ < words_.size() && (words_[next_] == "0" || words_[next_] == "1");
  }

  void set(const IraceOption& option, const std::string& name, const std::string& text) {
    const auto value = irace_value_of(option, text);
    if (!value) {
      complain(name, value.error().message);
    } else if (const auto refusal = irace_refusal(option, *value)) {
      complain(name, *refusal);
    } else {
      if (const auto remark = irace_remark(option, *value)) line_.warnings.push_back(*remark);
      line_.settings.set({.option = &option,
                          .value = *value,
                          .where = name,
                          .folder = folder_,
                          .on_command_line = true});
    }
  }

  void complain(const std::string& where, std::string message) {
    errors_.push_back({ErrorKind::BadInput, std::move(message), where});
  }

  void complain_unknown(const std::string& name) {
    // Often a name from scenario files is used as a switch.
    const std::size_t dashes = name.find_first_not_of('-');
    const IraceOption* known =
        dashes == std::string::npos ? nullptr : find_irace_option(name.substr(dashes));
    if (known != nullptr && !known->long_switch.empty()) {
      complain(name, "is not an option; the switch of `" + std::string(known->name) + "` is " +
                         std::string(known->long_switch));
    } else if (known != nullptr) {
      complain(name, "is not an option; `" + std::string(known->name) +
                         "` can only be set in a scenario file");
    } else {
      complain(name, "is not an option" + did_you_mean(name, irace_switches()) +
                         "; --help lists all of them");
    }
  }

  IraceAction action() {
    const IraceSettings& given = line_.settings;
    if (given.is_on("--help")) return IraceAction::Help;
    if (given.is_on("--version")) return IraceAction::Version;
    if (given.is_on("--init")) return IraceAction::Init;
    if (const auto file = given.text("--only-test"); file && !file->empty()) {
      line_.only_test = absolute_path(*file, folder_);
      return IraceAction::OnlyTest;
    }
    if (given.is_on("--psrace")) return IraceAction::PsRace;
    if (given.is_on("--ablation")) return IraceAction::Ablation;
    return given.is_on("--check") ? IraceAction::Check : IraceAction::Run;
  }

  std::span<const std::string> words_;
  const std::filesystem::path& folder_;
  std::size_t next_ = 0;
  IraceCommandLine line_;
  std::vector<Error> errors_;
};

}  // namespace

IraceCommandLineOrErrors read_irace_command_line(std::span<const std::string> words,
                                                 const std::filesystem::path& folder) {
  return WordReader(words, folder).read();
}

}  // namespace swarmsmith
