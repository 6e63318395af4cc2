// A recorded run in the browser: the file that `talus replay` makes, and the same page from `talus view RUN`.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { awakeBySteps, colours, openPage, serve, shown, talus, temporaryFolder } from "./browser.mjs";

const folder = temporaryFolder();

function record(scene, ...options) {
  const run = join(folder, scene);
  talus("run", scene, "--no-telemetry", "--out", run, ...options);
  const html = join(folder, `${scene}.html`);
  talus("replay", run, "--out", html);
  return { run, url: pathToFileURL(html) };
}

const flat = record("drop_in_a_pile_2d", "--set", "run.frames=450");
const solid = record("drop_in_a_pile_3d", "--set", "run.frames=450");

/// At a frame with sleeping and awake bodies.
async function openAt(url, frame, options) {
  const page = await openPage(url, options);
  await page.evaluate((number) => {
    window.talus.pause();
    window.talus.seek(number);
  }, frame);
  return page;
}

for (const [name, { run, url }] of Object.entries({ flat, solid })) {
  test(`${name}: opens from the disk without a network and shows awake and sleeping bodies`, async () => {
    const page = await openAt(url, 400, { offline: true });
    const share = await colours(page);
    assert.ok(share.orange > 0.002, `orange ${share.orange}`);
    assert.ok(share.dark > 0.002, `dark ${share.dark}`);
    assert.ok(share.white > 0.3, `white ${share.white}`);
    assert.deepEqual(page.faults, []);
    await page.close();
  });

  test(`${name}: counts are those of the run at each step, also when scrubbing back`, async () => {
    const page = await openAt(url, 0);
    const counts = awakeBySteps(run);
    for (const frame of [449, 10, 200, 199, 201, 31, 32, 33, 448]) {
      await page.evaluate((number) => window.talus.seek(number), frame);
      const state = await shown(page);
      const { awake, bodies } = counts.get(state.step);
      assert.deepEqual([state.frame, state.awake, state.bodies], [frame, awake, bodies]);
      const rows = await page.locator("#counts td.count").allTextContents();
      assert.deepEqual(rows.map(Number), [awake, bodies - awake], "the numbers on the page");
    }
    await page.close();
  });

  test(`${name}: a state reached by stepping back is that of a frame reached forwards`, async () => {
    const page = await openAt(url, 0);
    const poses = (frame) => page.evaluate((number) => (window.talus.seek(number), Array.from(window.talus.timeline.state.pose.slice(0, 60))), frame);
    const forwards = [];
    for (let frame = 300; frame < 340; ++frame) forwards.push(await poses(frame));
    for (let frame = 339; frame >= 300; --frame) assert.deepEqual(await poses(frame), forwards[frame - 300]);
    await page.close();
  });

  test(`${name}: a click on a body names the cause`, async () => {
    const page = await openAt(url, 449);
    // A body that is seen at its own place.
    const body = await page.evaluate(() => {
      const { state } = window.talus.timeline;
      for (let i = 0; i < state.bodies; ++i) {
        const { x, y } = window.talus.stage.placeOf(i);
        if (state.asleep[i] !== 0 && window.talus.stage.bodyAt(x, y) === i) return { i, x, y };
      }
      return null;
    });
    assert.ok(body, "a sleeping body is in sight");
    await page.locator("#bodies").click({ position: { x: body.x, y: body.y } });
    const text = await page.locator("#body").innerText();
    assert.match(text, new RegExp(`Body ${body.i}, shape L`));
    assert.match(text, /Asleep since \d+\.\d+ s \(step \d+\)/);
    assert.match(text, /Cause: rest \(it was at rest/);
    await page.close();
  });
}

test("buttons, keys and the slider play, step and scrub", async () => {
  const page = await openAt(flat.url, 100);
  await page.click("#forward");
  assert.equal((await shown(page)).frame, 101);
  await page.click("#back");
  await page.keyboard.press(",");
  assert.equal((await shown(page)).frame, 99);
  await page.locator("#scrub").fill("300");
  assert.equal((await shown(page)).frame, 300);
  await page.keyboard.press("Home");
  assert.equal((await shown(page)).frame, 0);
  await page.selectOption("#rate", "4");
  await page.click("#play");
  await page.waitForFunction(() => window.talus.shown().frame > 20);
  await page.click("#play");
  const { frame, playing } = await shown(page);
  assert.equal(playing, false);
  await page.waitForTimeout(200);
  assert.equal((await shown(page)).frame, frame, "a paused record stands still");
  await page.close();
});

test("a looped record begins again", async () => {
  const page = await openAt(flat.url, 440);
  await page.check("#loop");
  await page.click("#play");
  await page.waitForFunction(() => window.talus.shown().frame < 400 && window.talus.shown().playing);
  await page.close();
});

test("colours by cause have a count for each cause, together all bodies", async () => {
  const page = await openAt(flat.url, 449);
  await page.selectOption("#paint", "cause");
  const rows = await page.locator("#counts tr").allInnerTexts();
  assert.ok(rows.some((row) => row.includes("asleep: rest")), rows.join("; "));
  const counts = (await page.locator("#counts td.count").allTextContents()).map(Number);
  assert.equal(counts.reduce((sum, count) => sum + count, 0), (await shown(page)).bodies);
  await page.close();
});

/// Of a record, as `talus info` prints them, the messages of one channel.
const messages = (run, channel) =>
  talus("info", run, "--messages", "--channel", channel)
    .trim()
    .split("\n")
    .map((line) => JSON.parse(line).message);

for (const [name, { run, url }] of Object.entries({ flat, solid })) {
  test(`${name}: poses, piles and numbers are those of the messages in the record`, async () => {
    const page = await openAt(url, 0);
    const step = 600;
    const [poses, piles, stats] = ["TALUS_BODIES", "TALUS_PILES", "TALUS_STATS"].map((channel) => messages(run, channel).find((message) => message.step === step));
    const seen = await page.evaluate(([wanted, bodies]) => {
      const { timeline } = window.talus;
      window.talus.seek(timeline.step.indexOf(wanted));
      const { state } = timeline;
      const width = timeline.head.dimension === 2 ? 3 : 7;
      return {
        poses: bodies.flatMap((body) => Array.from(state.pose.slice(width * body, width * (body + 1)))),
        asleep: bodies.map((body) => state.asleep[body] === 1),
        layers: state.piles[0].layers.map(({ bottom, top, count, wake_density }) => [bottom, top, count, wake_density]),
        slope: [state.stats.slope, state.stats.slope_reason],
        shapes: timeline.head.shapes.map(({ name, extent }) => [name, extent]),
      };
    }, [step, poses.body]);
    assert.ok(poses.body.length > 0 && piles.piles[0].layers.length > 0);
    assert.deepEqual(seen.poses, poses.poses.map(Math.fround));
    assert.deepEqual(seen.asleep, poses.asleep);
    assert.deepEqual(seen.layers, piles.piles[0].layers.map(({ bottom, top, count, wake_density }) => [bottom, top, count, wake_density].map(Math.fround)));
    assert.deepEqual(seen.slope, [stats.slope, stats.slope_reason]);
    await page.close();
  });

  test(`${name}: the slope at the end is that of the summary, or there is its reason`, async () => {
    const page = await openAt(url, 449);
    const { angle_of_repose_deg, angle_of_repose_reason } = JSON.parse(readFileSync(join(run, "summary.json"), "utf8")).shape;
    const text = await page.textContent("#measured");
    assert.ok(text.includes(angle_of_repose_deg === null ? `Slope not measured: ${angle_of_repose_reason}` : `Slope ${angle_of_repose_deg.toFixed(1)}\u00B0 measured`), text);
    await page.close();
  });
}

test("layers are named where there are piles, and those that a message has no room for", async () => {
  const page = await openAt(flat.url, 449);
  assert.ok(await page.isVisible("#of-layers"));
  assert.doesNotMatch(await page.textContent("#measured"), /layers: the lowest/);
  const layers = await page.evaluate(() => {
    const { talus } = window;
    talus.timeline.state.piles[0].layer_total = 2000; // as of a pile so high
    talus.showMeasured();
    return talus.timeline.state.piles[0].layers.length;
  });
  assert.ok((await page.textContent("#measured")).includes(`A pile has 2000 layers: the lowest ${layers} are shown`));
  await page.close();
  const without = record("rings_in_a_box_2d", "--set", "pile=[]", "--set", "run.frames=30");
  const other = await openAt(without.url, 20);
  assert.ok(await other.isHidden("#of-layers"));
  assert.ok(await other.isHidden("#layers"));
  assert.equal(await other.locator("#plots .uplot:visible").count(), 1);
  assert.deepEqual(other.faults, []);
  await other.close();
});

test("a page refuses messages of another version, with both versions", async () => {
  const html = readFileSync(flat.url, "utf8");
  const other = join(folder, "other.html");
  writeFileSync(other, html.replace(/("TALUS_RUN":\{"fingerprint":")[0-9a-f]{16}/, "$10123456789abcdef").replace('{"format":1,"version":"', '{"format":7,"version":"9.9'));
  const page = await openPage(pathToFileURL(other), { talus: false });
  await page.waitForFunction(() => document.getElementById("status").textContent !== "");
  assert.match(await page.textContent("#status"), /^cannot be shown: format 1 of talus [\d.]+.*; this page reads format 7 of talus 9\.9/);
  await page.close();
});

test("a damaged record is shown, and says what is missing", async () => {
  const run = join(folder, "damaged");
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "run.frames=60", "--out", run);
  const log = readFileSync(join(run, "run.lcm"));
  log.fill(0x55, log.length - 9000, log.length - 8900);
  writeFileSync(join(run, "run.lcm"), log);
  const { url, child } = await serve(run);
  const page = await openPage(url);
  assert.match(await page.textContent("#status"), /^\d+ damaged bytes and 0 messages not decodable: frames may be missing$/);
  assert.ok((await shown(page)).frames >= 58);
  await page.close();
  child.kill();
});

test("talus view shows a run folder", async () => {
  const { url, child } = await serve(flat.run);
  const page = await openAt(url, 449);
  const { awake } = awakeBySteps(flat.run).get(900);
  assert.equal((await shown(page)).awake, awake);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});
