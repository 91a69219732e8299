// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Formulas as trees, printed in the languages of other renderers. Building a formula simplifies it: numbers are folded,
// sums and products with 0 and 1 vanish, and the result reads as a person would write it.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ods {

enum class Operation {
  kNumber,
  kVariable,   // depends on the image position
  kParameter,  // a named number, which the user of the formula may change
  kStep,       // the value of another formula
  kAdd,
  kMultiply,
  kDivide,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAtan2,
  kSqrt,
  kExp,
  kPow,
  kAbs,
  kMin,
  kMax,
  kFloor,
  kSelect,  // three operands: the second if the first is negative, else the third
};

struct Expression;

class Formula {
 public:
  Formula(double number);  // NOLINT: implicit, so that 2.0 * x compiles
  explicit Formula(std::shared_ptr<const Expression> tree) : tree_(std::move(tree)) {}
  const Expression& operator*() const { return *tree_; }
  const Expression* operator->() const { return tree_.get(); }

 private:
  std::shared_ptr<const Expression> tree_;
};

struct Expression {
  Operation operation = Operation::kNumber;
  double number = 0.0;
  std::string name;  // for kVariable, kParameter, kStep
  std::vector<Formula> operands;
};

Formula named(Operation operation, const std::string& name);

Formula operator+(const Formula& a, const Formula& b);
Formula operator-(const Formula& a, const Formula& b);
Formula operator-(const Formula& a);
Formula operator*(const Formula& a, const Formula& b);
Formula operator/(const Formula& a, const Formula& b);
Formula sin(const Formula& a);
Formula cos(const Formula& a);
Formula tan(const Formula& a);
Formula asin(const Formula& a);
Formula atan2(const Formula& y, const Formula& x);
Formula sqrt(const Formula& a);
Formula exp(const Formula& a);
Formula pow(const Formula& a, const Formula& exponent);
Formula abs(const Formula& a);
Formula min(const Formula& a, const Formula& b);
Formula max(const Formula& a, const Formula& b);
Formula floor(const Formula& a);
Formula select(const Formula& condition, const Formula& below_zero, const Formula& otherwise);

bool is_number(const Formula& a);
bool is_number(const Formula& a, double value);
bool same(const Formula& a, const Formula& b);

// count_step() returns how often the named step occurs in the formula itself, not inside other steps. replace_step()
// replaces the step by another formula.
int count_step(const Formula& a, const std::string& name);
Formula replace_step(const Formula& a, const std::string& name, const Formula& by);

enum class Language { kPovray, kOsl, kGlsl, kHlsl, kPython, kPlain };

// Prints a formula as an expression of the language. Pi is written `pi`, which Python and the shading languages must
// define; a number has 10 digits. In POV-Ray, names become odsName.
std::string print(const Formula& formula, Language language);
std::string print_name(const std::string& name, Language language);

}  // namespace ods
