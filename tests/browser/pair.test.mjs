// Two runs side by side in the browser.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { awakeBySteps, openPage, serve, talus, temporaryFolder } from "./browser.mjs";

async function openPair(url) {
  const page = await openPage(url, { talus: false });
  await page.waitForFunction(() => window.pair !== undefined, null, { timeout: 60_000 });
  return page;
}

test("two records are shown at the same time of both, with their counts and the distance of their bodies", async () => {
  const folder = temporaryFolder();
  const runs = ["adaptive", "full"].map((policy) => join(folder, policy));
  for (const run of runs) talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "run.frames=300", "--policy", run.endsWith("full") ? "full" : "adaptive", "--out", run);
  const { url, child } = await serve(...runs);
  const page = await openPair(url);
  await page.evaluate(() => window.pair.pause());
  for (const time of [8, 2, 9.5]) {
    await page.evaluate((at) => window.pair.seek(at), time);
    const difference = await page.evaluate(() => window.pair.difference());
    assert.deepEqual(difference.awake, runs.map((run) => awakeBySteps(run).get(60 * time).awake));
    assert.ok(difference.mean <= difference.largest && difference.speedUp > 0);
  }
  const { largest } = await page.evaluate(() => window.pair.difference());
  assert.ok(largest > 0.1, "the runs differ");
  const text = await page.textContent("#difference");
  assert.match(text, /largest/);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("a run differs from itself by nothing", async () => {
  const run = join(temporaryFolder(), "run");
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "run.frames=60", "--out", run);
  const { url, child } = await serve(run, run);
  const page = await openPair(url);
  await page.evaluate(() => (window.pair.pause(), window.pair.seek(1.5)));
  const { largest, awake } = await page.evaluate(() => window.pair.difference());
  assert.equal(largest, 0);
  assert.equal(awake[0], awake[1]);
  await page.close();
  child.kill();
});

test("a scene runs under two policies, and one button pauses both", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--against", "full", "--pace", "4");
  const page = await openPair(url);
  await page.waitForFunction(() => window.pair.difference().step > 60, null, { timeout: 60_000 });
  await page.click("#play");
  const sides = page.frames().slice(1);
  for (const side of sides) await side.waitForFunction(() => document.getElementById("run").textContent === "Run", null, { polling: 100, timeout: 60_000 });
  const policies = await Promise.all(sides.map((side) => side.inputValue("#policy")));
  assert.deepEqual(policies, ["adaptive", "full"]);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});
