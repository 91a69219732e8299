// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/export/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <numbers>

namespace ods {

Formula::Formula(double number) : tree_(std::make_shared<Expression>(Expression{Operation::kNumber, number, "", {}})) {}

static Formula make(Operation operation, std::vector<Formula> operands) {
  return Formula(std::make_shared<Expression>(Expression{operation, 0.0, "", std::move(operands)}));
}

Formula named(Operation operation, const std::string& name) {
  return Formula(std::make_shared<Expression>(Expression{operation, 0.0, name, {}}));
}

bool is_number(const Formula& a) {
  return a->operation == Operation::kNumber;
}

bool is_number(const Formula& a, double value) {
  return is_number(a) && a->number == value;
}

bool same(const Formula& a, const Formula& b) {
  if (a->operation != b->operation || a->number != b->number || a->name != b->name) return false;
  return std::equal(a->operands.begin(), a->operands.end(), b->operands.begin(), b->operands.end(), same);
}

int count_step(const Formula& a, const std::string& name) {
  int count = a->operation == Operation::kStep && a->name == name ? 1 : 0;
  for (const Formula& operand : a->operands) count += count_step(operand, name);
  return count;
}

Formula replace_step(const Formula& a, const std::string& name, const Formula& by) {
  if (a->operation == Operation::kStep && a->name == name) return by;
  if (count_step(a, name) == 0) return a;
  std::vector<Formula> operands;
  for (const Formula& operand : a->operands) operands.push_back(replace_step(operand, name, by));
  return make(a->operation, std::move(operands));
}

// A sum has its number after the other operand, a product before it: p + n, n * p.
static bool has_number_behind(const Formula& a) {
  return a->operation == Operation::kAdd && is_number(a->operands[1]);
}

static bool has_number_before(const Formula& a) {
  return a->operation == Operation::kMultiply && is_number(a->operands[0]);
}

Formula operator+(const Formula& a, const Formula& b) {
  if (is_number(a) && is_number(b)) return a->number + b->number;
  if (is_number(a)) return b + a;
  if (is_number(b, 0.0)) return a;
  if (is_number(b) && has_number_behind(a)) return a->operands[0] + (a->operands[1] + b);
  if (has_number_behind(a)) return (a->operands[0] + b) + a->operands[1];
  if (has_number_behind(b)) return (a + b->operands[0]) + b->operands[1];
  return make(Operation::kAdd, {a, b});
}

Formula operator-(const Formula& a) {
  return -1.0 * a;
}

Formula operator-(const Formula& a, const Formula& b) {
  return a + -b;
}

Formula operator*(const Formula& a, const Formula& b) {
  if (is_number(a) && is_number(b)) return a->number * b->number;
  if (is_number(b)) return b * a;
  if (is_number(a, 0.0)) return 0.0;
  if (is_number(a, 1.0)) return b;
  if (is_number(a) && has_number_before(b)) return (a * b->operands[0]) * b->operands[1];
  if (is_number(a) && has_number_behind(b)) return a * b->operands[0] + a * b->operands[1];
  if (has_number_before(a)) return a->operands[0] * (a->operands[1] * b);
  if (has_number_before(b)) return b->operands[0] * (a * b->operands[1]);
  if (!is_number(a) && b->operation == Operation::kMultiply) return (a * b->operands[0]) * b->operands[1];
  return make(Operation::kMultiply, {a, b});
}

Formula operator/(const Formula& a, const Formula& b) {
  if (is_number(a, 0.0)) return 0.0;
  if (is_number(b)) return (1.0 / b->number) * a;
  if (has_number_before(b)) return (1.0 / b->operands[0]->number) * (a / b->operands[1]);
  if (has_number_before(a)) return a->operands[0] * (a->operands[1] / b);
  return make(Operation::kDivide, {a, b});
}

static Formula function(Operation operation, const Formula& a, double (*value)(double)) {
  return is_number(a) ? Formula(value(a->number)) : make(operation, {a});
}

static Formula function(Operation operation, const Formula& a, const Formula& b, double (*value)(double, double)) {
  return is_number(a) && is_number(b) ? Formula(value(a->number, b->number)) : make(operation, {a, b});
}

Formula sin(const Formula& a) {
  return function(Operation::kSin, a, std::sin);
}
Formula cos(const Formula& a) {
  return function(Operation::kCos, a, std::cos);
}
Formula tan(const Formula& a) {
  return function(Operation::kTan, a, std::tan);
}
Formula asin(const Formula& a) {
  return function(Operation::kAsin, a, std::asin);
}
Formula atan2(const Formula& y, const Formula& x) {
  return function(Operation::kAtan2, y, x, std::atan2);
}
Formula sqrt(const Formula& a) {
  return function(Operation::kSqrt, a, std::sqrt);
}
Formula exp(const Formula& a) {
  return function(Operation::kExp, a, std::exp);
}
Formula pow(const Formula& a, const Formula& exponent) {
  return is_number(exponent, 1.0) ? a : function(Operation::kPow, a, exponent, std::pow);
}
Formula abs(const Formula& a) {
  return function(Operation::kAbs, a, std::fabs);
}
Formula min(const Formula& a, const Formula& b) {
  return function(Operation::kMin, a, b, std::fmin);
}
Formula max(const Formula& a, const Formula& b) {
  return function(Operation::kMax, a, b, std::fmax);
}
Formula floor(const Formula& a) {
  return function(Operation::kFloor, a, std::floor);
}

Formula select(const Formula& condition, const Formula& below_zero, const Formula& otherwise) {
  if (is_number(condition)) return condition->number < 0.0 ? below_zero : otherwise;
  if (same(below_zero, otherwise)) return otherwise;
  return make(Operation::kSelect, {condition, below_zero, otherwise});
}

// --- printing --------------------------------------------------------------------------------------------------------

namespace {

// The precedence of an expression.
enum Binding { kSum, kProduct, kAtom };

class Printer {
 public:
  explicit Printer(Language language) : language_(language) {}

