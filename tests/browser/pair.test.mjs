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

/// What the two sides show: the time of what is drawn [s], metres of a pixel with the camera, and the size of the canvas.
/// Read at once: the runs may go on.
async function sidesOf(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.evaluate(() =>
    ["a", "b"].map((side) => {
      const { talus, document } = window.document.getElementById(side).contentWindow;
      const { time, timeline, stage } = talus;
      const canvas = document.getElementById("bodies");
      return { time, shown: timeline.time(timeline.shown), view: stage.view(), size: [canvas.clientWidth, canvas.clientHeight], grid: stage.surroundings.gridLength };
    }),
  );
}

/// One moment at one scale on both sides.
async function assertTogether(page, time) {
  const [a, b] = await sidesOf(page);
  assert.equal(a.time, b.time);
  if (time !== undefined) assert.ok(Math.abs(a.time - time) < 1e-9, `${a.time}, not ${time}`);
  assert.deepEqual([a.size, a.grid], [b.size, b.grid]);
  assert.ok(Math.abs(a.view.metresPerPixel / b.view.metresPerPixel - 1) < 1e-6, JSON.stringify([a.view, b.view]));
  for (const part of ["eye", "target"]) a.view[part].forEach((value, i) => assert.ok(Math.abs(value - b.view[part][i]) < 1e-6, JSON.stringify([a.view, b.view])));
  return [a, b];
}

for (const dimension of ["2d", "3d"]) {
  test(`${dimension}: records of other step, rate, length and scale are shown at one moment and one scale, with what differs in words`, async () => {
    const folder = temporaryFolder();
    const common = ["run", `drop_in_a_pile_${dimension}`, "--no-telemetry"];
    const [a, b] = ["short", "long"].map((name) => join(folder, name));
    talus(...common, "--set", "run.frames=90", "--out", a);
    talus(...common, "--policy", "full", "--seed", "7", "--set", "world.steps_per_second=100", "--set", "run.frame_rate=10", "--set", "run.frames=50", "--set", "source[0].position=" + (dimension === "2d" ? "[12, 30]" : "[12, 0, 30]"), "--out", b);
    const { url, child } = await serve(a, b);
    const page = await openPair(url);
    await page.evaluate(() => window.pair.pause());
    for (const time of [1.234, 0.3, 2.5]) {
      await page.evaluate((at) => window.pair.seek(at), time);
      await assertTogether(page, time);
    }
    await page.waitForFunction(() => document.getElementById("time").textContent.includes("the first run ends at 3.00 s"));
    await page.evaluate(() => window.pair.seek(99));
    const [first, second] = await assertTogether(page, 3);
    assert.ok(Math.abs(second.shown - 3) < 0.15 && Math.abs(first.shown - 3) < 1e-6);
    const axis = await page.evaluate(() => window.pair.plots.drawn.map(({ plot, runs }) => [plot.scales.x.min, plot.scales.x.max, runs.length]));
    assert.deepEqual(axis[0], [0, 5, 2], "both runs are in one plot, from the start to the end of the longer one");
    assert.ok(axis.every(([from, to]) => from === 0 && to === 5), "all plots have one time axis");
    // A body of the right run between two of its frames is drawn between their places.
    await page.evaluate(() => window.pair.seek(1.47));
    const steps = await page.frames()[2].evaluate(() => {
      const { timeline } = window.talus;
      return [timeline.state.step, timeline.drawn !== timeline.state, timeline.step[timeline.shown + 1]];
    });
    assert.ok(steps[0] < 147 && steps[1] && steps[2] > 147, JSON.stringify(steps));
    // The camera of one side is that of the other.
    const canvas = await page.frames()[1].locator("#bodies").boundingBox();
    await page.mouse.move(canvas.x + 100, canvas.y + 100);
    await page.mouse.wheel(0, -300);
    await page.mouse.down();
    await page.mouse.move(canvas.x + 160, canvas.y + 130, { steps: 3 });
    await page.mouse.up();
    await page.waitForTimeout(300);
    const [moved] = await assertTogether(page);
    assert.notDeepEqual(moved.view, first.view);
    const labels = await page.locator(".label").allInnerTexts();
    assert.match(labels[0], /policy adaptive.*seed \d+/s);
    assert.match(labels[1], /policy full.*seed 7/s);
    assert.match(labels[1], /world\.steps_per_second 100/);
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForTimeout(300);
      const cut = await page.evaluate(() => [...document.querySelectorAll(".label, .label b, #difference td, #time, #transport button")].filter((each) => each.scrollWidth > each.clientWidth + 1 && getComputedStyle(each).display !== "inline").map((each) => each.textContent));
      assert.deepEqual(cut, [], `nothing is cut off at ${width} pixels`);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
      await assertTogether(page);
    }
    assert.deepEqual(page.faults, []);
    await page.close();
    child.kill();
  });
}

test("a click into the plot and keys pressed on one side go to both runs", async () => {
  const run = join(temporaryFolder(), "run");
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "run.frames=90", "--out", run);
  const { url, child } = await serve(run, run);
  const page = await openPair(url);
  await page.evaluate(() => (window.pair.pause(), window.pair.seek(1)));
  const over = await page.locator(".u-over").first().boundingBox();
  await page.mouse.click(over.x + 0.5 * over.width, over.y + 20);
  const [{ time }] = await assertTogether(page);
  assert.ok(Math.abs(time - 1.5) < 0.1, `${time}`);
  await page.frames()[2].locator("#bodies").click({ position: { x: 5, y: 5 } });
  await page.keyboard.press(".");
  const [after] = await assertTogether(page);
  assert.ok(after.time > time && after.time < time + 0.05, `${after.time}`);
  await page.close();
  child.kill();
});

test("two simulations are shown at one moment while they run, paused and after a restart", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--against", "full", "--pace", "8", "--set", "run.frames=150");
  const page = await openPair(url);
  await page.waitForFunction(() => document.getElementById("rate").value === "8");
  for (let i = 0; i < 5; ++i) {
    await page.waitForTimeout(200);
    await assertTogether(page);
  }
  await page.waitForFunction(() => window.pair.ended() && window.pair.difference().step === 300, null, { timeout: 60_000 });
  await assertTogether(page, 5);
  assert.equal(await page.getAttribute("#play", "aria-label"), "Play", "a run that has ended offers to play it");
  await page.selectOption("#rate", "1"); // so that what follows lasts long enough to be seen before its end
  await page.click("#play");
  await page.waitForFunction(() => window.pair.difference().step > 5 && window.pair.difference().step < 300);
  await page.evaluate(() => (window.pair.pause(), window.pair.seek(2.01)));
  await assertTogether(page, 2.01);
  await page.click("#restart");
  await page.waitForFunction(() => window.pair.difference().step > 5 && !window.pair.ended());
  await assertTogether(page);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("a scene runs under two policies, and one button pauses both", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--against", "full", "--pace", "4");
  const page = await openPair(url);
  await page.waitForFunction(() => window.pair.difference().step > 60, null, { timeout: 60_000 });
  await page.click("#play");
  const sides = page.frames().slice(1);
  for (const side of sides) await side.waitForFunction(() => !window.talus.simulates(), null, { polling: 100, timeout: 60_000 });
  const policies = await Promise.all(sides.map((side) => side.inputValue("#policy")));
  assert.deepEqual(policies, ["adaptive", "full"]);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});
