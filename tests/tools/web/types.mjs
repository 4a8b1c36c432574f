// types.mjs BUILD: compiles types.mts against the types of the package.

import { execFileSync } from "node:child_process";
import { copyFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const [build] = process.argv.slice(2);
// In the folder of the package, where the compiler finds all by its name.
const source = join(build, "package", "types.mts");
copyFileSync(fileURLToPath(new URL("types.mts", import.meta.url)), source);
try {
  const compiler = join(build, "package", "node_modules", "typescript", "bin", "tsc");
  const options = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--skipLibCheck"];
  execFileSync(process.execPath, [compiler, ...options, source], { stdio: "inherit" });
} finally {
  rmSync(source);
}
