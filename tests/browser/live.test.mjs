// A run of another process that `talus view --live` shows, over real multicast on this machine.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { awakeBySteps, colours, openPage, serve, talus, temporaryFolder, until } from "./browser.mjs";

const bus = "udpm://239.255.76.67:7669?ttl=0";

test("a run that begins later is shown as it goes on, with the counts of its record at the end", async () => {
  const folder = join(temporaryFolder(), "run");
  const { url, child } = await serve("--live", "--lcm-url", bus);
  const page = await openPage(url, { talus: false }); // before the run: on a busy machine it takes as long as that
  await page.waitForFunction(() => document.getElementById("speed").textContent.startsWith("waiting for a run on"));
  const run = spawn(process.env.TALUS, ["run", "drop_in_a_pile_2d", "--pace", "2", "--set", "run.frames=600", "--lcm-url", bus, "--out", folder]);
  const ended = new Promise((done) => run.on("exit", done));
  await page.waitForFunction(() => window.talus !== undefined);
  const early = await until(page, ({ bodies }) => bodies > 5);
  await until(page, ({ bodies }) => bodies > early.bodies);
  assert.ok(await page.isHidden("#restart"), "a page cannot steer it");
  assert.equal(await ended, 0);
  await page.waitForFunction(() => document.getElementById("speed").textContent === "finished");
  const counts = awakeBySteps(folder);
  const last = await until(page, ({ step }) => step === 1200);
  assert.equal(last.bodies, counts.get(1200).bodies);
  assert.equal(last.awake, counts.get(1200).awake);
  const share = await colours(page);
  assert.ok(share.orange + share.dark > 0.01, JSON.stringify(share));
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

/// Places of the obstacles as drawn [m].
const obstacles = (page) =>
  page.evaluate(() => window.talus.stage.surroundings.obstacles.map(({ mesh }) => [...mesh.instanceMatrix.array.slice(12, 14)]));

test("obstacles that move are shown where they are, on the page of a live run, of a scene and of a record", async () => {
  const folder = temporaryFolder();
  const scene = join(folder, "moving.toml");
  writeFileSync(
    scene,
    `title = "moving"\ndimension = 2\nrun = {frames = 600}\nshape.disc = {kind = "ball", radius = 0.5}\n[[source]]\ncount = 20\n[[pile]]\n` +
      `[[obstacle]]\nkind = "box"\nsize = [1, 4]\nposition = [-20, 2]\n` +
      `[[obstacle]]\nkind = "box"\nsize = [1, 4]\nposition = [6, 2]\nmotion = {kind = "path", times = [1, 3], shifts = [[0, 0], [4, 1]]}\n`,
  );
  const { url, child } = await serve("--live", "--lcm-url", bus);
  const run = spawn(process.env.TALUS, ["run", scene, "--pace", "2", "--lcm-url", bus, "--out", join(folder, "run")]);
  const ended = once(run, "exit");
  const live = await openPage(url);
  await until(live, ({ time }) => time > 3.2);
  assert.deepEqual((await obstacles(live))[0], [-20, 2]);
  const moved = async (page) => {
    const [x, z] = (await obstacles(page))[1];
    assert.ok(Math.abs(x - 10) < 0.002 && Math.abs(z - 3) < 0.002, `${x}, ${z}`);
  };
  await moved(live);
  await live.click("#first"); // what came can be scrubbed
  const { time } = await until(live, ({ frame }) => frame === 0);
  const [x] = (await obstacles(live))[1];
  const expected = 6 + Math.min(4, Math.max(0, 2 * (time - 1)));
  assert.ok(Math.abs(x - expected) < 0.05, `${x} at ${time} s, not ${expected}`);
  await live.close();
  child.kill();
  run.kill();
  await ended;

  const simulated = await serve(scene, "--pace", "8");
  const page = await openPage(simulated.url);
  await until(page, ({ time }) => time > 3.2);
  await moved(page);
  await page.close();
  simulated.child.kill();

  talus("run", scene, "--no-telemetry", "--out", join(folder, "record"));
  const recorded = await serve(join(folder, "record"));
  const record = await openPage(recorded.url);
  await record.evaluate(() => (window.talus.pause(), window.talus.seek(0)));
  assert.deepEqual((await obstacles(record)).map((place) => place.map((part) => Math.round(100 * part) / 100)), [[-20, 2], [6, 2]]);
  await record.click("#last");
  await moved(record);
  assert.deepEqual(record.faults, []);
  await record.close();
  recorded.child.kill();
});

test("events of the scene are shown on a page that comes after them", async () => {
  const folder = temporaryFolder();
  const scene = join(folder, "gate.toml");
  writeFileSync(
    scene,
    `title = "gate"\ndimension = 2\nrun = {frames = 900}\nshape.disc = {kind = "ball", radius = 0.5}\n[[source]]\ncount = 20\n[[pile]]\n` +
      `[[obstacle]]\nname = "gate"\nkind = "box"\nsize = [1, 4]\nposition = [6, 2]\n[[event]]\ntime = 1.0\ndo = "remove"\nobstacle = "gate"\n`,
  );
  const { url, child } = await serve("--live", "--lcm-url", bus);
  const run = spawn(process.env.TALUS, ["run", scene, "--pace", "2", "--lcm-url", bus, "--out", join(folder, "run")]);
  await new Promise((done) => setTimeout(done, 2500));
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 0);
  await page.waitForFunction(() => window.talus.timeline.happened.length === 1);
  assert.equal(await page.evaluate(() => window.talus.timeline.textOf(window.talus.timeline.happened[0])), "remove obstacle gate");
  await page.waitForFunction(() => !window.talus.stage.surroundings.obstacles[0].mesh.visible);
  run.kill();
  await once(run, "exit"); // it still writes into the folder
  await page.close();
  child.kill();
});
