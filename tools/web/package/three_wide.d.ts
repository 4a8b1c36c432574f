import type { BufferGeometry, Camera, Material } from "three";
import type { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import type { Rimline } from "rimline";
import type { LineOptions } from "rimline/three";

/**
 * As SilhouetteLines, with lines of any width: `material.linewidth` pixels, two by default. `material` is a LineMaterial;
 * for WebGPURenderer it must be given, as a Line2NodeMaterial of three/webgpu.
 */
export class WideSilhouetteLines extends LineSegments2 {
  constructor(rimline: Rimline, geometry: BufferGeometry, options?: LineOptions & { material?: Material | null });
  readonly lineCount: number;
  readonly writtenCount: number;
  update(camera: Camera): void;
  clone(recursive?: boolean): this;
  dispose(): void;
}
