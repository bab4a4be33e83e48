// Makes replay.js of src/ and three.js: npm ci && npm run build
//
// The first line of replay.js names the sources by their hash, so that a test sees a bundle that is not theirs.

import { createHash } from "node:crypto";
import { copyFileSync, readFileSync, readdirSync } from "node:fs";
import { build } from "esbuild";

const hash = createHash("sha256");
for (const name of readdirSync("src").sort()) hash.update(`${name}\n`).update(readFileSync(`src/${name}`));

await build({
  entryPoints: ["src/index.js"],
  bundle: true,
  minify: true,
  format: "iife",
  globalName: "exoReplay",
  target: "es2022",
  charset: "ascii",
  loader: { ".css": "text" },
  legalComments: "none",
  banner: { js: `/* exo replay; sources ${hash.digest("hex")}; contains three.js 0.187.0, Copyright 2010-2026 three.js authors, MIT */` },
  outfile: "replay.js",
});
copyFileSync("node_modules/three/LICENSE", "three.LICENSE.txt");
