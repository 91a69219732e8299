// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/formula_reader.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace ods {

struct TextNode {
  std::string word;  // an operator, a function, a name; empty for a number
  double number = 0.0;
  std::vector<std::shared_ptr<const TextNode>> operands;
};

namespace {

using Node = std::shared_ptr<const TextNode>;

Node node(const std::string& word, std::vector<Node> operands = {}) {
  return std::make_shared<TextNode>(TextNode{word, 0.0, std::move(operands)});
}

// Words, numbers and single characters.
std::vector<std::string> tokens_of(const std::string& text) {
  const std::string bare = std::regex_replace(text, std::regex("//[^\n]*"), "");
  static const std::regex token(R"([A-Za-z_#]\w*|(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|\S)");
  std::vector<std::string> tokens;
  for (std::sregex_iterator it(bare.begin(), bare.end(), token), end; it != end; ++it) tokens.push_back(it->str());
  return tokens;
}

class Parser {
 public:
  explicit Parser(const std::string& text) : tokens_(tokens_of(text)) {}

  bool at_end() const { return at_ == tokens_.size(); }
  std::string peek() const { return at_end() ? "" : tokens_[at_]; }
  std::string next() {
    if (at_end()) throw std::runtime_error("the text ends too early");
    return tokens_[at_++];
  }
  bool take(const std::string& token) {
    if (peek() != token) return false;
    at_++;
    return true;
  }
  void expect(const std::string& token) {
    if (!take(token)) throw std::runtime_error("'" + token + "' expected, not '" + peek() + "'");
  }

  // CONDITION < 0 ? A : B, if the language has it.
  Node expression() {
    Node left = sum();
    if (!take("<")) return left;
    const Node limit = sum();
    expect("?");
    Node below = expression();
    expect(":");
    return node("select", {node("-", {left, limit}), below, expression()});
  }

 private:
  Node sum() {
    Node left = take("-") ? node("-", {product()}) : product();
    while (peek() == "+" || peek() == "-") {
      const std::string sign = next();
      left = node(sign, {left, product()});
    }
    return left;
  }

  Node product() {
    Node left = atom();
    while (peek() == "*" || peek() == "/") {
      const std::string sign = next();
      left = node(sign, {left, atom()});
    }
    return left;
  }

  Node atom() {
    const std::string token = next();
    if (token == "(") {
      Node inside = expression();
      expect(")");
      return inside;
    }
    if (token == "-") return node("-", {atom()});
    if (std::isdigit(static_cast<unsigned char>(token[0])) || token[0] == '.') {
      return std::make_shared<TextNode>(TextNode{"", std::stod(token), {}});
    }
    if (!std::isalpha(static_cast<unsigned char>(token[0])) && token[0] != '_') {
      throw std::runtime_error("a formula expected, not '" + token + "'");
    }
    if (!take("(")) return node(token);
    std::vector<Node> arguments{expression()};
    while (take(",")) arguments.push_back(expression());
    expect(")");
    return node(token, std::move(arguments));
  }

  std::vector<std::string> tokens_;
  size_t at_ = 0;
};

std::vector<Node> povray_vector(Parser& in) {
  std::vector<Node> parts;
  in.expect("{");
  for (int i = 0; i < 3; i++) {
    in.expect("function");
    in.expect("{");
    parts.push_back(in.expression());
    in.expect("}");
  }
  in.expect("}");
  return parts;
}

std::vector<Node> shader_vector(const std::string& text) {
  Parser in(text);
  std::vector<Node> parts{in.expression()};
  while (in.take(",")) parts.push_back(in.expression());
  if (parts.size() != 3 || !in.at_end()) throw std::runtime_error("three parts expected: " + text);
  return parts;
}

}  // namespace

TextCamera TextCamera::from_povray(const std::string& text) {
  Parser in(text);
  TextCamera camera;
  while (in.take("#declare")) {
    const std::string name = in.next();
    if (camera.names_.contains(name) || camera.functions_.contains(name))
      throw std::runtime_error("declared twice: " + name);
    in.expect("=");
    if (in.take("function")) {
      Function function;
      for (const char* word : {"(", "x", ",", "y"}) in.expect(word);
      while (in.take(",")) function.parameters.push_back(in.next());
      for (const char* word : {")", "{"}) in.expect(word);
      function.body = in.expression();
      in.expect("}");
      camera.check_calls(*function.body);
      camera.functions_[name] = function;
    } else {
      camera.names_[name] = in.expression();
      in.expect(";");
    }
  }
  for (const char* word : {"camera", "{", "user_defined", "location"}) in.expect(word);
  camera.location_ = povray_vector(in);
  in.expect("direction");
  camera.direction_ = povray_vector(in);
  in.expect("}");
  if (!in.at_end()) throw std::runtime_error("text behind the camera: " + in.peek());
  return camera;
}

