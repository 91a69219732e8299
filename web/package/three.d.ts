import type { Layout, Projection } from './index.js';

export interface PanoramaOptions {
  /** A THREE.Texture of a picture or a video with both eyes. */
  texture: any;
  layout?: Layout;
  projection?: Projection;
  /** The camera of a picture in view.json, instead of a projection. */
  camera?: object;
  /** Exchanges the eyes. */
  swap?: boolean;
}

/** A mesh that draws a stereo panorama behind its scene; THREE is the module of three.js. */
export function makePanorama<T extends { Mesh: new (...values: any[]) => any }>(THREE: T, options: PanoramaOptions): InstanceType<T['Mesh']>;
