// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scripts for rasterizers: three.js (run with r111 and r187), Unity and Unreal (written from their manuals, not run).
#include <fmt/format.h>

#include "ods/export/rig_writers.h"

namespace ods {

static constexpr const char* kNoNoise =
    "What is drawn with random numbers (particles, jitter) starts from the same seed before every view.";

// --- three.js -------------------------------------------------------------------------------------------------------

static constexpr const char* kThreeBody = R"(
// The camera of a view, from 1.
export function viewCamera(THREE, number, near = 0.01, far = 10000) {
  const camera = new THREE.PerspectiveCamera(verticalFov, width / height, near, far);
  camera.matrix.set(...views[number - 1], 0, 0, 0, 1);
  camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
  camera.updateMatrixWorld(true);
  return camera;
}

export function fileName(number) {
  return String(number).padStart(4, "0") + ".png";
}

// Offers the picture as a download.
export function download(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// Renders the views from first to last; save(name, blob) gets each, as a PNG, and may be asynchronous. Before them it
// gets ods-rig.txt, which identifies their rig.
export async function renderViews(THREE, renderer, scene, options = {}) {
  const { save = download, first = 1, last = views.length, near, far } = options;
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  renderer.setRenderTarget(null);
  await save("ods-rig.txt", new Blob([mark], { type: "text/plain" }));
  for (let number = first; number <= last; number++) {
    renderer.render(scene, viewCamera(THREE, number, near, far));
    const blob = await new Promise((done) => renderer.domElement.toBlob(done, "image/png"));
    if (!blob) throw new Error("ods: the browser made no PNG of view " + number);
    await save(fileName(number), blob);
  }
}
)";

RigExport rig_to_three(const SlitRig& rig, const std::string& name) {
  RigExport result;
  const glm::dvec2 half = half_size(rig);
  std::string text = commented(
      "//", head_lines(rig, name,
                       {"three.js",
                        "views/####.png",
                        false,
                        {"In a page that has made renderer and scene:",
                         fmt::format("  import {{ renderViews }} from \"./{}.three.js\";", name),
                         "  await renderViews(THREE, renderer, scene);   // downloads 0001.png, 0002.png, ...",
                         "{ save, first, last } behind it: where else pictures go, and which of them. No view is saved",
                         "before save() of the one before is done.", kNoNoise}},
                       result.warnings));
  text += fmt::format("export const width = {};\nexport const height = {};\nexport const verticalFov = {:.10g};\n",
                      rig.view.width, rig.view.height, degrees_of(half.y));
  text += fmt::format("export const mark = {};\n", mark_literal(rig));
  text += "// Three rows of four each: a view's matrix.\nexport const views = [\n";
  for (const StereoCamera& view : rig.views) text += fmt::format("  [{}],\n", matrix_rows(pose_of(view)));
  text += "];\n";
  result.scripts.push_back({".three.js", text + kThreeBody});
  return result;
}

// --- Unity ----------------------------------------------------------------------------------------------------------

static constexpr const char* kUnityBody = R"(
  [MenuItem("Tools/Render ODS views")]
  static void Render() {
    Directory.CreateDirectory(Folder);
    string mark = Path.Combine(Folder, "ods-rig.txt");
    if (!File.Exists(mark)) File.WriteAllText(mark, Mark);
    if (!File.ReadAllText(mark).Contains(Mark.Split('"')[1])) {
      Debug.LogError(mark + ": views of another rig. Remove the folder.");
      return;
    }
    var eye = new GameObject("ods view");
    var camera = eye.AddComponent<Camera>();
    if (Camera.main != null) camera.CopyFrom(Camera.main);
    camera.enabled = false;
    camera.orthographic = false;
    camera.rect = new Rect(0, 0, 1, 1);
    camera.nearClipPlane = 0.01f;
    camera.aspect = (float)Width / Height;
    camera.fieldOfView = VerticalFov;
    bool linear = QualitySettings.activeColorSpace == ColorSpace.Linear;
    var target = new RenderTexture(Width, Height, 24, RenderTextureFormat.ARGBHalf, RenderTextureReadWrite.Linear);
    target.antiAliasing = 8;
    var pixels = new Texture2D(Width, Height, TextureFormat.RGBAHalf, false, true);
    camera.targetTexture = target;
    try {
      for (int i = 0; i < Views.Length / 9; i++) {
        string path = Path.Combine(Folder, (i + 1).ToString("D4") + (linear ? ".exr" : ".png"));
        if (File.Exists(path)) continue;
        if (EditorUtility.DisplayCancelableProgressBar("ODS", path, (float)i * 9 / Views.Length)) break;
        eye.transform.SetPositionAndRotation(At(i, 0), Quaternion.LookRotation(At(i, 3), At(i, 6)));
        camera.Render();
        RenderTexture.active = target;
        pixels.ReadPixels(new Rect(0, 0, Width, Height), 0, 0);
        byte[] bytes = linear ? pixels.EncodeToEXR(Texture2D.EXRFlags.CompressZIP) : pixels.EncodeToPNG();
        File.WriteAllBytes(path + ".unfinished", bytes);
        File.Move(path + ".unfinished", path);
      }
    } finally {
      EditorUtility.ClearProgressBar();
      RenderTexture.active = null;
      camera.targetTexture = null;
      Object.DestroyImmediate(eye);
      Object.DestroyImmediate(target);
      Object.DestroyImmediate(pixels);
    }
  }

