// The whole history of a run for pages that come late, again, or draw slowly.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { awakeBySteps, endless, openPage, pause, runScene, sceneText, serve, shown, talus, temporaryFolder, until } from "./browser.mjs";

const bus = "udpm://239.255.76.67:7673?ttl=0";
const finished = (page) => page.waitForFunction(() => document.getElementById("speed").textContent.startsWith("finished"), null, { timeout: 60_000 });

/// Of each frame step and awake bodies, and all events and piles that the page has.
const history = (page) =>
  page.evaluate(() => {
    const { timeline } = window.talus;
    return { step: timeline.step, awake: timeline.awake, asleep: timeline.asleep, woken: timeline.woken, ms: timeline.msPerStep, slept: timeline.events.flat().length, piles: timeline.piles.map((piles) => piles.length), happened: timeline.happened.map(({ number, time }) => [number, time]) };
  });

/// Poses [m] of a page at a frame.
const poses = (page, frame) => page.evaluate((number) => (window.talus.seek(number), Array.from(window.talus.timeline.state.pose.slice(0, 300))), frame);

test("a page of a scene that is loaded again, or comes late, has the run from its first frame, as the one that was there", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "0", "--set", "run.frames=300");
  const first = await openPage(url);
  await finished(first);
  await until(first, ({ step }) => step === 600);
  const before = await history(first);
  assert.equal(before.step[0], 0);
  for (let step = 0; step <= 600; step += 2) assert.ok(before.step.includes(step), `frame of output after step ${step}`);
  const late = await openPage(url);
  await until(late, ({ frames }) => frames === before.step.length);
  assert.deepEqual(await history(late), before);
  const middle = Math.floor(before.step.length / 2);
  assert.deepEqual(await poses(late, middle), await poses(first, middle));
  assert.ok(before.slept > 10 && before.piles.at(-1) === 1 && before.ms.filter((ms) => ms > 0).length > 100);
  await first.reload();
  await first.waitForFunction(() => window.talus !== undefined);
  await until(first, ({ frames }) => frames === before.step.length);
  assert.deepEqual(await history(first), before);
  await until(first, ({ step }) => step === 600);
  assert.ok(await late.isHidden("#history"), "no frame is left out");
  assert.deepEqual([...first.faults, ...late.faults], []);
  child.kill();
  for (const page of [first, late]) await page.close();
});

/// Three pages draw in software here: with small stages.
const small = { viewport: { width: 800, height: 420 } };

test("after a restart and after another scene a page has the frames of the new run only", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "16", ...endless);
  const page = await openPage(url, small);
  await until(page, ({ bodies }) => bodies > 30);
  await pause(page);
  await page.click("#restart");
  await until(page, ({ step }) => step === 0);
  await page.click("#play");
  await until(page, ({ step }) => step > 120);
  const late = await openPage(url, small);
  const { step } = await history(late);
  assert.equal(step[0], 0);
  assert.ok(step.every((each, i) => i === 0 || each >= step[i - 1]), "steps grow");
  await runScene(page, (await sceneText(page)).replace(/^title = .*/m, 'title = "Another"'));
  for (const each of [page, late]) await each.waitForFunction(() => document.getElementById("title").textContent === "Another");
  const later = await openPage(url, small);
  await until(later, ({ bodies }) => bodies > 3);
  const again = await history(later);
  assert.equal(again.step[0], 0);
  assert.equal(await later.textContent("#title"), "Another");
  child.kill();
  for (const each of [page, late, later]) await each.close();
});

test("a page that draws slowly and one that sleeps have every frame in the end", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8", "--set", "run.frames=300");
  const fast = await openPage(url);
  const slow = await openPage(url);
  const asleep = await openPage(url);
  // A page that takes half a second for each picture, and one that the browser lets draw none.
  await slow.evaluate(() => {
    const draw = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (action) => setTimeout(() => draw(action), 500);
  });
  await asleep.evaluate(() => {
    Object.defineProperty(document, "hidden", { get: () => true });
    window.requestAnimationFrame = () => 0;
  });
  for (const page of [fast, slow, asleep]) await finished(page);
  const all = await history(fast);
  assert.equal(all.step.at(-1), 600);
  for (const page of [slow, asleep]) {
    await page.waitForFunction((frames) => window.talus.timeline.frames === frames, all.step.length, { polling: 100, timeout: 60_000 });
    assert.deepEqual(await history(page), all);
  }
  child.kill();
  for (const page of [fast, slow, asleep]) await page.close();
});

