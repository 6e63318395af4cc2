// A run of another process that `talus view --live` shows, over real multicast on this machine.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { awakeBySteps, colours, openPage, serve, temporaryFolder, until } from "./browser.mjs";

const bus = "udpm://239.255.76.67:7669?ttl=0";

test("a run that begins later is shown as it goes on, with the counts of its record at the end", async () => {
  const folder = join(temporaryFolder(), "run");
  const { url, child } = await serve("--live", "--lcm-url", bus);
  await (await openPage(url, { talus: false })).waitForFunction(() => document.getElementById("speed").textContent.startsWith("waiting for a run on"));
  const run = spawn(process.env.TALUS, ["run", "drop_in_a_pile_2d", "--pace", "4", "--set", "run.frames=600", "--lcm-url", bus, "--out", folder]);
  const ended = new Promise((done) => run.on("exit", done));
  const page = await openPage(url);
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
