// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The targets that accept formulas: POV-Ray, OSL, GLSL, HLSL, Python, plain text.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ods/export/writers.h"

namespace ods {
namespace {

const Formula kX = named(Operation::kVariable, "x");
const Formula kY = named(Operation::kVariable, "y");

CameraExport refuse(const std::string& fault) {
  return {"", {}, fault};
}

std::vector<std::string> formula_warnings(const Sidecar& file) {
  if (file.camera.lens_radius == 0.0f) return {};
  return {"the blur of the lens is left out: a formula has one ray per position"};
}

std::string print_vector(const std::array<Formula, 3>& v, Language language) {
  return fmt::format("{}, {}, {}", print(v[0], language), print(v[1], language), print(v[2], language));
}

// Two eyes that do not share a picture are rendered one after the other.
std::string eye_hint(const Sidecar& file, const CameraFormula& formula, const std::string& mark,
                     const std::string& name) {
  for (const NamedFormula& parameter : formula.parameters) {
    if (parameter.name != "eye" || file.eyes.size() == 1) continue;
    return fmt::format("{} Two pictures: one with {} -1, one with {} 1.\n", mark, name, name);
  }
  return "";
}

struct Shader {
  Language language;
  std::string_view number;  // declaration of a constant
  std::string_view signature;
  std::string_view vector;
};

std::string steps_text(const CameraFormula& formula, Language language, std::string_view declare,
                       std::string_view end) {
  std::string text;
  for (const NamedFormula& step : formula.steps) {
    text += fmt::format("  {}{} = {}{}\n", declare, step.name, print(step.value, language), end);
  }
  return text;
}

std::string remark(const std::string& meaning, const char* mark) {
  return meaning.empty() ? "" : fmt::format("  {} {}", mark, meaning);
}

CameraExport to_shader(const Sidecar& file, const FormulaView& view, const Shader& shader,
                       const std::string& convention) {
  const std::string fault = formula_fault(file);
  if (!fault.empty()) return refuse(fault);
  const CameraFormula formula = camera_formula(file, view);
  CameraExport result{"", formula_warnings(file), ""};
  std::string& text = result.text;
  text = comment_block("//", "The ray of a stereo 360 picture: " + camera_title(file) + ".", result.warnings);
  text += "// x, y: position in the whole picture, 0..1 from its left and top edge. Metres.\n";
  text += fmt::format("// {}\n", convention);
  if (has_image_circle(file.camera.projection.kind)) text += "// Where the picture is empty the direction is 0.\n";
  text += eye_hint(file, formula, "//", "eye");
  text += fmt::format("{} pi = 3.141592653589793;\n", shader.number);
  for (const NamedFormula& parameter : formula.parameters) {
    text += fmt::format("{} {} = {};{}\n", shader.number, parameter.name, print(parameter.value, shader.language),
                        remark(parameter.meaning, "//"));
  }
  text += fmt::format("\n{} {{\n{}", shader.signature, steps_text(formula, shader.language, "float ", ";"));
  text += fmt::format("  location = {}({});\n", shader.vector, print_vector(formula.location, shader.language));
  text += fmt::format("  direction = {}({});\n}}\n", shader.vector, print_vector(formula.direction, shader.language));
  return result;
}

// A vector in POV-Ray, whose functions have no local variables: a function that is called twice is computed twice, and
// its own callees four times. So a step that a component would compute more than once becomes a link of a chain: a
// function of the previous links that are still needed, which passes these and its own value to the next function. The
// last one selects the component. All other steps are written out where they are used.
class PovrayVector {
 public:
  PovrayVector(const std::string& name, const std::array<Formula, 3>& v, const std::vector<NamedFormula>& steps)
      : name_(name), v_(v), chain_(steps) {
    std::vector<std::string> links;
    for (const NamedFormula& step : steps) {
      if (evaluations(step.name) > 1) links.push_back(step.name);
    }
    for (const NamedFormula& step : steps) {
      const bool shared = !links.empty() && occurrences(step.name) > 1;
      if (!shared && std::find(links.begin(), links.end(), step.name) == links.end()) write_out(step.name);
    }
  }