test("a page of a live run that is loaded again has all that the first page has", async () => {
  const folder = join(temporaryFolder(), "run");
  const { url, child } = await serve("--live", "--lcm-url", bus);
  const page = await openPage(url, { talus: false });
  await page.waitForFunction(() => document.getElementById("speed").textContent.startsWith("waiting"));
  const run = spawn(process.env.TALUS, ["run", "drop_in_a_pile_2d", "--pace", "4", "--set", "run.frames=240", "--lcm-url", bus, "--out", folder]);
  await page.waitForFunction(() => window.talus !== undefined);
  await once(run, "exit");
  await finished(page);
  await until(page, ({ step }) => step === 480);
  const before = await history(page);
  const late = await openPage(url);
  await until(late, ({ frames }) => frames === before.step.length);
  assert.deepEqual(await history(late), before);
  const counts = awakeBySteps(folder);
  before.step.forEach((step, frame) => assert.equal(before.awake[frame], counts.get(step)?.awake ?? before.awake[frame]));
  assert.ok(before.step.length > 30 && before.slept > 0);
  await late.reload();
  await late.waitForFunction(() => window.talus !== undefined);
  await until(late, ({ frames }) => frames === before.step.length);
  assert.deepEqual(await history(late), before);
  child.kill();
  for (const each of [page, late]) await each.close();
});

test("beyond its memory the history has fewer frames of the whole run, and the page says so", async () => {
  // Bodies that fall for ever: some 14 MB of frames.
  const scene = join(temporaryFolder(), "fall.toml");
  const bodies = Array.from({ length: 800 }, (_, i) => `[[body]]\nposition = [${2 * (i % 40)}, ${2 * Math.floor(i / 40)}]\nvelocity = [${0.01 * (i % 7)}, 0]`);
  writeFileSync(scene, `title = "fall"\ndimension = 2\nground = {present = false}\npolicy = {kind = "full"}\nrun = {frames = 900, frame_rate = 60}\nshape.disc = {kind = "ball", radius = 0.5}\n${bodies.join("\n")}\n`);
  const { url, child } = await serve(scene, "--pace", "0", "--history", "5");
  const page = await openPage(url);
  await finished(page);
  await until(page, ({ step }) => step === 900, 60);
  const late = await openPage(url);
  await until(late, ({ step }) => step === 900, 60);
  const { step } = await history(late);
  assert.ok(step.length < 500 && step.length > 50, `${step.length} frames`);
  assert.equal(step[0], 0);
  const apart = step.slice(1).map((each, i) => each - step[i]);
  const text = await late.textContent("#history");
  const told = Number(/up to ([\d.]+) s apart/.exec(text)[1]);
  assert.ok(Math.max(...apart) <= Math.round(60 * told), `${Math.max(...apart)} steps apart; ${text}`);
  assert.match(text, /5 MiB/);
  await until(page, () => true);
  assert.match(await page.textContent("#history"), /5 MiB/);
  assert.deepEqual(await poses(late, step.length - 1), await page.evaluate(() => Array.from(window.talus.timeline.state.pose.slice(0, 300))));
  assert.deepEqual(late.faults, []);
  child.kill();
  for (const each of [page, late]) await each.close();
});

test("no line of a plot crosses frames that are missing", async () => {
  const folder = join(temporaryFolder(), "run");
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "run.frames=60", "--out", folder);
  const { url, child } = await serve(folder);
  const page = await openPage(url);
  const gaps = () => page.evaluate(() => window.talus.plots.drawn[0].plot.data.map((column) => column.filter((value) => value === null).length));
  assert.deepEqual(await gaps(), [0, 0, 0, 0]);
  // As where messages of a live run are lost: the steps of later frames lie further on.
  await page.evaluate(() => {
    const { timeline, plots } = window.talus;
    for (let frame = 30; frame < timeline.frames; ++frame) timeline.step[frame] += 60;
    plots.draw();
  });
  assert.deepEqual(await gaps(), [0, 1, 1, 1]);
  child.kill();
  await page.close();
});
