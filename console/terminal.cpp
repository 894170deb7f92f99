#include "console/terminal.h"

#include <utility>

#include "base/shown_text.h"

namespace swarmsmith {
namespace {

/// The number of bytes at the end that may be the beginning of a character.
std::size_t begun_at_the_end(std::string_view text) {
  constexpr std::size_t kLongest = 4;
  for (std::size_t length = 1; length < kLongest && length <= text.size(); ++length) {
    const auto byte = static_cast<unsigned char>(text[text.size() - length]);
    if (is_continuation(static_cast<char>(byte))) continue;
    const std::size_t wanted = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc2 ? 2 : 1;
    return length < wanted ? length : 0;
  }
  return 0;
}

}  // namespace

ShownBuffer::~ShownBuffer() {
  put(as_shown(begun_));
}

bool ShownBuffer::put(std::string_view bytes) {
  const auto size = static_cast<std::streamsize>(bytes.size());
  return behind_->sputn(bytes.data(), size) == size;
}

bool ShownBuffer::pass(std::string_view bytes) {
  return put(as_shown(std::exchange(begun_, {}))) && put(bytes);
}

bool ShownBuffer::show(std::string_view text) {
  std::string joined;
  if (!begun_.empty()) text = joined = std::exchange(begun_, {}) + std::string(text);
  const std::size_t begun = begun_at_the_end(text);
  begun_ = text.substr(text.size() - begun);
  text.remove_suffix(begun);
  return put(as_shown(text));
}

ShownBuffer::int_type ShownBuffer::overflow(int_type letter) {
  if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
  const char byte = traits_type::to_char_type(letter);
  return show({&byte, 1}) ? letter : traits_type::eof();
}

std::streamsize ShownBuffer::xsputn(const char* bytes, std::streamsize size) {
  return show({bytes, static_cast<std::size_t>(size)}) ? size : 0;
}

int ShownBuffer::sync() {
  return behind_->pubsync();
}

std::ostream& operator<<(std::ostream& stream, Verbatim verbatim) {
  auto* shown = dynamic_cast<ShownBuffer*>(stream.rdbuf());
  if (shown == nullptr) return stream << verbatim.bytes;
  const std::ostream::sentry ready(stream);
  if (ready && !shown->pass(verbatim.bytes)) stream.setstate(std::ios::badbit);
  return stream;
}

void write_data(Output& output, std::string_view bytes) {
  if (output.out_is_terminal) {
    output.out << bytes;
  } else {
    output.out << Verbatim{bytes};
  }
}

}  // namespace swarmsmith
