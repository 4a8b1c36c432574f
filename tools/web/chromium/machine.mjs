// What tests look for on the machine that they run on.

import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";

/** Ends the test as skipped: status 77. */
export function skip(reason) {
  console.log(`SKIPPED: ${reason}`);
  process.exit(77);
}

export const chromium = process.env.RIMLINE_CHROMIUM ?? found("chromium") ?? found("google-chrome");

/** Files of the folders of RIMLINE_MODELS that hold meshes. */
export function models() {
  const folders = (process.env.RIMLINE_MODELS ?? "").split(":").filter((folder) => existsSync(folder));
  return folders.flatMap((folder) =>
    readdirSync(folder).filter((file) => /\.(obj|ply|stl|off|glb|gltf)$/.test(file)).sort().map((file) => join(folder, file)));
}

function found(program) {
  return process.env.PATH.split(":").map((folder) => join(folder, program)).find(existsSync);
}
