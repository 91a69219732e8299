// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// POV-Ray 3.7: a camera to include and the options of an animation. The frame number selects the view, and the clock
// stops, so that a scene animated by its clock does not move either.
#include <fmt/format.h>

#include <algorithm>

#include "ods/export/rig_writers.h"

namespace ods {

static std::string vectors(const SlitRig& rig, const char* word, glm::dvec3 ViewPose::*part, double sign) {
  std::string text = fmt::format("#declare ods_{} = array[{}] {{\n", word, rig.views.size());
  for (size_t i = 0; i < rig.views.size(); i++) {
    const ViewPose pose = turned(pose_of(rig.views[i]), turn_left_handed);
    text += fmt::format("  <{}>{}\n", list(sign * pose.*part), i + 1 < rig.views.size() ? "," : "");
  }
  return text + "}\n";
}

// The line that identifies the rig of the views. A folder belongs to one rig; otherwise +C would continue among another
// rig's views. POV-Ray's strings have at most 255 characters.
static std::string mark_text(const SlitRig& rig) {
  constexpr size_t kLongest = 100;
  const std::string literal = mark_literal(rig);
  std::string pieces;
  for (size_t i = 1, end = literal.size() - 1; i < end;) {
    size_t count = std::min(kLongest, end - i);
    if (literal[i + count - 1] == '\\') count++;
    pieces += fmt::format("{}    \"{}\"", pieces.empty() ? "" : ",\n", literal.substr(i, count));
    i += count;
  }
  const std::string file = mark_file_text(rig_mark(rig)), views = file.substr(0, file.find('\n'));
  return fmt::format(R"(#declare ods_mark = "views/ods-rig.txt";
#if (file_exists(ods_mark))
  #fopen ods_file ods_mark read
  #read (ods_file, ods_rig)
  #fclose ods_file
  #if (strcmp(ods_rig, {}) != 0)
    #error concat(ods_mark, ": views of another rig. Remove the folder views\n")
  #end
#else
  #fopen ods_file ods_mark write
  #write (ods_file,
{})
  #fclose ods_file
#end
)",
                     views, pieces);
}

static std::string camera_text(const SlitRig& rig, const std::vector<std::string>& head) {
  const glm::dvec2 half = half_size(rig);
  std::string text = commented("//", head);
  text += "// POV-Ray's world is left-handed: its z is ours turned round. Lengths are metres.\n";
  text += vectors(rig, "place", &ViewPose::place, 1.0) + vectors(rig, "ahead", &ViewPose::back, -1.0) +
          vectors(rig, "right", &ViewPose::right, 1.0) + vectors(rig, "up", &ViewPose::up, 1.0);
  text += mark_text(rig);
  text += fmt::format("#declare ods_view = min(max(frame_number, 1), {}) - 1;\n", rig.views.size());
  text += fmt::format(
      "camera {{\n  perspective\n  location ods_place[ods_view]\n  direction ods_ahead[ods_view]\n"
      "  up ods_up[ods_view] * {:.10g}\n  right ods_right[ods_view] * {:.10g}\n}}\n",
      2.0 * half.y, 2.0 * half.x);
  return text;
}

RigExport rig_to_povray(const SlitRig& rig, const std::string& name) {
  RigExport result;
  // POV-Ray writes as many digits as the last frame of the animation has: 9999,
  // of which the views are the first frames.
  const size_t digits = std::max<size_t>(4, std::to_string(rig.views.size()).size());
  const std::vector<std::string> head = head_lines(
      rig, name,
      {"POV-Ray 3.7",
       "views/view" + std::string(digits, '#') + ".exr",
       false,
       {fmt::format("Put #include \"{}.povray.inc\" at the end of the scene, make a folder views, and:", name),
        fmt::format("  povray {}.povray.ini +Iscene.pov", name),
        fmt::format("  povray {}.povray.ini +Iscene.pov +SF1 +EF100    views 1 to 100, for a farm", name),
        fmt::format("  povray {}.povray.ini +Iscene.pov +KI2.5 +KF2.5  all at clock 2.5", name),
        fmt::format("  povray {}.povray.ini +Iscene.pov +C             resumes where it stopped", name),
        "Random numbers: seed() gives a scene the same ones in every view."}},
      result.warnings);
  result.scripts.push_back({".povray.inc", camera_text(rig, head)});
  std::string options = commented(";", head);
  options += fmt::format("Width={}\nHeight={}\n", rig.view.width, rig.view.height);
  options += fmt::format("Initial_Frame=1\nFinal_Frame={}\nSubset_Start_Frame=1\nSubset_End_Frame={}\n",
                         std::string(digits, '9'), rig.views.size());
  options += "Initial_Clock=0\nFinal_Clock=0\nOutput_File_Type=E\nOutput_File_Name=views/view\nDisplay=Off\n";
  options += "Antialias=On\nSampling_Method=2\n; Radiosity and photons come out the same each time.\n";
  options += "High_Reproducibility=On\n";
  result.scripts.push_back({".povray.ini", options});
  return result;
}

}  // namespace ods
