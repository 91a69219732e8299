// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A stereo panorama around a scene of three.js, with the shader of the viewer's own formulas. In a headset, and with
// three's StereoCamera, each camera sees its eye's picture; other cameras see the left one.
import { LAYOUTS, PROJECTIONS } from './formats.js';
import { LOOKUP } from './lookup.js';

const VERTICES = `in vec3 position;
uniform mat4 projectionMatrix;
uniform mat4 viewMatrix;
uniform mat4 modelMatrix;
out vec3 direction;
void main() {
  vec4 far = inverse(projectionMatrix) * vec4(position.xy, 1.0, 1.0);
  direction = transpose(mat3(modelMatrix)) * (transpose(mat3(viewMatrix)) * (far.xyz / far.w));
  gl_Position = vec4(position.xy, 1.0, 1.0);
}`;
function named(what, rows, name) {
  const row = rows.find((each) => each.name === name);
  if (!row) throw new Error(`"${name}" is not a ${what}. There are: ${rows.map((each) => each.name).join(', ')}`);
  return row;
}

// Cameras of right eyes see layer 2 and not layer 1.
const isRight = ({ layers }) => (layers.mask & 6) === 4;

// Returns a map of the camera as a texture; null for a camera without that map.
function mapTexture(THREE, { width, height, texels }) {
  if (!texels) return null;
  const texture = new THREE.DataTexture(new Float32Array(texels), width, height, THREE.RedFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

// Returns a mesh that draws the panorama behind everything else of its scene; its rotation turns the panorama, its
// position does not matter. THREE: the module of three.js. texture: a picture or a video with both eyes. layout,
// projection: their names; camera: the picture's own, instead of a projection: { ...camera } of view.json. swap: exchanges
// the eyes. Throws an Error for an unknown name.
export function makePanorama(THREE, { texture, layout = 'top-bottom', projection = 'lat-long', camera, swap = false }) {
  const parts = named('layout', LAYOUTS, layout);
  const eyes = [parts.left, parts.right];
  const shape = camera ?? named('projection', PROJECTIONS, projection).camera;
  const nothing = [0, 0, 0];
  const uniforms = {
    camera: { value: { center: nothing, right: nothing, up: nothing, back: nothing, lens_radius: 0, focus_distance: 1, ...shape } },
    merge_texels: { value: mapTexture(THREE, shape.merge_map) }, head_tilt_texels: { value: mapTexture(THREE, shape.head_tilt_map) },
    picture: { value: texture }, part: { value: eyes[0] }, side: { value: 2 }, is_upside_down: { value: false }, transfer: { value: 0 },
  };
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: VERTICES, fragmentShader: LOOKUP.slice(LOOKUP.indexOf('\n') + 1), // without its #version
    uniforms, depthTest: false, depthWrite: false,
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
  const mesh = new THREE.Mesh(geometry, material);
  Object.assign(mesh, { frustumCulled: false, renderOrder: -1e9 });
  mesh.onBeforeRender = (renderer, scene, seen) => {
    const { value } = uniforms.picture;
    const target = renderer.getRenderTarget();
    const isLight = value.colorSpace === THREE.SRGBColorSpace; // the GPU decodes it
    const wantsLight = Boolean(target && !target.isXRRenderTarget);
    const eye = Number(isRight(seen) !== swap);
    uniforms.part.value = eyes[eye];
    uniforms.side.value = layout === 'mono' ? 2 : eye;
    uniforms.is_upside_down.value = value.flipY;
    uniforms.transfer.value = Number(isLight) - Number(wantsLight);
    material.uniformsNeedUpdate = true;
  };
  return mesh;
}
