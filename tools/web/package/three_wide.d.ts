import type { BufferGeometry, Camera } from "three";
import type { LineMaterial } from "three/addons/lines/LineMaterial.js";
import type { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import type { Rimline } from "rimline";
import type { LineOptions } from "rimline/three";

/** As SilhouetteLines, with lines of any width: `material.linewidth` pixels, two by default. */
export class WideSilhouetteLines extends LineSegments2 {
  constructor(rimline: Rimline, geometry: BufferGeometry, options?: LineOptions & { material?: LineMaterial });
  readonly lineCount: number;
  readonly writtenCount: number;
  update(camera: Camera): void;
  clone(recursive?: boolean): this;
  dispose(): void;
}
