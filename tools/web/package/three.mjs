// Silhouettes in three.js: objects whose lines follow a camera by change sets.
//
// A silhouette does not change under an affine map of model and viewpoint together. So the camera is taken into the
// space of the object, and the object may be moved, scaled, sheared and mirrored without a new mesh.
//
// Lines have places: those of the borders first, then the slots of the tracker. All places up to `lineCount` are in
// use, so the draw range is the silhouette exactly.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineBasicMaterial, LineSegments, Matrix4, Object3D, Vector3 } from "three";

/** What clone() of objects that draw lines returns: other lines of the same geometry. */
export function clonedLines(lines, made, recursive) {
  return Object3D.prototype.copy.call(made, lines, recursive);
}

/** The lines of a mesh for the camera that they were updated for. Objects that draw lines own one. */
export class FollowedLines {
  #mesh;
  #ownsMesh;
  #edges;
  #borderCount;
  #tracker = null;

  constructor(rimline, geometry, { mesh, borders = false } = {}) {
    this.rimline = rimline;
    this.#ownsMesh = mesh === undefined;
    this.#mesh = mesh ?? meshOf(rimline, geometry);
    this.#edges = this.#mesh.edges;
    this.#borderCount = borders ? this.#mesh.borderCount : 0;
    this.capacity = this.#mesh.edgeCount - this.#mesh.borderCount + this.#borderCount;
    this.lineCount = 0;
    this.writtenCount = 0; // By the last call of follow().
    if (geometry.boundingBox === null) geometry.computeBoundingBox();
    if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
  }

  /**
   * Moves to a camera. Calls `write(place, from, to)` for each line that changed, with its two vertices, and marks their
   * range in `attribute`, which has `size` numbers for each line.
   */
  follow(camera, object, attribute, size, write) {
    const worldFromObject = worldMatrixOf(object);
    if (worldFromObject.determinant() === 0) return; // It has no volume, so nobody sees it.
    const point = pointOf(camera, worldFromObject.invert());
    let [first, end] = pendingRange(attribute, size);
    this.writtenCount = 0;
    const place = (line, edge) => {
      write(line, this.#edges[2 * edge], this.#edges[2 * edge + 1]);
      first = Math.min(first, line);
      end = Math.max(end, line + 1);
      ++this.writtenCount;
    };
    if (this.#tracker === null) {
      this.#tracker = new this.rimline.Tracker(this.#mesh, point);
      const firstBorder = this.#mesh.edgeCount - this.#mesh.borderCount;
      for (let i = 0; i < this.#borderCount; ++i) place(i, firstBorder + i);
      this.#tracker.silhouette.forEach((edge, slot) => place(this.#borderCount + slot, edge));
    } else {
      const { slots } = this.#tracker.moveTo(point);
      for (let i = 0; i < slots.length; i += 2) place(this.#borderCount + slots[i], slots[i + 1]);
    }
    this.lineCount = this.#borderCount + this.#tracker.silhouette.length;
    if (this.writtenCount === 0) return;
    // One range: slots that change lie anywhere, and calls for each of them take longer than the copy of those between.
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(size * first, size * (end - first));
    attribute.needsUpdate = true;
  }

  dispose() {
    this.#tracker?.dispose();
    if (this.#ownsMesh) this.#mesh.dispose();
  }
}

/** Lines one pixel wide, as WebGL has them, whose only numbers are pairs of vertices. */
export class SilhouetteLines extends LineSegments {
  #lines;
  #source;
  #ownMaterial = null;

  constructor(rimline, geometry, { material, ...options } = {}) {
    const lines = new FollowedLines(rimline, geometry, options);
    const index = new BufferAttribute(new Uint32Array(2 * lines.capacity), 1).setUsage(DynamicDrawUsage);
    const drawn = new BufferGeometry().setAttribute("position", geometry.getAttribute("position")).setIndex(index);
    drawn.boundingBox = geometry.boundingBox;
    drawn.boundingSphere = geometry.boundingSphere;
    drawn.setDrawRange(0, 0);
    super(drawn, material ?? new LineBasicMaterial({ color: 0x000000 }));
    if (material === undefined) this.#ownMaterial = this.material;
    this.#source = { rimline, geometry, options };
    this.#lines = lines;
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
    const { index } = this.geometry;
    this.#lines.follow(camera, this, index, 2, (line, from, to) => {
      index.array[2 * line] = from;
      index.array[2 * line + 1] = to;
    });
    this.geometry.setDrawRange(0, 2 * this.lineCount);
  }

  clone(recursive) {
    const { rimline, geometry, options } = this.#source;
    return clonedLines(this, new this.constructor(rimline, geometry, { ...options, material: this.material }), recursive);
  }

  dispose() {
    this.#lines.dispose();
    this.geometry.dispose();
    this.#ownMaterial?.dispose();
  }
}

/** The mesh of a geometry, with or without index, for several lines to share. */
export function meshOf(rimline, geometry) {
  const position = geometry.getAttribute("position");
  if (position === undefined || position.itemSize !== 3)
    throw new TypeError("geometry: expected the attribute position, with three numbers for each vertex");
  let positions = position.array;
  if (!(position.isBufferAttribute && positions instanceof Float32Array)) {
    positions = new Float32Array(3 * position.count);
    for (let i = 0; i < position.count; ++i)
      positions.set([position.getX(i), position.getY(i), position.getZ(i)], 3 * i);
  }
  return new rimline.Mesh(positions, geometry.index?.array);
}

// The lines that the last updates marked and the renderer has not written yet: first, and one past the last.
function pendingRange({ updateRanges }, size) {
  if (updateRanges.length === 0) return [Infinity, 0];
  const [{ start, count }] = updateRanges;
  return [start / size, (start + count) / size];
}

// The camera in the space of an object: its eye, or for an orthographic one the direction towards it.
function pointOf(camera, objectFromWorld) {
  const objectFromCamera = objectFromWorld.multiply(worldMatrixOf(camera));
  if (camera.isOrthographicCamera) return { direction: new Vector3().setFromMatrixColumn(objectFromCamera, 2) };
  return new Vector3().setFromMatrixPosition(objectFromCamera);
}

// What a renderer would use now. `matrixWorld` is older where something moved since the last frame.
function worldMatrixOf(object) {
  const matrix = new Matrix4();
  for (let part = object; part !== null; part = part.parent) {
    if (!part.matrixWorldAutoUpdate) return matrix.premultiply(part.matrixWorld);
    if (part.matrixAutoUpdate) part.updateMatrix();
    matrix.premultiply(part.matrix);
  }
  return matrix;
}
