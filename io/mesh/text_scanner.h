#pragma once

#include <string>
#include <string_view>

#include "io/file_bytes.h"

namespace supple {

/// How a text format marks comments and continued lines.
struct TextRules {
  char comment = '\0';           ///< begins a comment where a word could begin
  bool backslash_joins = false;  ///< a backslash at the end of a line joins the next one
};

/// Walks through a text file line by line and word by word and knows where it is.
/// Numbers are read without regard to the locale. Every failure is an InputError that begins
/// with file:line and names the subject ("vertex 12").
class TextScanner {
 public:
  TextScanner(const FileBytes& file, TextRules rules);

  /// Goes to the next line that has a word; false at the end of the file.
  bool next_line();
  /// The same where the file must go on; fails with "cut short" where it does not.
  void require_line();

  bool at_line_end() const { return cursor_ == line_end_; }
  int words_left() const;

  /// The next word of the line.
  std::string_view word();
  /// The next word, which must be `expected` (lower case; capitals are accepted too).
  void expect(std::string_view expected);
  double number() { return to_number(word()); }
  long long integer();
  /// What is left of the line, without blanks at its ends.
  std::string_view rest();
  void expect_line_end();

  /// What the next numbers belong to, for messages: "vertex", 12.
  void set_subject(std::string_view kind, long long number);

  int line() const { return line_; }
  /// Bytes after this line.
  std::size_t bytes_left() const { return static_cast<std::size_t>(text_end_ - next_); }
  /// The last line does not end: its last number may have been cut.
  bool ends_inside_line() const { return text_end_[-1] != newline_; }

  /// The number that a word of this line stands for.
  double to_number(std::string_view text) const;

  [[noreturn]] void fail(std::string_view message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(int line, std::string_view message) const;

 private:
  void take_line();
  bool continues() const;
  void join_continued_lines();
  void skip_blanks();

  const FileBytes& file_;
  TextRules rules_;
  char newline_;
  const char *next_, *text_end_;
  const char *cursor_, *line_end_;
  std::string joined_;
  int line_ = 0, lines_taken_ = 0;
  std::string_view subject_;
  long long subject_number_ = 0;
};

/// Throws InputError where the file has a zero byte: it is no text.
void require_text(const FileBytes& file);

/// `text` in lower-case ASCII.
std::string lower_case(std::string_view text);

}  // namespace supple
