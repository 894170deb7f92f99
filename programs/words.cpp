#include "programs/words.h"

namespace swarmsmith {
namespace {

/// These characters are special everywhere in a word. Braces too: some shells make several words of
/// {a,b}.
constexpr std::string_view kSpecial = ";|&$`<>()*?[{\n";
/// These characters are special at the beginning of a word: a comment, a home directory.
constexpr std::string_view kSpecialFirst = "#~";

class Splitter {
 public:
  explicit Splitter(std::string_view text) : text_(text) {}

  Expected<Words> split() {
    if (const std::size_t nul = text_.find('\0'); nul != std::string_view::npos) {
      at_ = nul;
      return fault("a NUL byte cannot be given to a program", nul);
    }
    for (; at_ < text_.size(); ++at_) {
      if (auto taken = take(); !taken) return Unexpected(taken.error());
      if (out_.needs_shell) return Words{{}, out_.needs_shell};
    }
    end_word();
    return std::move(out_);
  }

 private:
  Expected<void> take() {
    const char c = text_[at_];
    switch (c) {
      case ' ':
      case '\t':
        end_word();
        return {};
      case '\'':
        return take_single();
      case '"':
        return take_double();
      case '\\':
        return take_escaped();
      default:
        break;
    }
    const bool special = kSpecial.find(c) != std::string_view::npos ||
                         (!in_word_ && kSpecialFirst.find(c) != std::string_view::npos);
    if (special) out_.needs_shell = c;
    put(c);
    return {};
  }

  Expected<void> take_escaped() {
    if (at_ + 1 == text_.size()) return fault("a backslash at the end, with nothing after it", at_);
    ++at_;
    if (text_[at_] != '\n') put(text_[at_]);  // an escaped line end is removed
    return {};
  }

  Expected<void> take_single() {
    const std::size_t begin = at_;
    const std::size_t end = text_.find('\'', begin + 1);
    if (end == std::string_view::npos) return fault("a quote ' that is not closed", begin);
    in_word_ = true;
    word_ += text_.substr(begin + 1, end - begin - 1);
    at_ = end;
    return {};
  }

  Expected<void> take_double() {
    const std::size_t begin = at_;
    in_word_ = true;
    for (++at_; at_ < text_.size(); ++at_) {
      char c = text_[at_];
      if (c == '"') return {};
      if (c == '$' || c == '`') out_.needs_shell = c;
      if (c == '\\' && at_ + 1 < text_.size()) {
        const char next = text_[at_ + 1];
        if (std::string_view("\"\\$`\n").find(next) != std::string_view::npos) {
          ++at_;
          if (next == '\n') continue;
          c = next;
        }
      }
      word_ += c;
    }
    return fault("a quote \" that is not closed", begin);
  }

  void put(char c) {
    in_word_ = true;
    word_ += c;
  }

  void end_word() {
    if (in_word_) out_.words.push_back(std::move(word_));
    word_.clear();
    in_word_ = false;
  }

  static Unexpected fault(std::string message, std::size_t at) {
    return bad_input(std::move(message), "byte " + std::to_string(at + 1));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Words out_;
  std::string word_;
  bool in_word_ = false;
};

}  // namespace

Expected<Words> split_words(std::string_view text) {
  return Splitter(text).split();
}

std::string shell_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

}  // namespace swarmsmith