  // The last function comes first, because POV-Ray must know it when it reads the call.
  std::string functions() const {
    if (chain_.empty()) return "";
    std::string text = declare(chain_.size(), chosen());
    for (size_t i = chain_.size(); i-- > 0;) {
      std::vector<std::string> values;
      for (const std::string& name : needed_from(i + 1)) {
        values.push_back(name == chain_[i].name ? print(chain_[i].value, Language::kPovray)
                                                : print_name(name, Language::kPovray));
      }
      text += declare(i, fmt::format("{}(x, y, odsPart, {})", function_name(i + 1), fmt::join(values, ", ")));
    }
    return text;
  }

  std::string camera_part() const {
    std::string text = fmt::format("  {} {{\n", name_);
    for (size_t i = 0; i < 3; i++) {
      text +=
          fmt::format("    function {{ {} }}\n", uses_chain(v_[i]) ? fmt::format("{}(x, y, {})", function_name(0), i)
                                                                   : print(v_[i], Language::kPovray));
    }
    return text + "  }\n";
  }

 private:
  bool uses_chain(const Formula& part) const {
    return std::any_of(chain_.begin(), chain_.end(),
                       [&](const NamedFormula& step) { return count_step(part, step.name) > 0; });
  }

  // The number of times that a component computes a step if all steps are written out; the maximum over the components.
  double evaluations(const std::string& name) const {
    double maximum = 0.0;
    for (const Formula& part : v_) {
      std::vector<double> counts(chain_.size());
      size_t found = 0;
      for (size_t i = chain_.size(); i-- > 0;) {
        counts[i] = count_step(part, chain_[i].name);
        for (size_t user = i + 1; user < chain_.size(); user++) {
          counts[i] += counts[user] * count_step(chain_[user].value, chain_[i].name);
        }
        if (chain_[i].name == name) found = i;
      }
      maximum = std::max(maximum, counts[found]);
    }
    return maximum;
  }

  // Occurrences in the text.
  int occurrences(const std::string& name) const {
    int count = 0;
    for (const Formula& part : v_) count += count_step(part, name);
    for (const NamedFormula& step : chain_) count += count_step(step.value, name);
    return count;
  }

  void write_out(const std::string& name) {
    const auto step = std::find_if(chain_.begin(), chain_.end(), [&](const auto& each) { return each.name == name; });
    const Formula value = step->value;
    chain_.erase(step);
    for (NamedFormula& each : chain_) each.value = replace_step(each.value, name, value);
    for (Formula& part : v_) part = replace_step(part, name, value);
  }

  // The values passed to function i: values of the previous links that it or a later one needs.
  std::vector<std::string> needed_from(size_t i) const {
    std::vector<std::string> names;
    for (size_t link = 0; link < i; link++) {
      const std::string& name = chain_[link].name;
      bool needed = std::any_of(v_.begin(), v_.end(), [&](const Formula& part) { return count_step(part, name) > 0; });
      for (size_t later = i; later < chain_.size(); later++) {
        needed = needed || count_step(chain_[later].value, name) > 0;
      }
      if (needed) names.push_back(name);
    }
    return names;
  }

  std::string chosen() const {
    return fmt::format("select(odsPart - 0.5, {}, select(odsPart - 1.5, {}, {}))", print(v_[0], Language::kPovray),
                       print(v_[1], Language::kPovray), print(v_[2], Language::kPovray));
  }

  std::string function_name(size_t i) const {
    return fmt::format("{}{}", print_name(name_, Language::kPovray), i == 0 ? "" : fmt::format("{}", i));
  }

  std::string declare(size_t i, const std::string& body) const {
    std::string parameters = "x, y, odsPart";
    for (const std::string& name : needed_from(i)) parameters += ", " + print_name(name, Language::kPovray);
    return fmt::format("#declare {} = function({}) {{ {} }}\n", function_name(i), parameters, body);
  }

