#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace supple {

/// The words that one command takes: declared first, then parsed. Each declaration names what is
/// done with the word; parse() does it in the order in which the words stand.
class CommandLine {
 public:
  using Handler = std::function<void(const std::string& value)>;

  /// What the help says of an option.
  struct Doc {
    std::string value;  ///< "X,Y,Z": what stands for its value
    std::string text;   ///< one or two sentences
  };

  /// `command` as the user writes it ("supple pose"); `description` for its help.
  CommandLine(std::string command, const std::string& description);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Options that are declared from here on stand under this title in the help.
  void begin_group(std::string title);

  /// A word without a dash; every positional that is declared is needed.
  void positional(const std::string& name, const std::string& text, Handler handler);

  /// "-o,--output": takes exactly one value, may stand once.
  void option(const std::string& names, Doc doc, Handler handler);

  /// As option(), but may stand any number of times.
  void repeated_option(const std::string& names, Doc doc, Handler handler);

  /// Takes a value only behind "="; without one the handler gets an empty string.
  void option_with_optional_value(const std::string& name, Doc doc, Handler handler);

  /// Takes no value.
  void flag(const std::string& names, const std::string& text, std::function<void()> handler);

  /// Printed at the end of the help; lines as they are.
  void examples(const std::string& text);

  /// Calls the handlers. False where the help was asked for: it is printed, nothing is called.
  /// Errors: UsageError that names the word and the nearest valid one.
  bool parse(std::span<const std::string> words);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace supple
