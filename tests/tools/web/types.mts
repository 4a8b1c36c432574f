// Compiled only: what rimline.d.ts and three.d.ts promise, and what they refuse.

import { createRimline, type Change, type Mesh, type Rimline } from "rimline";
import { SilhouetteLines, meshOf } from "rimline/three";
import { WideSilhouetteLines } from "rimline/three_wide";
import * as THREE from "three";

const rimline: Rimline = await createRimline({ wasm: new Uint8Array(8) });
const mesh: Mesh = new rimline.Mesh(new Float32Array(9), [0, 1, 2], { weld: false });
const tracker = new rimline.Tracker(mesh, { direction: new THREE.Vector3(1, 2, 3) });
const change: Change = tracker.moveTo([1, 2, 3]);
export const added: Uint32Array = change.added;

const geometry = new THREE.BoxGeometry();
const lines = new SilhouetteLines(rimline, geometry, { borders: true, mesh: meshOf(rimline, geometry) });
const wide = new WideSilhouetteLines(rimline, geometry);
new THREE.Scene().add(lines, wide);
lines.update(new THREE.PerspectiveCamera());
lines.material.color.set(0xff0000); // A LineBasicMaterial.
new rimline.Mesh([0, 0, 0] as const, [0, 0, 0] as const);
wide.material.linewidth = lines.lineCount + wide.writtenCount;
wide.dispose();

// @ts-expect-error: text is no point.
tracker.moveTo("1,2,3");
// @ts-expect-error: text is no array of numbers.
new rimline.Mesh("1,2,3");
// @ts-expect-error: the instance comes first.
new SilhouetteLines(geometry);
// @ts-expect-error: as above.
new WideSilhouetteLines(5, geometry);
