#include "console/complete.h"

#include <algorithm>
#include <array>

namespace swarmsmith {
namespace {

/// Kinds of values that are file names.
struct FileKind {
  std::string_view kind;
  Offer::Files files;
};
constexpr std::array kFileKinds = {
    FileKind{"FILE", Offer::Files::All},       FileKind{"PROGRAM", Offer::Files::All},
    FileKind{"STORE", Offer::Files::Stores},   FileKind{"DIR", Offer::Files::Folders},
    FileKind{"FOLDER", Offer::Files::Folders},
};

const DeclaredOption* find_option(const std::vector<DeclaredOption>& options,
                                  std::string_view name) {
  for (const DeclaredOption& option : options) {
    if (!option.is_word && std::ranges::find(option.names, name) != option.names.end())
      return &option;
  }
  return nullptr;
}

void offer_kind(std::string_view kind, std::span<const std::string> words, OfferValues values,
                Offer& offer) {
  for (const FileKind& known : kFileKinds) {
    if (known.kind == kind) {
      offer.files = std::max(offer.files, known.files);
      return;
    }
  }
  if (values != nullptr) values(kind, words, offer);
}

Offer offer_value(const DeclaredOption& option, std::span<const std::string> words,
                  OfferValues values) {
  Offer offer;
  for (const std::string& choice : option.choices)
    offer.words.push_back({choice, ""});
  if (!offer.words.empty()) return offer;
  for (std::string_view kinds = option.kind; !kinds.empty();) {
    const std::size_t end = std::min(kinds.find('|'), kinds.size());
    offer_kind(kinds.substr(0, end), words, values, offer);
    kinds.remove_prefix(std::min(end + 1, kinds.size()));
  }
  return offer;
}

/// The text up to the first end of a clause, which fits beside a word.
std::string short_help(const std::string& help) {
  std::string text = help.substr(0, std::min(help.find_first_of(".;:(\n"), help.size()));
  while (text.ends_with(' '))
    text.pop_back();
  return text;
}

/// The state of the command line after its complete arguments.
struct Typed {
  const DeclaredOption* awaiting = nullptr;  ///< the option whose value comes next
  std::size_t plain = 0;                     ///< number of positional arguments
  bool only_plain = false;                   ///< after `--`
  std::vector<const DeclaredOption*> given;
};

Typed read_typed(const std::vector<DeclaredOption>& options, std::span<const std::string> words) {
  Typed typed;
  for (const std::string& word : words) {
    if (typed.awaiting != nullptr) {
      typed.awaiting = nullptr;
    } else if (typed.only_plain || word.size() < 2 || word.front() != '-') {
      ++typed.plain;
    } else if (word == "--") {
      typed.only_plain = true;
    } else if (const DeclaredOption* option =
                   find_option(options, word.substr(0, word.find('=')))) {
      typed.given.push_back(option);
      if (option->takes_value() && word.find('=') == std::string::npos) typed.awaiting = option;
    }
  }
  return typed;
}

const DeclaredOption* word_at(const std::vector<DeclaredOption>& options, std::size_t place) {
  for (const DeclaredOption& option : options) {
    if (!option.is_word) continue;
    if (place == 0 || option.repeats) return &option;
    --place;
  }
  return nullptr;
}

std::string_view files_line(Offer::Files files) {
  switch (files) {
    case Offer::Files::None:
      return "";
    case Offer::Files::Folders:
      return ":folders\n";
    case Offer::Files::Stores:
      return ":stores\n";
    case Offer::Files::All:
      return ":files\n";
  }
  return "";
}

}  // namespace

Offer offer_next(const std::vector<DeclaredOption>& options, std::span<const std::string> words,
                 std::string_view begin, OfferValues values) {
  const Typed typed = read_typed(options, words);
  if (typed.awaiting != nullptr) return offer_value(*typed.awaiting, words, values);
  if (typed.only_plain || !begin.starts_with("-")) {
    const DeclaredOption* word = word_at(options, typed.plain);
    return word == nullptr ? Offer{} : offer_value(*word, words, values);
  }
  Offer offer;
  if (const std::size_t end = begin.find('='); end != std::string_view::npos) {
    const DeclaredOption* option = find_option(options, begin.substr(0, end));
    if (option == nullptr || !option->takes_value()) return offer;
    offer = offer_value(*option, words, values);
    for (Offer::Word& word : offer.words)
      word.text = std::string(begin.substr(0, end + 1)) + word.text;
    return offer;
  }
  for (const DeclaredOption& option : options) {
    if (option.is_word) continue;
    if (!option.repeats && std::ranges::find(typed.given, &option) != typed.given.end()) continue;
    for (const std::string& name : option.names)
      offer.words.push_back({name, short_help(option.help)});
  }
  return offer;
}

void write_offer(std::ostream& out, const Offer& offer, std::string_view begin) {
  for (const Offer::Word& word : offer.words) {
    if (word.text.starts_with(begin) && word.text.find_first_of("\t\n") == std::string::npos)
      out << word.text << '\t' << word.meaning << '\n';
  }
  out << files_line(offer.files);
}

std::vector<std::string> typed_words(std::span<const std::string> given) {
  std::vector<std::string> words;
  bool cut = false;
  for (const std::string& word : given) {
    // `--option`, `=`, `value`: the value is a separate word here.
    cut = word == "=" && !cut && !words.empty() && words.back().starts_with("--");
    if (!cut) words.push_back(word);
  }
  if (cut || words.empty()) words.emplace_back();
  return words;
}

}  // namespace swarmsmith