  std::string text(const Formula& a, Binding outside) const {
    const Operation operation = a->operation;
    if (operation == Operation::kAdd) return bracketed(sum(a), outside > kSum);
    if (operation == Operation::kNumber && a->number < 0.0)
      return bracketed(fmt::format("-{}", number(-a->number)), outside > kSum);
    if (operation == Operation::kMultiply) {
      if (is_negative(a)) return bracketed(fmt::format("-{}", text(-a, kProduct)), outside > kSum);
      return bracketed(product(a), outside > kProduct);
    }
    if (operation == Operation::kDivide) {
      return bracketed(fmt::format("{}/{}", text(a->operands[0], kProduct), text(a->operands[1], kAtom)),
                       outside > kProduct);
    }
    return atom(a);
  }

 private:
  static std::string bracketed(const std::string& text, bool brackets) {
    return brackets ? fmt::format("({})", text) : text;
  }

  // Prints a multiple of pi as "pi", "2*pi", "pi/180", a multiple of 1/pi as "180/pi", and all other numbers with 10
  // digits.
  std::string number(double value) const {
    for (const double times : {0.5, 180.0}) {
      if (std::abs(value * std::numbers::pi - times) < 1e-12 * times) return plain(times) + "/pi";
    }
    for (const double part : {1.0, 2.0, 3.0, 4.0, 180.0, 360.0}) {
      const double times = value * part / std::numbers::pi;
      if (times < 0.5 || times > 12.5 || std::abs(times - std::round(times)) > 1e-12) continue;
      return fmt::format("{}pi{}", std::round(times) == 1.0 ? "" : plain(std::round(times)) + "*",
                         part == 1.0 ? "" : fmt::format("/{}", plain(part)));
    }
    return plain(value);
  }

  std::string plain(double value) const {
    std::string text = fmt::format("{:.10g}", value);
    const bool whole = text.find_first_of(".e") == std::string::npos;
    return whole && is_shader() ? text + ".0" : text;
  }

  bool is_shader() const {
    return language_ == Language::kOsl || language_ == Language::kGlsl || language_ == Language::kHlsl;
  }

