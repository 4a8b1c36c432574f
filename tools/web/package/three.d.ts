import type { BufferGeometry, Camera, LineBasicMaterial, LineSegments, Material } from "three";
import type { Mesh, Rimline } from "rimline";

export interface LineOptions {
  /** A mesh that `meshOf()` made of the same geometry, for several lines to share. By default each makes its own. */
  mesh?: Mesh | null;
  /** Draws the borders of open meshes too. False by default. */
  borders?: boolean;
}

/**
 * The silhouette of a geometry from a camera, in lines one pixel wide. Add it where the mesh is drawn, with the same
 * transformation, for example as its child. Give the mesh's material `polygonOffset: true, polygonOffsetFactor: 1,
 * polygonOffsetUnits: 1`, so that its surface does not cover the lines.
 *
 * The geometry must not change. Its draw range counts, as it is when the lines are made. Skins, morph targets and
 * instances (InstancedMesh, BatchedMesh) are not followed.
 */
export class SilhouetteLines<M extends Material = LineBasicMaterial> extends LineSegments<BufferGeometry, M> {
  /**
   * @param rimline what `createRimline()` resolved to
   * @param geometry triangles, with an index or without; split vertices at equal positions are one
   * @param options `material`: a black LineBasicMaterial by default
   */
  constructor(rimline: Rimline, geometry: BufferGeometry, options?: LineOptions & { material?: M | null });

  /** The number of lines that are drawn: borders, if they are asked for, and the silhouette. */
  readonly lineCount: number;

  /** The number of lines that the last update wrote. */
  readonly writtenCount: number;

  /**
   * Moves the lines to the camera, by any projection: perspective, orthographic, off-axis, oblique. To be called before
   * each frame. Writes only the lines that changed. The object may be moved, scaled, sheared or mirrored between calls;
   * while it is flat, the lines stay as they are. Lines of one object are of one eye: stereo needs two of them.
   */
  update(camera: Camera): void;

  /**
   * Other lines of the same geometry, without an update yet. They share the material, and the mesh if it was given.
   * copy() throws: it would share their buffers.
   */
  clone(recursive?: boolean): this;

  /** Frees the geometry and what Rimline holds for it. A material and a mesh that were given are the caller's. */
  dispose(): void;
}

/** The mesh of what a geometry draws, for `LineOptions.mesh`. The caller disposes of it. */
export function meshOf(rimline: Rimline, geometry: BufferGeometry): Mesh;
