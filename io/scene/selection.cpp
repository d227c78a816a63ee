#include "io/scene/selection.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "io/scene/selection_check.h"

namespace supple {
namespace {

using Kind = Selection::Kind;

constexpr std::string_view blanks = " \t\r\n";
constexpr int max_depth = 64;
constexpr std::size_t max_bytes = 1 << 16;
constexpr std::array<std::string_view, 9> atom_names{
    "x", "y", "z", "box", "sphere", "nearest", "vertices", "group", "not"};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Recursive descent over the grammar in selection.h.
class SelectionParser {
 public:
  SelectionParser(const std::string& text, const Place& place) : text_(text), place_(place) {}

  Selection parse() {
    if (text_.size() > max_bytes)
      fail(fmt::format("more than {} bytes; long lists belong into vertices(file)", max_bytes));
    Selection selection = parse_any();
    if (!at_end())
      fail(fmt::format("{} is left over; allowed: and, or, the end", in_quotes(rest())));
    return selection;
  }

 private:
  [[noreturn]] void fail(const std::string& message) { fail_at(position_, message); }

  [[noreturn]] void fail_at(std::size_t position, const std::string& message) {
    complain(place_, fmt::format("in the selection {}, column {}: {}", in_quotes(text_),
                                 position + 1, message));
  }

  void skip_blanks() {
    while (position_ < text_.size() && blanks.find(text_[position_]) != std::string_view::npos)
      ++position_;
  }

  bool at_end() {
    skip_blanks();
    return position_ == text_.size();
  }

  std::string_view rest() const { return std::string_view(text_).substr(position_); }

  bool take(std::string_view token) {
    skip_blanks();
    if (!rest().starts_with(token)) return false;
    position_ += token.size();
    return true;
  }

  std::string_view next_word() {
    skip_blanks();
    std::size_t end = position_;
    while (end < text_.size() && is_letter(text_[end])) ++end;
    return rest().substr(0, end - position_);
  }

  bool take_word(std::string_view word) {
    if (next_word() != word) return false;
    position_ += word.size();
    return true;
  }

  /// A node whose text runs from `start` to here.
  Selection node(Kind kind, std::size_t start) const {
    Selection selection;
    selection.kind = kind;
    selection.place = place_;
    selection.text = text_.substr(start, position_ - start);
    selection.text.erase(selection.text.find_last_not_of(blanks) + 1);
    return selection;
  }

  Selection parse_any() {
    return parse_list(Kind::any, "or", [this] { return parse_all(); });
  }
  Selection parse_all() {
    return parse_list(Kind::all, "and", [this] { return parse_unary(); });
  }

  template <class ParsePart>
  Selection parse_list(Kind kind, std::string_view joint, const ParsePart& parse_part) {
    skip_blanks();
    const std::size_t start = position_;
    std::vector<Selection> parts{parse_part()};
    while (take_word(joint)) parts.push_back(parse_part());
    if (parts.size() == 1) return std::move(parts[0]);
    Selection selection = node(kind, start);
    selection.parts = std::move(parts);
    return selection;
  }

  Selection parse_unary() {
    skip_blanks();
    const std::size_t start = position_;
    if (++depth_ > max_depth) fail(fmt::format("nested deeper than {} levels", max_depth));
    Selection selection;
    if (take_word("not")) {
      Selection part = parse_unary();
      selection = node(Kind::negation, start);
      selection.parts.push_back(std::move(part));
    } else if (take("(")) {
      selection = parse_any();
      if (!take(")")) fail("a ')' is missing");
    } else {
      selection = parse_atom();
    }
    --depth_;
    return selection;
  }

  Selection parse_atom() {
    const std::string_view word = next_word();
    const std::size_t start = position_;
    position_ += word.size();
    if (word == "x" || word == "y" || word == "z") return parse_axis(word[0] - 'x', start);
    if (word == "box") return parse_box(start);
    if (word == "sphere") return parse_sphere(start);
    if (word == "nearest") return parse_nearest(start);
    if (word == "vertices") return parse_named(Kind::vertices, start);
    if (word == "group") return parse_named(Kind::group, start);
    position_ = start;
    if (word.empty() || word == "and" || word == "or")
      fail(fmt::format("a selection is missing here{}", allowed_names("", atom_names)));
    fail(fmt::format("unknown {}{}", in_quotes(word), allowed_names(word, atom_names)));
  }

  Selection parse_axis(int axis, std::size_t start) {
    using Order = Selection::Order;
    constexpr std::array<std::pair<std::string_view, Order>, 4> orders{{
        {"<=", Order::less_equal},
        {">=", Order::greater_equal},
        {"<", Order::less},
        {">", Order::greater},
    }};
    for (const auto& [sign, order] : orders)
      if (take(sign)) return comparison(axis, order, parse_bound(sign), start);
    if (take(":")) return parse_range(axis, start);
    if (at_end() || text_[position_] == ')' || is_letter(text_[position_]))
      fail_at(start, fmt::format("incomplete: quote it, since a shell takes < and > for itself; "
                                 "'{0}' needs a bound, as in '{0}<10%' or {0}:..10%",
                                 "xyz"[axis]));
    fail("expected <, <=, >, >= or a range such as y:..10%, y:85%..");
  }

