import type { BufferGeometry, Camera, LineSegments, Material } from "three";
import type { Mesh, Rimline } from "rimline";

export interface LineOptions {
  /** A mesh that `meshOf()` made of the same geometry, for several lines to share. By default each makes its own. */
  mesh?: Mesh;
  /** Draws the borders of open meshes too. False by default. */
  borders?: boolean;
}

/**
 * The silhouette of a geometry from a camera, in lines one pixel wide. Add it where the mesh is drawn, with the same
 * transformation, for example as its child. Give the mesh's material `polygonOffset: true, polygonOffsetFactor: 1,
 * polygonOffsetUnits: 1`, so that its surface does not cover the lines.
 *
 * The geometry must not change. Skins and morph targets are not followed.
 */
export class SilhouetteLines extends LineSegments<BufferGeometry> {
  /**
   * @param rimline what `createRimline()` resolved to
   * @param geometry triangles, with an index or without; split vertices at equal positions are one
   * @param options `material`: a black LineBasicMaterial by default
   */
  constructor(rimline: Rimline, geometry: BufferGeometry, options?: LineOptions & { material?: Material });

  /** The number of lines that are drawn: borders, if they are asked for, and the silhouette. */
  readonly lineCount: number;

  /** The number of lines that the last update wrote. */
  readonly writtenCount: number;

  /**
   * Moves the lines to the camera, perspective or orthographic. To be called before each frame. Writes only the lines
   * that changed. The object may be moved, scaled, sheared or mirrored between calls.
   */
  update(camera: Camera): void;

  /** Other lines of the same geometry, without an update yet. They share the material, and the mesh if it was given. */
  clone(recursive?: boolean): this;

  /** Frees the geometry and what Rimline holds for it. A material and a mesh that were given are the caller's. */
  dispose(): void;
}

/** The mesh of a geometry, for `LineOptions.mesh`. The caller disposes of it. */
export function meshOf(rimline: Rimline, geometry: BufferGeometry): Mesh;