  static Vector3 At(int view, int part) {
    int i = 9 * view + part;
    return new Vector3(Views[i], Views[i + 1], Views[i + 2]);
  }
}
)";

RigExport rig_to_unity(const SlitRig& rig, const std::string& name) {
  RigExport result;
  std::string text = commented(
      "//",
      head_lines(rig, name,
                 {"Unity, for the editor",
                  "views/####.exr",
                  false,
                  {"Put it into Assets/Editor as OdsViews.cs, open the scene, choose Tools > Render ODS views. The",
                   "views go beside Assets; those that are there stay. The main camera's settings hold for them.",
                   "A project in gamma colour space writes views/####.png.",
                   "In edit mode time stands still. In play mode set Time.timeScale to 0 first.", kNoNoise}},
                 result.warnings));
  text += "using System.IO;\nusing UnityEditor;\nusing UnityEngine;\n\nclass OdsViews {\n";
  text += fmt::format("  const string Folder = \"views\";\n  const int Width = {};\n  const int Height = {};\n",
                      rig.view.width, rig.view.height);
  text += fmt::format("  const float VerticalFov = {:.9g}f;\n", degrees_of(half_size(rig).y));
  text += fmt::format("  const string Mark = {};\n", mark_literal(rig));
  text += "  // Place, ahead, up of each view. Unity's world is left-handed: its z is ours turned round.\n";
  text += "  static readonly float[] Views = {\n";
  for (const StereoCamera& view : rig.views) {
    const ViewPose pose = turned(pose_of(view), turn_left_handed);
    text += "    ";
    for (const glm::dvec3& v : {pose.place, -pose.back, pose.up}) {
      text += fmt::format("{:.8g}f, {:.8g}f, {:.8g}f, ", v.x + 0.0, v.y + 0.0, v.z + 0.0);
    }
    text.back() = '\n';
  }
  text += "  };\n";
  result.scripts.push_back({".unity.cs", text + kUnityBody});
  return result;
}

// --- Unreal ---------------------------------------------------------------------------------------------------------

static constexpr const char* kUnrealBody = R"(
import os

import unreal


def put(owner, name, value):
    try:
        owner.set_editor_property(name, value)
    except Exception as error:
        unreal.log_warning("ods: this Unreal has no %s = %s: %s" % (name, value, error))


