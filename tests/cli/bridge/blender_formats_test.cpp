// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of other programs that Blender itself imports.
#include <gtest/gtest.h>

#include "tests/support/blender_cli.h"

namespace ods::blender_formats_test {

class BlenderFormats : public BlenderCli {};

TEST_F(BlenderFormats, AreConverted) {
  folder.write("t.obj", "o x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("t.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("t.stl",
               "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
               "endsolid x\n");
  for (const char* name : {"t.obj", "t.ply", "t.stl"}) {
    EXPECT_EQ(run("info " + folder.path(name)), 0) << err;
    EXPECT_NE(out.find("triangles      1 "), std::string::npos) << name;
  }
}

// Blender 2 wrote its hemispheric light, which is gone, into Collada.
TEST_F(BlenderFormats, LightsWithoutAKindAreNamed) {
  folder.write("t.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <library_lights>
    <light id="hemi" name="hemi"><technique_common><ambient><color>1 1 1</color></ambient></technique_common>
      <extra><technique profile="blender"><type>3</type></technique></extra></light>
    <light id="lamp" name="lamp"><technique_common><point><color>1 1 1</color></point></technique_common></light>
  </library_lights>
  <library_visual_scenes><visual_scene id="s">
    <node><instance_light url="#hemi"/></node><node><instance_light url="#lamp"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)");
  const int code = run("info " + folder.path("t.dae"));
  if (err.find("this Blender does not read .dae files") != std::string::npos)
    GTEST_SKIP() << "skipped: no Collada here";
  EXPECT_EQ(code, 0) << err;
  EXPECT_NE(out.find("1 point"), std::string::npos) << out;
  EXPECT_NE(out.find("a light of a kind that Blender does not have does not come across: light 'hemi'"),
            std::string::npos)
      << out;
}

// With Assimp's command, the error is a note before it tries.
TEST_F(BlenderFormats, ErrorsOfImportersAreOneLine) {
  folder.write("t.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nend_header\n1");
  run("info " + folder.path("t.ply"));
  EXPECT_NE(err.find("t.ply': Blender"), std::string::npos) << err;
  EXPECT_EQ(err.find("Traceback"), std::string::npos) << err;
}

}  // namespace ods::blender_formats_test
