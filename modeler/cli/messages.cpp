#include "modeler/cli/messages.h"

#include <algorithm>
#include <cstdio>

namespace supple {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

/// Hands `text` to `put` in pieces, each control character as "\x0a".
template <class Put>
void put_escaped(std::string_view text, const Put& put) {
  while (!text.empty()) {
    const auto plain =
        static_cast<std::size_t>(std::find_if(text.begin(), text.end(), is_control) - text.begin());
    put(text.substr(0, plain));
    if (plain == text.size()) return;
    char escaped[5];
    std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned char>(text[plain]));
    put(std::string_view(escaped));
    text.remove_prefix(plain + 1);
  }
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  put_escaped(text, [&](std::string_view piece) { line += piece; });
  return line;
}

void tell(std::string_view beginning, std::string_view text) {
  const auto print = [](std::string_view piece) {
    std::fwrite(piece.data(), 1, piece.size(), stderr);
  };
  print(beginning);
  print(": ");
  put_escaped(text, print);
  print("\n");
}

std::FILE* text_stream(std::initializer_list<std::string_view> outputs) {
  return std::find(outputs.begin(), outputs.end(), "-") == outputs.end() ? stdout : stderr;
}

}  // namespace supple