def still(settings):
    """Nothing that remembers the view before, or weighs a picture as a whole."""
    for name, value in (("auto_exposure_method", unreal.AutoExposureMethod.AEM_MANUAL), ("motion_blur_amount", 0.0),
                        ("bloom_intensity", 0.0), ("vignette_intensity", 0.0), ("lens_flare_intensity", 0.0)):
        put(settings, "override_" + name, True)
        put(settings, name, value)
    return settings


def mark(folder):
    """Records the rig that the views belong to. A folder holds the views of one rig only."""
    path = os.path.join(folder, "ods-rig.txt")
    if not os.path.exists(path):
        with open(path, "w") as file:
            file.write(MARK)
    with open(path) as file:
        if MARK.split('"')[1] not in file.read():
            raise RuntimeError("ods: %s: views of another rig. Remove the folder" % path)


def main():
    folder = os.path.join(unreal.Paths.convert_relative_path_to_full(unreal.Paths.project_dir()), FOLDER)
    os.makedirs(folder, exist_ok=True)
    mark(folder)
    world = unreal.EditorLevelLibrary.get_editor_world()
    actor = unreal.EditorLevelLibrary.spawn_actor_from_class(unreal.SceneCapture2D, unreal.Vector(0, 0, 0))
    capture = actor.capture_component2d
    target = unreal.RenderingLibrary.create_render_target2d(
        world, SIZE[0], SIZE[1], unreal.TextureRenderTargetFormat.RTF_RGBA8_SRGB)
    put(capture, "texture_target", target)
    put(capture, "capture_source", unreal.SceneCaptureSource.SCS_FINAL_COLOR_LDR)
    put(capture, "fov_angle", HORIZONTAL_FOV)
    put(capture, "capture_every_frame", False)
    put(capture, "capture_on_movement", False)
    put(capture, "always_persist_rendering_state", False)
    put(capture, "post_process_settings", still(capture.get_editor_property("post_process_settings")))
    try:
        for number, v in enumerate(VIEWS, 1):
            name = "%04d.png" % number
            if os.path.exists(os.path.join(folder, name)):
                continue
            turn = unreal.MathLibrary.make_rot_from_xz(unreal.Vector(*v[3:6]), unreal.Vector(*v[6:9]))
            actor.set_actor_location_and_rotation(unreal.Vector(*v[0:3]), turn, False, True)
            capture.capture_scene()
            unreal.RenderingLibrary.export_render_target(world, target, folder, name)
    finally:
        actor.destroy_actor()


main()
)";

// Converts to Unreal's world: left-handed, x ahead, y right, z up.
static glm::dvec3 turn_to_unreal(glm::dvec3 v) {
  return {-v.z, v.x, v.y};
}

RigExport rig_to_unreal(const SlitRig& rig, const std::string& name) {
  RigExport result;
  std::string text = commented(
      "#",
      head_lines(
          rig, name,
          {"Unreal, for the editor",
           "views/####.png",
           false,
           {"Needs the plug-in Python Editor Script. Tools > Execute Python Script, with the level open; views",
            "go into the project's folder, and those that are there stay. The level must not be playing.", kNoNoise}},
          result.warnings));
  text += "\nFOLDER = \"views\"\n";
  text += fmt::format("SIZE = ({}, {})\nHORIZONTAL_FOV = {:.9g}\n", rig.view.width, rig.view.height,
                      degrees_of(half_size(rig).x));
  text += fmt::format("MARK = {}\n", mark_literal(rig));
  text += "# Place (centimetres), ahead, up of each view. Unreal's x is our -z, its y our x, its z our y.\nVIEWS = [\n";
  for (const StereoCamera& view : rig.views) {
    const ViewPose pose = turned(pose_of(view), turn_to_unreal);
    text += fmt::format("    ({}, {}, {}),\n", list(100.0 * pose.place), list(-pose.back), list(pose.up));
  }
  text += "]\n";
  result.scripts.push_back({".unreal.py", text + kUnrealBody});
  return result;
}

}  // namespace ods
