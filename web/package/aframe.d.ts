/** Registers the component stereo-360 with A-Frame; done on import if there is a global AFRAME. */
export function registerStereo360(AFRAME: any): void;