  Selection comparison(int axis, Selection::Order order, const Length& bound,
                       std::size_t start) const {
    Selection selection = node(Kind::compare, start);
    selection.axis = axis;
    selection.order = order;
    selection.bound = bound;
    return selection;
  }

  /// After the colon: ..upper, lower.. or lower..upper.
  Selection parse_range(int axis, std::size_t start) {
    using Order = Selection::Order;
    constexpr std::string_view forms = "; allowed: y:..10%, y:85%.., y:10%..30%";
    if (take("..")) return comparison(axis, Order::less, parse_bound(".."), start);
    const Length lower = parse_bound(":");
    if (!take("..")) fail(fmt::format("'..' is missing{}", forms));
    Selection above = comparison(axis, Order::greater, lower, start);
    if (next_length().empty()) return above;
    const Length upper = parse_bound("..");
    if (lower.unit == upper.unit && lower.value >= upper.value)
      fail_at(start, "the range is empty: its lower end must be less than its upper end");
    Selection selection = node(Kind::all, start);
    selection.parts = {above, comparison(axis, Order::less, upper, start)};
    return selection;
  }

  /// The run of characters that should be a length; ends before "..".
  std::string_view next_length() {
    skip_blanks();
    std::size_t end = position_;
    while (end < text_.size() &&
           (is_letter(text_[end]) || text_[end] == '.' || text_[end] == '+' || text_[end] == '-')) {
      if (text_.compare(end, 2, "..") == 0) break;
      ++end;
    }
    if (end < text_.size() && text_[end] == '%') ++end;
    return rest().substr(0, end - position_);
  }

  Length parse_bound(std::string_view before) {
    const std::string_view token = next_length();
    if (token.empty())
      fail(
          fmt::format("incomplete: a length is missing after '{}'; allowed: a number (0.3) or "
                      "a percent (30%)",
                      before));
    const std::optional<Length> length = to_length(token);
    if (!length)
      fail(fmt::format("{} is not a length; allowed: a finite number (0.3) or a percent (30%)",
                       in_quotes(token)));
    position_ += token.size();
    return *length;
  }

  /// The lengths in the parentheses after a function's name.
  std::vector<Length> parse_lengths(std::size_t count, std::string_view form) {
    if (!take("(")) fail(fmt::format("a '(' is missing; allowed: {}", form));
    std::vector<Length> lengths;
    do {
      lengths.push_back(parse_bound(lengths.empty() ? "(" : ","));
    } while (take(","));
    if (!take(")")) fail(fmt::format("a ',' or ')' is missing; allowed: {}", form));
    if (lengths.size() != count)
      fail(fmt::format("{} lengths, must be {}: {}", lengths.size(), count, form));
    return lengths;
  }

  Selection parse_box(std::size_t start) {
    const std::vector<Length> l = parse_lengths(6, "box(x0,y0,z0,x1,y1,z1)");
    Selection selection = node(Kind::box, start);
    selection.lower = {l[0], l[1], l[2]};
    selection.upper = {l[3], l[4], l[5]};
    check_selection(selection);
    return selection;
  }

  Selection parse_sphere(std::size_t start) {
    const std::vector<Length> l = parse_lengths(4, "sphere(x,y,z,radius)");
    Selection selection = node(Kind::sphere, start);
    selection.center = {l[0], l[1], l[2]};
    selection.radius = l[3];
    check_selection(selection);
    return selection;
  }

  Selection parse_nearest(std::size_t start) {
    const std::vector<Length> l = parse_lengths(3, "nearest(x,y,z)");
    Selection selection = node(Kind::nearest, start);
    selection.center = {l[0], l[1], l[2]};
    check_selection(selection);
    return selection;
  }

  /// A file or group name: all up to the closing parenthesis, balanced ones included.
  Selection parse_named(Kind kind, std::size_t start) {
    if (!take("(")) fail("a '(' is missing; allowed: vertices(file), group(name)");
    skip_blanks();
    const std::size_t first = position_;
    for (int open = 1; position_ < text_.size(); ++position_) {
      open += (text_[position_] == '(') - (text_[position_] == ')');
      if (open == 0) break;
    }
    if (position_ == text_.size()) fail("a ')' is missing");
    std::string name = text_.substr(first, position_ - first);
    name.erase(name.find_last_not_of(blanks) + 1);
    ++position_;
    Selection selection = node(kind, start);
    selection.name = std::move(name);
    check_selection(selection);
    return selection;
  }

  const std::string& text_;
  const Place& place_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

}  // namespace

Selection parse_selection(const std::string& text, const Place& place) {
  return SelectionParser(text, place).parse();
}

}  // namespace supple
