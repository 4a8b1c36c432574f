// Silhouettes of any width in three.js, by its own wide lines.

import { DynamicDrawUsage, InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { FollowedLines, clonedLines, lineOptions } from "./three.mjs";

/** Lines as wide as their material says. They take three times the memory of SilhouetteLines. */
export class WideSilhouetteLines extends LineSegments2 {
  #lines;
  #position;
  #ends;
  #source;
  #ownMaterial = null;

  constructor(rimline, geometry, allOptions) {
    const { material = null, ...options } = lineOptions(allOptions);
    const lines = new FollowedLines(rimline, geometry, options);
    const ends = new InstancedInterleavedBuffer(new Float32Array(6 * lines.capacity), 6).setUsage(DynamicDrawUsage);
    const drawn = new LineSegmentsGeometry();
    drawn.setAttribute("instanceStart", new InterleavedBufferAttribute(ends, 3, 0));
    drawn.setAttribute("instanceEnd", new InterleavedBufferAttribute(ends, 3, 3));
    drawn.boundingBox = geometry.boundingBox;
    drawn.boundingSphere = geometry.boundingSphere;
    drawn.instanceCount = 0;
    super(drawn, material ?? new LineMaterial({ color: 0x000000, linewidth: 2 }));
    if (material === null) this.#ownMaterial = this.material;
    this.#source = { rimline, geometry, options };
    this.#lines = lines;
    this.#position = geometry.getAttribute("position");
    this.#ends = ends;
  }

  /** The number of lines that are drawn: borders, if there are any, and the silhouette. */
  get lineCount() {
    return this.#lines.lineCount;
  }

  /** The number of lines that the last update wrote. */
  get writtenCount() {
    return this.#lines.writtenCount;
  }

  update(camera) {
    const { array } = this.#ends;
    const position = this.#position;
    this.#lines.follow(camera, this, this.#ends, 6, (line, from, to) => {
      array[6 * line] = position.getX(from);
      array[6 * line + 1] = position.getY(from);
      array[6 * line + 2] = position.getZ(from);
      array[6 * line + 3] = position.getX(to);
      array[6 * line + 4] = position.getY(to);
      array[6 * line + 5] = position.getZ(to);
    });
    this.geometry.instanceCount = this.lineCount;
  }

  clone(recursive) {
    const { rimline, geometry, options } = this.#source;
    return clonedLines(this, new this.constructor(rimline, geometry, { ...options, material: this.material }), recursive);
  }

  copy() {
    throw new Error("copy() of silhouette lines would share their buffers: use clone()");
  }

  dispose() {
    this.#lines.dispose();
    this.geometry.dispose();
    this.#ownMaterial?.dispose();
  }
}