  static bool is_negative(const Formula& a) {
    return (is_number(a) && a->number < 0.0) || (has_number_before(a) && a->operands[0]->number < 0.0);
  }

  static void collect_terms(const Formula& a, std::vector<Formula>& terms) {
    if (a->operation != Operation::kAdd) return terms.push_back(a);
    for (const Formula& operand : a->operands) collect_terms(operand, terms);
  }

  // Starts with a term that needs no minus sign, if there is one.
  std::string sum(const Formula& a) const {
    std::vector<Formula> terms;
    collect_terms(a, terms);
    const auto first = std::find_if_not(terms.begin(), terms.end(), is_negative);
    if (first != terms.end()) std::rotate(terms.begin(), first, first + 1);
    std::string result = text(terms[0], kSum);
    for (size_t i = 1; i < terms.size(); i++) {
      const bool minus = is_negative(terms[i]);
      result += (minus ? " - " : " + ") + text(minus ? -terms[i] : terms[i], kProduct);
    }
    return result;
  }

  // A product without a negative number. A factor 1/n with an integer n becomes a division.
  std::string product(const Formula& a) const {
    const Formula& left = a->operands[0];
    const Formula& right = a->operands[1];
    if (!is_number(left)) return text(left, kProduct) + "*" + text(right, kAtom);
    const double one_over = 1.0 / left->number;
    if (one_over > 1.5 && one_over < 1000.0 && std::abs(one_over - std::round(one_over)) < 1e-12 * one_over) {
      return text(right, kProduct) + "/" + plain(std::round(one_over));
    }
    return number(left->number) + "*" + text(right, kProduct);
  }

  std::string atom(const Formula& a) const {
    switch (a->operation) {
      case Operation::kNumber:
        return number(a->number);
      case Operation::kVariable:
        return a->name;
      case Operation::kParameter:
      case Operation::kStep:
        return print_name(a->name, language_);
      case Operation::kSelect:
        return choice(text(a->operands[0], kSum), text(a->operands[1], kSum), text(a->operands[2], kSum));
      default:
        break;
    }
    std::string arguments;
    for (const Formula& operand : a->operands) arguments += (arguments.empty() ? "" : ", ") + text(operand, kSum);
    return fmt::format("{}({})", function_name(a->operation), arguments);
  }

  std::string choice(const std::string& condition, const std::string& below, const std::string& otherwise) const {
    if (is_shader()) return fmt::format("({} < 0.0 ? {} : {})", condition, below, otherwise);
    if (language_ == Language::kPython) return fmt::format("({} if {} < 0 else {})", below, condition, otherwise);
    return fmt::format("select({}, {}, {})", condition, below, otherwise);
  }

  std::string function_name(Operation operation) const {
    switch (operation) {
      case Operation::kSin:
        return "sin";
      case Operation::kCos:
        return "cos";
      case Operation::kTan:
        return "tan";
      case Operation::kAsin:
        return "asin";
      case Operation::kAtan2:
        return language_ == Language::kGlsl ? "atan" : "atan2";
      case Operation::kSqrt:
        return "sqrt";
      case Operation::kExp:
        return "exp";
      case Operation::kPow:
        return "pow";
      case Operation::kAbs:
        return "abs";
      case Operation::kMin:
        return "min";
      case Operation::kMax:
        return "max";
      default:
        assert(operation == Operation::kFloor);
        return "floor";
    }
  }

  Language language_;
};

}  // namespace

std::string print(const Formula& formula, Language language) {
  return Printer(language).text(formula, kSum);
}

// In POV-Ray all names share one namespace with the scene. Our names are those of the page that its users know.
std::string print_name(const std::string& name, Language language) {
  if (language != Language::kPovray) return name;
  if (name == "ipd") return "odsIPD";
  if (name == "yaw") return "odsAngle";
  if (name == "cosine_exponent") return "odsVerticalModulation";
  std::string result = "ods";
  bool capital = true;
  for (const char c : name) {
    if (c != '_') result += capital ? static_cast<char>(std::toupper(c)) : c;
    capital = c == '_';
  }
  return result;
}

}  // namespace ods
