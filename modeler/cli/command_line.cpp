#include "modeler/cli/command_line.h"

#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "io/errors.h"
#include "io/scene/complaint.h"
#include "io/scene/nearest_name.h"

namespace supple {
namespace {

constexpr std::size_t help_column = 30;

enum class Takes { one_value, maybe_value, no_value };
enum class Times { once, any };

struct Declared {
  Takes takes;
  Times times;
  std::string value;  ///< as the help shows it
  CommandLine::Handler handler;
};

bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-';
}

/// "--by=": CLI11 would take the next word for its value.
void check_no_empty_value(const std::string& word) {
  if (word.starts_with("--") && word.find('=') == word.size() - 1)
    throw UsageError(fmt::format("{} has no value behind '='", word));
}

}  // namespace

struct CommandLine::Parser {
  CLI::App app;
  std::string command, group = "Options";
  std::map<CLI::Option*, Declared> options;
  std::vector<CLI::Option*> positionals;

  Parser(std::string command_name, const std::string& description)
      : app(description, command_name), command(std::move(command_name)) {
    app.allow_extras();
    app.set_help_flag("-h,--help", "this text");
    app.get_formatter()->column_width(help_column);
  }

  void declare(CLI::Option* option, Declared declared) {
    option->group(group)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (declared.takes == Takes::one_value) option->option_text(declared.value);
    if (declared.takes == Takes::maybe_value)
      option->option_text(fmt::format("[={}]", declared.value));
    options.emplace(option, std::move(declared));
  }

  /// CLI11 leaves two empty lines between groups.
  std::string help() const {
    for (CLI::Option* option : positionals) option->required();
    std::string text = app.help();
    for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    return text;
  }

  void read(std::span<const std::string> words) {
    for (const std::string& word : words) check_no_empty_value(word);
    std::vector<std::string> last_first(words.rbegin(), words.rend());
    try {
      app.parse(last_first);
    } catch (const CLI::ArgumentMismatch& error) {
      complain_of_value(words.back(), error.what());
    }
    check_leftovers();
    for (const CLI::Option* option : positionals)
      if (option->count() == 0) fail(fmt::format("{} is missing", option->get_name(true)));
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw UsageError(fmt::format("{}; see {} --help", message, command));
  }

  /// The last word is an option without its value, or a flag in the middle has one.
  [[noreturn]] void complain_of_value(const std::string& last_word, const char* message) {
    const auto last = options.find(app.get_option_no_throw(last_word));
    if (last == options.end() || last->second.takes != Takes::one_value) fail(message);
    fail(fmt::format("{} needs a value: {}", last_word, last->second.value));
  }

  void check_leftovers() const {
    const std::vector<std::string> leftovers = app.remaining();
    for (const std::string& word : leftovers)
      if (looks_like_option(word)) complain_of_option(word.substr(0, word.find('=')));
    if (!leftovers.empty())
      fail(
          fmt::format("{} is one word too many; an option takes one word, so write it without "
                      "blanks or in quotes",
                      in_quotes(leftovers.front())));
  }

  [[noreturn]] void complain_of_option(const std::string& word) const {
    std::vector<std::string_view> names;
    for (const CLI::Option* option : app.get_options())
      names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
    const std::string nearest = nearest_name(word.substr(word.find_first_not_of('-')), names);
    const std::string hint =
        nearest.empty() ? std::string() : fmt::format("; did you mean --{}?", nearest);
    fail(fmt::format("unknown option {}{}", in_quotes(word), hint));
  }

  void call_handlers() const {
    std::map<CLI::Option*, std::size_t> seen;
    for (CLI::Option* option : app.parse_order()) {
      const std::size_t turn = seen[option]++;
      const Declared& declared = options.at(option);
      if (turn == 1 && declared.times == Times::once)
        throw UsageError(fmt::format("{} is given twice", option->get_name()));
      declared.handler(option->results().at(turn));
    }
  }
};

CommandLine::CommandLine(std::string command, const std::string& description)
    : parser_(std::make_unique<Parser>(std::move(command), description)) {}
CommandLine::~CommandLine() = default;

void CommandLine::begin_group(std::string title) {
  parser_->group = std::move(title);
}

void CommandLine::positional(const std::string& name, const std::string& text, Handler handler) {
  CLI::Option* option = parser_->app.add_option(name, CLI::callback_t{}, text);
  parser_->declare(option, {Takes::one_value, Times::once, " ", std::move(handler)});
  parser_->positionals.push_back(option);
}

void CommandLine::option(const std::string& names, Doc doc, Handler handler) {
  CLI::Option* option = parser_->app.add_option(names, CLI::callback_t{}, doc.text);
  parser_->declare(option, {Takes::one_value, Times::once, doc.value, std::move(handler)});
}

void CommandLine::repeated_option(const std::string& names, Doc doc, Handler handler) {
  CLI::Option* option = parser_->app.add_option(names, CLI::callback_t{}, doc.text);
  parser_->declare(option, {Takes::one_value, Times::any, doc.value, std::move(handler)});
}

void CommandLine::option_with_optional_value(const std::string& name, Doc doc, Handler handler) {
  CLI::Option* option = parser_->app.add_flag(name)->description(doc.text);
  const auto without_default = [handler = std::move(handler)](const std::string& value) {
    handler(value == "true" ? "" : value);
  };
  parser_->declare(option, {Takes::maybe_value, Times::once, doc.value, without_default});
}

void CommandLine::flag(const std::string& names, const std::string& text,
                       std::function<void()> handler) {
  CLI::Option* option = parser_->app.add_flag(names)->description(text)->disable_flag_override();
  const auto ignore_value = [handler = std::move(handler)](const std::string&) { handler(); };
  parser_->declare(option, {Takes::no_value, Times::once, "", ignore_value});
}

void CommandLine::examples(const std::string& text) {
  parser_->app.footer(text);
}

bool CommandLine::parse(std::span<const std::string> words) {
  try {
    parser_->read(words);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", parser_->help());
    return false;
  } catch (const CLI::ParseError& error) {
    parser_->fail(error.what());
  }
  parser_->call_handlers();
  return true;
}

}  // namespace supple
