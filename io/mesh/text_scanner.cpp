#include "io/mesh/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "io/errors.h"

namespace supple {
namespace {

constexpr std::size_t longest_quote = 40;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string quoted(std::string_view word) {
  std::string text(word.substr(0, longest_quote));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  return fmt::format("\"{}{}\"", text, word.size() > longest_quote ? "..." : "");
}

/// from_chars, which knows no plus sign.
template <class Number>
std::from_chars_result parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return std::from_chars(word.data(), word.data() + word.size(), value);
}

/// A number too small for a double, such as 1e-400.
bool underflows(std::string_view word) {
  long double wide = 1;
  return parse(word, wide).ec == std::errc() && std::abs(wide) < 1;
}

}  // namespace

TextScanner::TextScanner(const FileBytes& file, TextRules rules)
    : file_(file),
      rules_(rules),
      newline_(file.bytes.find('\n') == std::string::npos ? '\r' : '\n'),
      next_(file.bytes.data()),
      text_end_(file.bytes.data() + file.bytes.size()),
      cursor_(next_),
      line_end_(next_) {
  if (file.bytes.starts_with("\xEF\xBB\xBF")) next_ += 3;
}

bool TextScanner::next_line() {
  subject_ = {};
  while (next_ < text_end_) {
    take_line();
    if (cursor_ < line_end_) return true;
  }
  line_ = lines_taken_;
  return false;
}

void TextScanner::require_line() {
  const std::string_view subject = subject_;
  const bool found = next_line();
  subject_ = subject;
  if (!found) fail("the file is cut short");
}

void TextScanner::take_line() {
  const auto* newline = static_cast<const char*>(std::memchr(next_, newline_, bytes_left()));
  cursor_ = next_;
  line_end_ = newline ? newline : text_end_;
  next_ = newline ? newline + 1 : text_end_;
  line_ = ++lines_taken_;
  while (line_end_ > cursor_ && is_blank(line_end_[-1])) --line_end_;
  skip_blanks();
  if (continues()) join_continued_lines();
}

/// A backslash that ends a comment joins nothing.
bool TextScanner::continues() const {
  const std::string_view line(cursor_, static_cast<std::size_t>(line_end_ - cursor_));
  return rules_.backslash_joins && line.ends_with('\\') &&
         line.find(rules_.comment) == std::string_view::npos;
}

void TextScanner::join_continued_lines() {
  const int first_line = line_;
  std::string joined;
  rules_.backslash_joins = false;
  while (line_end_ > cursor_ && line_end_[-1] == '\\') {
    joined.append(cursor_, line_end_ - 1).push_back(' ');
    cursor_ = line_end_;
    if (next_ == text_end_) break;
    take_line();
  }
  rules_.backslash_joins = true;
  joined.append(cursor_, line_end_);
  joined_ = std::move(joined);
  cursor_ = joined_.data();
  line_end_ = cursor_ + joined_.size();
  line_ = first_line;
  while (line_end_ > cursor_ && is_blank(line_end_[-1])) --line_end_;
  skip_blanks();
}

void TextScanner::skip_blanks() {
  while (cursor_ < line_end_ && is_blank(*cursor_)) ++cursor_;
  if (cursor_ < line_end_ && rules_.comment && *cursor_ == rules_.comment) cursor_ = line_end_;
}

int TextScanner::words_left() const {
  int words = 0;
  for (const char* c = cursor_; c < line_end_; ++words) {
    if (*c == rules_.comment && rules_.comment) break;
    while (c < line_end_ && !is_blank(*c)) ++c;
    while (c < line_end_ && is_blank(*c)) ++c;
  }
  return words;
}

std::string_view TextScanner::word() {
  if (at_line_end()) fail("the line ends too early");
  const char* begin = cursor_;
  while (cursor_ < line_end_ && !is_blank(*cursor_)) ++cursor_;
  const std::string_view result(begin, static_cast<std::size_t>(cursor_ - begin));
  skip_blanks();
  return result;
}

void TextScanner::expect(std::string_view expected) {
  const std::string_view found = word();
  if (found != expected && lower_case(found) != expected)
    fail(fmt::format("\"{}\" is expected here, not {}", expected, quoted(found)));
}

double TextScanner::to_number(std::string_view text) const {
  double value = 0;
  const auto [end, error] = parse(text, value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size())
    fail(fmt::format("{} is not a number", quoted(text)));
  if (error == std::errc::result_out_of_range && underflows(text)) return 0;
  if (error != std::errc() || !std::isfinite(value))
    fail(fmt::format("{} is not a finite number", quoted(text)));
  return value;
}

long long TextScanner::integer() {
  const std::string_view text = word();
  long long value = 0;
  const auto [end, error] = parse(text, value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size())
    fail(fmt::format("{} is not a whole number", quoted(text)));
  if (error != std::errc()) fail(fmt::format("{} is too large", quoted(text)));
  return value;
}

std::string_view TextScanner::rest() {
  const std::string_view result(cursor_, static_cast<std::size_t>(line_end_ - cursor_));
  cursor_ = line_end_;
  return result;
}

void TextScanner::expect_line_end() {
  if (!at_line_end()) fail(fmt::format("{} is more than belongs on this line", quoted(word())));
}

void TextScanner::set_subject(std::string_view kind, long long number) {
  subject_ = kind;
  subject_number_ = number;
}

void TextScanner::fail_at(int line, std::string_view message) const {
  const std::string subject =
      subject_.empty() ? std::string() : fmt::format("{} {}: ", subject_, subject_number_);
  throw InputError(fmt::format("{}:{}: {}{}", file_.name, line, subject, message));
}

void require_text(const FileBytes& file) {
  const std::size_t zero = file.bytes.find('\0');
  if (zero != std::string::npos)
    throw InputError(fmt::format("{}: byte {} is zero: this is not a text file", file.name, zero));
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower;
}

}  // namespace supple
