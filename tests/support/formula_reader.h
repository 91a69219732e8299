// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the text of an exported camera and evaluates it. It is independent of the code that writes the text.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ods {

struct TextNode;

// A camera as a text: numbers and formulas by name, and a ray at every image position.
class TextCamera {
 public:
  // POV-Ray: #declare NAME = NUMBER; #declare NAME = function(x, y, ...) { ... } camera { user_defined location {
  // function { ... } x 3 } direction { ... } }. Throws std::runtime_error for any other text.
  static TextCamera from_povray(const std::string& text);

  // Lines of a shading language: float NAME = ...; location = TYPE(..., ..., ...); other lines are ignored.
  static TextCamera from_shader(const std::string& text);

  std::array<double, 3> location(double x, double y) const { return vector(location_, x, y); }
  std::array<double, 3> direction(double x, double y) const { return vector(direction_, x, y); }
  // The number of operations of POV-Ray for a ray: operators and mathematical functions, over all six components.
  // POV-Ray does not cache values between calls, and computes the condition of select() and the selected value.
  int operations(double x, double y) const;
  void set(const std::string& name, double value);  // sets a number that the text declares

 private:
  using Node = std::shared_ptr<const TextNode>;
  using Values = std::map<std::string, double>;
  // A function of x, y and other arguments.
  struct Function {
    std::vector<std::string> parameters;
    Node body;
  };
  double value(const TextNode& node, double x, double y, Values& known) const;
  void check_calls(const TextNode& node) const;
  double call(const TextNode& node, double x, double y, Values& known) const;
  std::array<double, 3> vector(const std::vector<Node>& parts, double x, double y) const;

  std::map<std::string, Node> names_;
  std::map<std::string, Function> functions_;
  mutable int operations_ = 0;
  std::vector<Node> location_;
  std::vector<Node> direction_;
};

}  // namespace ods
