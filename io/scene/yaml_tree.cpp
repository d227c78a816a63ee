#include "io/scene/yaml_tree.h"

#include <algorithm>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "io/scene/complaint.h"

namespace supple {
namespace {

constexpr std::size_t max_nodes = 100'000;
constexpr std::size_t max_depth = 64;

using Style = YAML::EmitterStyle;

/// Builds the tree from yaml-cpp's events and refuses what scenes may not hold.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  YamlNode take() { return std::move(root_); }

  /// Says where yaml-cpp stopped. It looks up an alias before it tells of it.
  [[noreturn]] void refuse(const YAML::Exception& error) const {
    if (byte_at(error.mark) == '*') refuse_alias(error.mark);
    complain(place(error.mark),
             fmt::format("not valid YAML: {}; text that holds ': ', ' #' or begins with one of "
                         "> | % @ ` ! & * needs quotes",
                         error.msg));
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1)
      complain(place(mark), "a second document begins; allowed: one document a file");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_properties(mark, "?", anchor);
    if (key_comes())
      complain(place(mark), "a key is missing; allowed: text as key, as in 'particles: 200'");
    add(new_node(YamlNode::Kind::null, mark));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_alias(mark); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_properties(mark, tag, anchor);
    const bool plain = tag == "?";
    if (!plain) refuse_open_quote(mark);
    if (value.find('\0') != std::string::npos)
      complain(place(mark), "text with a zero byte (\\0) in it; leave it out");
    if (plain && !open_.empty() && open_.back().node.flow) refuse_cut_text(mark, value);
    if (key_comes()) {
      add_key(mark, value, plain);
      return;
    }
    YamlNode node = new_node(YamlNode::Kind::scalar, mark);
    node.text = value;
    node.quoted = !plain;
    add(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       Style::value style) override {
    open(YamlNode::Kind::sequence, mark, tag, anchor, style);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  Style::value style) override {
    open(YamlNode::Kind::map, mark, tag, anchor, style);
  }
  void OnMapEnd() override { close(); }

  void OnAnchor(const YAML::Mark& mark, const std::string& anchor) override {
    complain(place(mark),
             fmt::format("anchors (&{}) are not allowed; write the value out", anchor));
  }

 private:
  struct OpenNode {
    YamlNode node;
    std::unordered_map<std::string, int> key_lines;
  };

  Place place(const YAML::Mark& mark) const { return {name_, mark.line + 1, mark.column + 1}; }

  char byte_at(const YAML::Mark& mark) const {
    const auto position = static_cast<std::size_t>(mark.pos);
    return position < text_.size() ? text_[position] : '\0';
  }

  [[noreturn]] void refuse_alias(const YAML::Mark& mark) const {
    complain(place(mark), "aliases (*name) are not allowed; write the value out, or quote it");
  }

  bool key_comes() const {
    if (open_.empty() || open_.back().node.kind != YamlNode::Kind::map) return false;
    return open_.back().node.keys.size() == open_.back().node.items.size();
  }

  void refuse_properties(const YAML::Mark& mark, const std::string& tag,
                         YAML::anchor_t anchor) const {
    if (anchor != 0) complain(place(mark), "anchors are not allowed; write the value out");
    if (byte_at(mark) == '!' ||
        (tag != "?" && tag != "!"))  // what plain and quoted text have for a tag
      complain(place(mark), fmt::format("tags ({}) are not allowed; leave it out", in_quotes(tag)));
  }

  /// To yaml-cpp the end of the file ends a quote too.
  void refuse_open_quote(const YAML::Mark& mark) const {
    const char quote = byte_at(mark);
    if (quote != '"' && quote != '\'') return;
    for (std::size_t i = static_cast<std::size_t>(mark.pos) + 1; i < text_.size(); ++i) {
      const bool doubled = quote == '\'' && text_.substr(i, 2) == "''";
      if (doubled || (quote == '"' && text_[i] == '\\'))
        ++i;
      else if (text_[i] == quote)
        return;
    }
    complain(place(mark), fmt::format("the quote {} that begins here is not closed", quote));
  }

  /// In flow braces a comma ends plain text: `box(0,0,…)` would silently become "box(0".
  void refuse_cut_text(const YAML::Mark& mark, const std::string& value) const {
    if (std::count(value.begin(), value.end(), '(') <= std::count(value.begin(), value.end(), ')'))
      return;
    complain(place(mark),
             fmt::format("{} was cut off: inside {{ }} and [ ] a comma ends text without quotes; "
                         "quote it, as in \"box(0,0,0,1,1,1)\", or write the map form, as in "
                         "{{box: {{min: [0, 0, 0], max: [1, 1, 1]}}}}",
                         in_quotes(value)));
  }

  YamlNode new_node(YamlNode::Kind kind, const YAML::Mark& mark) {
    if (++nodes_ > max_nodes)
      complain(place(mark), fmt::format("more than {} values in one file", max_nodes));
    YamlNode node;
    node.kind = kind;
    node.place = place(mark);
    return node;
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor, Style::value style) {
    refuse_properties(mark, tag, anchor);
    if (key_comes())
      complain(place(mark), "a list or a map stands as key, or its closing bracket is missing");
    if (open_.size() >= max_depth)
      complain(place(mark), fmt::format("nested deeper than {} levels", max_depth));
    YamlNode node = new_node(kind, mark);
    node.flow = style == Style::Flow;
    open_.push_back({std::move(node), {}});
  }

  void close() {
    YamlNode node = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(node));
  }

  void add(YamlNode node) {
    if (open_.empty())
      root_ = std::move(node);
    else
      open_.back().node.items.push_back(std::move(node));
  }

  void add_key(const YAML::Mark& mark, const std::string& key, bool plain) {
    if (plain && key == "<<")
      complain(place(mark), "merges (<<) are not allowed; write the keys out");
    const auto [first, is_new] = open_.back().key_lines.emplace(key, mark.line + 1);
    if (!is_new)
      complain(place(mark), fmt::format("the key {} stands twice; it stands in line {} already",
                                        in_quotes(key), first->second));
    open_.back().node.keys.push_back({key, place(mark)});
  }

  std::string_view text_;
  std::string name_;
  YamlNode root_;
  std::vector<OpenNode> open_;
  std::size_t nodes_ = 0;
  int documents_ = 0;
};

/// Refuses bytes that no text holds, and tabs as indentation, which YAML takes for something else.
void check_bytes(std::string_view text, const std::string& name) {
  if (text.size() > largest_scene)
    complain({name}, fmt::format("the file has more than {} MB", largest_scene >> 20));
  if (text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE"))
    complain({name, 1, 1}, "the text is UTF-16; save it as UTF-8");
  Place place{name, 1, 1};
  bool indentation = true;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7F)
      complain(place,
               fmt::format("a control character (byte 0x{:02x}); allowed: UTF-8 text", byte));
    if (c == '\t' && indentation) complain(place, "a tab as indentation; use spaces");
    if (c == '%' && place.column == 1)
      complain(place, "a line begins with %, a directive to YAML; directives are not allowed");
    indentation = c == '\n' || (indentation && c == ' ');
    ++place.column;
    if (c == '\n') place = {name, place.line + 1, 1};
  }
}

}  // namespace

YamlNode parse_yaml(std::string_view text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  check_bytes(text, name);
  TreeBuilder builder(text, name);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    builder.refuse(error);
  }
  return builder.take();
}

}  // namespace supple
