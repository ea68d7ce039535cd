#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <functional>
#include <map>
#include <sstream>
#include <utility>

#include "base/check.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/text_file.h"
#include "datasets/yaml_tree.h"

namespace hoplab {
namespace {

using Kind = YamlNode::Kind;

// Builds a YamlNode from the parser's events, counting as it goes.
class TreeBuilder : public YAML::EventHandler {
 public:
  using PlaceOf = std::function<std::string(const YAML::Mark&)>;
  TreeBuilder(std::string_view text, PlaceOf place_of, const YamlLimits& limits)
      : text_(text), place_of_(std::move(place_of)), limits_(limits) {
    root_.place = place_of_(YAML::Mark::null_mark());
  }

  YamlNode Take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0)
      throw InputError({place_of_(mark), "",
                        "a second document begins here, the file must hold one",
                        "Remove the line `---` or split the file."});
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    // The key `null` of a parameter: the word itself.
    constexpr std::string_view kNull = "null";
    const bool is_key =
        !stack_.empty() && stack_.back().sized.node.kind == Kind::kMap && !stack_.back().has_key;
    if (is_key && mark.pos >= 0 && static_cast<std::size_t>(mark.pos) < text_.size() &&
        text_.substr(static_cast<std::size_t>(mark.pos), kNull.size()) == kNull)
      return OnScalar(mark, "", anchor, std::string(kNull));
    Finish({NewNode(Kind::kNull, mark), {1, 0, 1}}, mark, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    CheckTag(mark, tag);
    YamlNode node = NewNode(Kind::kScalar, mark);
    node.text = value;
    Finish({std::move(node), {1, value.size(), 1}}, mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      throw InputError({place_of_(mark), "", "an alias may not stand inside what it names",
                        "Write the value out."});
    Count(mark, found->second.size);
    Add(found->second, mark);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    CheckTag(mark, tag);
    Open(Kind::kSequence, mark, anchor);
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    CheckTag(mark, tag);
    Open(Kind::kMap, mark, anchor);
  }
  void OnMapEnd() override { Close(); }

 private:
  struct Size {
    std::size_t nodes = 1;
    std::size_t bytes = 0;
    int height = 1;
  };
  struct Sized {
    YamlNode node;
    Size size;
  };
  struct Frame {
    Sized sized;
    YAML::Mark mark;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    std::string key;
    std::string key_place;
    std::map<std::string, std::string> key_places;
  };

  YamlNode NewNode(Kind kind, const YAML::Mark& mark) const {
    YamlNode node;
    node.kind = kind;
    node.place = place_of_(mark);
    return node;
  }

  void CheckTag(const YAML::Mark& mark, const std::string& tag) const {
    if (tag.empty() || tag == "?" || tag == "!") return;  // yaml-cpp: plain and quoted
    throw InputError({place_of_(mark), "tag " + Printable(tag), "tags are not part of the format",
                      "Remove the tag."});
  }

  void Count(const YAML::Mark& mark, const Size& size) {
    nodes_ += size.nodes;
    bytes_ += size.bytes;
    if (nodes_ > limits_.max_nodes || bytes_ > limits_.max_expanded_bytes)
      throw InputError({place_of_(mark), "",
                        "with its aliases written out the file must have at most " +
                            std::to_string(limits_.max_nodes) + " values and " +
                            std::to_string(limits_.max_expanded_bytes) + " bytes of text",
                        "Write the values out instead of nesting aliases."});
    CheckDepth(mark, static_cast<int>(stack_.size()) + size.height);
  }

  void CheckDepth(const YAML::Mark& mark, int depth) const {
    if (depth > limits_.max_depth)
      throw InputError({place_of_(mark), "",
                        "is nested more than " + std::to_string(limits_.max_depth) + " deep",
                        "Check the brackets and the indentation."});
  }

  void Open(Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    Count(mark, {1, 0, 1});
    if (!stack_.empty() && stack_.back().sized.node.kind == Kind::kMap && !stack_.back().has_key)
      BadKey(mark);
    Frame frame;
    frame.sized.node = NewNode(kind, mark);
    frame.mark = mark;
    frame.anchor = anchor;
    stack_.push_back(std::move(frame));
  }

  void Close() {
    Frame frame = std::move(stack_.back());
    stack_.pop_back();
    Remember(frame.sized, frame.anchor);
    Add(std::move(frame.sized), frame.mark);
  }

  void Finish(Sized sized, const YAML::Mark& mark, YAML::anchor_t anchor) {
    Count(mark, sized.size);
    Remember(sized, anchor);
    Add(std::move(sized), mark);
  }

  void Remember(const Sized& sized, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_[anchor] = sized;
  }

  [[noreturn]] void BadKey(const YAML::Mark& mark) const {
    throw InputError(
        {place_of_(mark), "", "a key must be plain text", "Check the brackets and the colons."});
  }

  void Add(Sized sized, const YAML::Mark& mark) {
    if (stack_.empty()) {
      root_ = std::move(sized.node);
      return;
    }
    Frame& frame = stack_.back();
    if (frame.sized.node.kind == Kind::kMap && !frame.has_key) {
      if (sized.node.kind != Kind::kScalar) BadKey(mark);
      frame.has_key = true;
      frame.key = std::move(sized.node.text);
      frame.key_place = place_of_(mark);
      const auto [first, is_new] = frame.key_places.emplace(frame.key, frame.key_place);
      if (!is_new)
        throw InputError({frame.key_place, Printable(frame.key),
                          "duplicate key, it stands already at " + first->second,
                          "Remove one of the two."});
      return;
    }
    Size& size = frame.sized.size;
    size.nodes += sized.size.nodes;
    size.bytes += sized.size.bytes;
    size.height = std::max(size.height, sized.size.height + 1);
    if (frame.sized.node.kind == Kind::kSequence) {
      frame.sized.node.items.push_back(std::move(sized.node));
      return;
    }
    // A block or nothing under a key is reported where the key stands, not where the block begins.
    if (sized.node.kind != Kind::kScalar) sized.node.place = frame.key_place;
    frame.sized.node.entries.push_back(
        {std::move(frame.key), std::move(frame.key_place), std::move(sized.node)});
    frame.has_key = false;
  }

  std::string_view text_;
  PlaceOf place_of_;
  YamlLimits limits_;
  YamlNode root_;
  int documents_ = 0;
  std::size_t nodes_ = 0;
  std::size_t bytes_ = 0;
  std::vector<Frame> stack_;
  std::map<YAML::anchor_t, Sized> anchors_;  // finished ones only
};

// CRLF and CR become LF: yaml-cpp does not know a CR alone, and a block text would keep both.
std::string WithUnixLineEnds(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool before_lf = i + 1 < text.size() && text[i + 1] == '\n';
    if (text[i] != '\r') {
      out += text[i];
    } else if (!before_lf) {
      out += '\n';
    }
  }
  return out;
}

YamlNode Parse(std::string_view text, const TreeBuilder::PlaceOf& place_of,
               const YamlLimits& limits) {
  const std::string lines = WithUnixLineEnds(text);
  std::istringstream stream(lines);
  TreeBuilder builder(lines, place_of, limits);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw InputError({place_of(error.mark), "", "is not valid YAML: " + Printable(error.msg, 200),
                      "Check indentation, brackets, quotes and colons near here."});
  }
  return builder.Take();
}

}  // namespace

YamlNode ParseYaml(std::string_view bytes, const std::string& document, const YamlLimits& limits) {
  if (bytes.size() > limits.max_bytes)
    throw InputError({document, "size = " + std::to_string(bytes.size()) + " bytes",
                      "must be at most " + std::to_string(limits.max_bytes) + " bytes",
                      kSamplesElsewhere});
  const std::string_view text = CheckText(bytes, document);
  const auto place_of = [&](const YAML::Mark& mark) {
    return mark.is_null() ? document : document + ":" + std::to_string(mark.line + 1);
  };
  return Parse(text, place_of, limits);
}

YamlNode ParseYamlValue(std::string_view text, const std::string& place) {
  CheckText(text, place);
  return Parse(text, [&](const YAML::Mark&) { return place; }, {});
}

}  // namespace hoplab
