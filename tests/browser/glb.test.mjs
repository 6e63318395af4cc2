// `talus export --glb` checked against the specification of glTF 2.0 by Khronos' validator.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { test } from "node:test";
import { talus, temporaryFolder } from "./browser.mjs";

const require = createRequire(new URL("../../tools/view/page/package.json", import.meta.url));
const { validateBytes } = require("gltf-validator");

const folder = temporaryFolder();

/// The scene of a GLB file, which is its first chunk.
const sceneOf = (bytes) => JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());

for (const scene of ["drop_in_a_pile_2d", "drop_in_a_pile_3d", "bunny_matrices_35_3d"])
  test(`${scene}: the validator finds nothing wrong, and a node for each body`, async () => {
    const run = join(folder, scene);
    const file = `${run}.glb`;
    talus("run", scene, "--no-telemetry", "--out", run, "--set", "run.frames=200");
    talus("export", run, "--glb", file);
    const bytes = readFileSync(file);
    const report = await validateBytes(new Uint8Array(bytes));
    const { numErrors, numWarnings, messages } = report.issues;
    assert.deepEqual([numErrors, numWarnings], [0, 0], JSON.stringify(messages.slice(0, 3)));
    assert.equal(report.info.animationCount, 1);
    const bodies = JSON.parse(readFileSync(join(run, "summary.json"))).bodies_appeared;
    const drawn = sceneOf(bytes).nodes.filter((node) => node.mesh !== undefined).length;
    assert.ok(bodies > 10 && drawn >= bodies && drawn <= bodies + 10, `${drawn} nodes with a mesh, ${bodies} bodies`);
  });