  std::string name_;
  std::array<Formula, 3> v_;
  std::vector<NamedFormula> chain_;
};

}  // namespace

CameraExport to_povray(const Sidecar& file) {
  const std::string fault = formula_fault(file);
  if (!fault.empty()) return refuse(fault);
  FormulaView view{kX + 0.5, 0.5 - kY};
  view.left_handed = true;
  const CameraFormula formula = camera_formula(file, view);
  CameraExport result{"", formula_warnings(file), ""};
  std::string& text = result.text;
  text = comment_block("//", "POV-Ray 3.8, user_defined camera: " + camera_title(file) + ".", result.warnings);
  text +=
      "// POV-Ray's world is left-handed and ours is not: all z here are ours turned round, as a scene's must be that\n"
      "// shall look the same. Lengths are metres.\n";
  const Extent size = picture_size(file);
  if (size.width > 0) text += fmt::format("// Render with +W{} +H{}.\n", size.width, size.height);
  if (has_image_circle(file.camera.projection.kind)) {
    text += "// Where the picture is empty the direction is 0, which POV-Ray 3.8 paints black with alpha 0.\n";
  }
  text += eye_hint(file, formula, "//", "odsEye");
  for (const NamedFormula& parameter : formula.parameters) {
    text += fmt::format("#declare {} = {};{}\n", print_name(parameter.name, Language::kPovray),
                        print(parameter.value, Language::kPovray), remark(parameter.meaning, "//"));
  }
  const PovrayVector location("location", formula.location, formula.steps);
  const PovrayVector direction("direction", formula.direction, formula.steps);
  const std::string functions = location.functions() + direction.functions();
  if (!functions.empty()) {
    text +=
        "// Read each group of functions from its last: every function computes one value and hands it on, with those\n"
        "// that are still needed. So POV-Ray computes each value once. odsPart: 0 is x, 1 is y, 2 is z.\n";
  }
  text += functions;
  text += "camera {\n  user_defined\n" + location.camera_part() + direction.camera_part() + "}\n";
  return result;
}

CameraExport to_glsl(const Sidecar& file) {
  return to_shader(file, {kX, kY},
                   {Language::kGlsl, "const float",
                    "void ods_camera_ray(float x, float y, out vec3 location, out vec3 direction)", "vec3"},
                   "World: right-handed, +Y up; at yaw 0 the middle of the picture looks along -Z.");
}

CameraExport to_hlsl(const Sidecar& file) {
  FormulaView view{kX, kY};
  view.left_handed = true;
  return to_shader(file, view,
                   {Language::kHlsl, "static const float",
                    "void ods_camera_ray(float x, float y, out float3 location, out float3 direction)", "float3"},
                   "World: left-handed as Direct3D's, +Y up; at yaw 0 the middle looks along +Z. All z are turned "
                   "round.");
}

CameraExport to_osl(const Sidecar& file) {
  const std::string fault = formula_fault(file);
  if (!fault.empty()) return refuse(fault);
  FormulaView view{kX, 1.0 - kY};
  view.left_handed = view.camera_frame = true;
  const CameraFormula formula = camera_formula(file, view);
  CameraExport result{"", formula_warnings(file), ""};
  std::string& text = result.text;
  text = comment_block("//", "A camera shader for Cycles 5: " + camera_title(file) + ".", result.warnings);
  text +=
      "// Camera data: type CUSTOM, custom_mode EXTERNAL, custom_filepath this file; parameters as\n"
      "// camera.cycles_custom[\"ipd\"]. Turn the scene's own stereo off: the whole picture is one render. Blender "
      "must\n"
      "// be built with OSL, else the picture is black: look at _cycles.with_osl.\n"
      "// Untested: by Blender's manual, \"Custom Camera\"; never rendered with.\n";
  const Extent size = picture_size(file);
  if (size.width > 0) text += fmt::format("// Resolution {} x {}.\n", size.width, size.height);
  text += fmt::format("// Place the camera object: position {:.6g}, {:.6g}, {:.6g} (x, -z, y of ours), {}.\n",
                      file.camera.position.x, 0.0f - file.camera.position.z, file.camera.position.y,
                      yaw_pitch_roll(file.camera));
  text += eye_hint(file, formula, "//", "eye");
  text += "#include \"stdcycles.h\"\n\nshader ods_camera(\n";
  for (const NamedFormula& parameter : formula.parameters) {
    text += fmt::format("    float {} = {},{}\n", parameter.name, print(parameter.value, Language::kOsl),
                        remark(parameter.meaning, "//"));
  }
  text +=
      "    output point position = point(0.0, 0.0, 0.0),\n"
      "    output vector direction = vector(0.0, 0.0, 1.0),\n"
      "    output color throughput = color(1.0, 1.0, 1.0)) {\n"
      "  float pi = 3.141592653589793;\n"
      "  point raster = camera_shader_raster_position();\n"
      "  float x = raster[0];\n"
      "  float y = raster[1];\n";
  text += steps_text(formula, Language::kOsl, "float ", ";");
  text += fmt::format("  position = point({});\n", print_vector(formula.location, Language::kOsl));
  text += fmt::format("  direction = vector({});\n", print_vector(formula.direction, Language::kOsl));
  if (has_image_circle(file.camera.projection.kind)) text += "  throughput = color(seen, seen, seen);\n";
  text += "}\n";
  return result;
}

CameraExport to_python(const Sidecar& file) {
  const std::string fault = formula_fault(file);
  if (!fault.empty()) return refuse(fault);
  const CameraFormula formula = camera_formula(file, {kX, kY});
  CameraExport result{"", formula_warnings(file), ""};
  std::string& text = result.text;
  text = comment_block("#", "The ray of a stereo 360 picture: " + camera_title(file) + ".", result.warnings);
  text +=
      "# x, y: position in the whole picture, 0..1 from its left and top edge. Metres; right-handed, +Y up; at yaw 0\n"
      "# the middle of the picture looks along -Z.\n";
  text += eye_hint(file, formula, "#", "eye");
  text += "from math import asin, atan2, cos, exp, floor, pi, pow, sin, sqrt, tan\n\n";
  for (const NamedFormula& parameter : formula.parameters) {
    text += fmt::format("{} = {}{}\n", parameter.name, print(parameter.value, Language::kPython),
                        remark(parameter.meaning, "#"));
  }
  text += "\n\ndef ods_camera_ray(x, y):\n";
  text += steps_text(formula, Language::kPython, "  ", "");
  text += fmt::format("    location = ({})\n    direction = ({})\n    return location, direction\n",
                      print_vector(formula.location, Language::kPython),
                      print_vector(formula.direction, Language::kPython));
  return result;
}

CameraExport to_numbers(const Sidecar& file) {
  const StereoCamera& camera = file.camera;
  CameraExport result;
  std::string& text = result.text;
  const auto row = [&](const char* name, const auto&... values) {
    text += name;
    (fmt::format_to(std::back_inserter(text), " {}", values), ...);
    text += "\n";
  };
  const Extent size = picture_size(file);
  row("title", camera_title(file));
  if (size.width > 0) row("picture", size.width, size.height);
  const std::array<glm::dvec3, 4> place = placement(camera);
  const char* names[] = {"right", "up", "back", "location"};
  for (size_t i = 0; i < 4; i++) {
    text += fmt::format("{} {:.8g} {:.8g} {:.8g}\n", names[i], place[i].x, place[i].y, place[i].z);
  }
  row("yaw_pitch_roll", camera.yaw, camera.pitch, camera.roll);
  row("ipd", camera.ipd);
  row("neck", camera.neck);
  row("merge", merge_text(camera));
  row("convergence", convergence_name(camera.convergence), camera.convergence_distance);
  row("axis", camera.axis ? fmt::format("{} {} {}", camera.axis->x, camera.axis->y, camera.axis->z) : "camera");
  row("longitude", camera.projection.longitude.x, camera.projection.longitude.y);
  row("latitude", camera.projection.latitude.x, camera.projection.latitude.y);
  row("fov", camera.projection.fov);
  row("look", camera.projection.pan, camera.projection.tilt);
  row("lens", camera.lens_radius, camera.focus_distance);
  row("mirrored", camera.mirrored);
  const std::string fault = formula_fault(file);
  if (!fault.empty()) {
    result.warnings.push_back("the formulas are left out: " + fault);
    row("formulas", fault);
    return result;
  }
  row("formulas",
      "of x and y, 0..1 from the left and top edge of the picture; select(a, b, c) is b where a < 0, else c");
  const CameraFormula formula = camera_formula(file, {kX, kY});
  const auto equation = [&](const std::string& name, const Formula& value) {
    text += fmt::format("{} = {}\n", name, print(value, Language::kPlain));
  };
  for (const NamedFormula& parameter : formula.parameters) equation(parameter.name, parameter.value);
  for (const NamedFormula& step : formula.steps) equation(step.name, step.value);
  const char axes[] = "xyz";
  for (size_t i = 0; i < 3; i++) equation(fmt::format("origin_{}", axes[i]), formula.location[i]);
  for (size_t i = 0; i < 3; i++) equation(fmt::format("direction_{}", axes[i]), formula.direction[i]);
  return result;
}

}  // namespace ods