TextCamera TextCamera::from_shader(const std::string& text) {
  TextCamera camera;
  std::istringstream lines(text);
  const std::regex number(R"(\s*(?:static )?(?:const )?float (\w+) = ([^\[]*?)[;,]?\s*(?://.*)?)");
  const std::regex vector(R"(\s*(location|position|direction) = \w+\((.*)\);)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, number)) {
      Parser in(match[2].str());
      camera.names_[match[1].str()] = in.expression();
      if (!in.at_end()) throw std::runtime_error("text behind a formula: " + line);
    } else if (std::regex_match(line, match, vector)) {
      (match[1] == "direction" ? camera.direction_ : camera.location_) = shader_vector(match[2].str());
    }
  }
  if (camera.location_.empty() || camera.direction_.empty()) throw std::runtime_error("no ray in the text");
  return camera;
}

void TextCamera::set(const std::string& name, double number) {
  if (!names_.contains(name)) throw std::runtime_error("the text has no '" + name + "'");
  names_[name] = std::make_shared<TextNode>(TextNode{"", number, {}});
}

std::array<double, 3> TextCamera::vector(const std::vector<Node>& parts, double x, double y) const {
  Values known;
  return {value(*parts[0], x, y, known), value(*parts[1], x, y, known), value(*parts[2], x, y, known)};
}

int TextCamera::operations(double x, double y) const {
  operations_ = 0;
  for (const std::vector<Node>& parts : {location_, direction_}) {
    for (const Node& part : parts) {
      Values known;
      value(*part, x, y, known);
    }
  }
  return operations_;
}

// Evaluates a function with its own values.
double TextCamera::call(const TextNode& n, double x, double y, Values& known) const {
  const Function& function = functions_.at(n.word);
  if (n.operands.size() != 2 + function.parameters.size()) throw std::runtime_error("other arguments: " + n.word);
  Values given;
  for (size_t i = 0; i < function.parameters.size(); i++) {
    given[function.parameters[i]] = value(*n.operands[2 + i], x, y, known);
  }
  const double own_x = value(*n.operands[0], x, y, known), own_y = value(*n.operands[1], x, y, known);
  return value(*function.body, own_x, own_y, given);
}

// In POV-Ray, functions must be declared before they are called.
void TextCamera::check_calls(const TextNode& n) const {
  static const std::set<std::string> kOwn = {"sin", "cos", "tan",   "asin",   "atan2", "sqrt", "exp", "pow", "abs",
                                             "min", "max", "floor", "select", "+",     "-",    "*",   "/"};
  if (!n.operands.empty() && !kOwn.contains(n.word) && !functions_.contains(n.word)) {
    throw std::runtime_error("not declared before it is called: " + n.word);
  }
  for (const Node& operand : n.operands) check_calls(*operand);
}

double TextCamera::value(const TextNode& n, double x, double y, Values& known) const {
  const std::string& word = n.word;
  if (word.empty()) return n.number;
  if (functions_.contains(word)) return call(n, x, y, known);
  if (const auto found = known.find(word); found != known.end()) return found->second;
  if (const auto name = names_.find(word); name != names_.end()) {
    return known[word] = value(*name->second, x, y, known);
  }
  if (word == "x") return x;
  if (word == "y") return y;
  if (word == "pi") return std::acos(-1.0);
  operations_++;
  if (word == "select" && n.operands.size() == 3) {
    const bool below = value(*n.operands[0], x, y, known) < 0.0;
    return value(*n.operands[below ? 1 : 2], x, y, known);
  }
  std::vector<double> a;
  for (const Node& operand : n.operands) a.push_back(value(*operand, x, y, known));
  if (a.size() == 1) {
    if (word == "-") return -a[0];
    if (word == "sin") return std::sin(a[0]);
    if (word == "cos") return std::cos(a[0]);
    if (word == "tan") return std::tan(a[0]);
    if (word == "asin") return std::asin(a[0]);
    if (word == "sqrt") return std::sqrt(a[0]);
    if (word == "exp") return std::exp(a[0]);
    if (word == "abs") return std::abs(a[0]);
    if (word == "floor") return std::floor(a[0]);
  }
  if (a.size() == 2) {
    if (word == "+") return a[0] + a[1];
    if (word == "-") return a[0] - a[1];
    if (word == "*") return a[0] * a[1];
    if (word == "/") return a[0] / a[1];
    if (word == "atan2" || word == "atan") return std::atan2(a[0], a[1]);
    if (word == "pow") return std::pow(a[0], a[1]);
    if (word == "min") return std::min(a[0], a[1]);
    if (word == "max") return std::max(a[0], a[1]);
  }
  throw std::runtime_error("unknown word '" + word + "'");
}

}  // namespace ods
