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
  assert.match(await page.locator(".names").last().textContent(), /density/);
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
  assert.ok(await other.isHidden("#layers"));
  assert.equal(await other.locator("#plots .uplot:visible").count(), 1);
  assert.deepEqual(other.faults, []);
  await other.close();
});

test("a page refuses messages of another version, with both versions", async () => {
  const html = readFileSync(flat.url, "utf8");
  const other = join(folder, "other.html");
  writeFileSync(other, html.replace(/("TALUS_RUN":\{"fingerprint":")[0-9a-f]{16}/, "$10123456789abcdef").replace(/\{"format":\d+,"version":"/, '{"format":7,"version":"9.9'));
  const page = await openPage(pathToFileURL(other), { talus: false });
  await page.waitForFunction(() => document.getElementById("status").textContent !== "");
  assert.match(await page.textContent("#status"), /^cannot be shown: format \d+ of talus [\d.]+.*; this page reads format 7 of talus 9\.9/);
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

test("the stage has two thirds of the window, and the card of a body stands beside it and follows it", async () => {
  for (const [width, height] of [[1280, 800], [1920, 1080]]) {
    const page = await openAt(flat.url, 300, { viewport: { width, height } });
    const stage = await page.locator("#stage").boundingBox();
    assert.ok(stage.width * stage.height > 0.666 * width * height, JSON.stringify(stage));
    const body = await page.evaluate(() => window.talus.timeline.state.asleep.indexOf(0));
    const away = async () => {
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      return page.evaluate((i) => {
        const card = document.getElementById("card").getBoundingClientRect();
        const { x, y } = window.talus.stage.placeOf(i);
        return [Math.max(card.left - x, x - card.right, 0), Math.max(card.top - y, y - card.bottom, 0), Math.max(card.right - innerWidth, card.bottom - innerHeight)];
      }, body);
    };
    await page.evaluate((i) => window.talus.select(i), body);
    for (const frame of [300, 310, 320]) {
      await page.evaluate((number) => window.talus.seek(number), frame);
      const [right, down, out] = await away();
      assert.ok(right < 80 && down < 40 && right + down > 5 && out < 0, `${right}, ${down}, ${out}`);
    }
    await page.keyboard.press("Escape");
    assert.ok(await page.isHidden("#card"));
    await page.close();
  }
});

test("a page that is loaded again, or opened at the same address, shows the same", async () => {
  const page = await openAt(flat.url, 0);
  await page.evaluate(() => window.talus.seek(300));
  await page.evaluate(() => window.talus.select(5));
  await page.selectOption("#paint", "speed");
  await page.click("#measures summary");
  await page.click("#rows button:last-child");
  await page.mouse.move(300, 200);
  await page.mouse.wheel(0, -400);
  const stateOf = async (shownPage) => ({
    ...(await shown(shownPage)),
    ...(await shownPage.evaluate(() => ({ body: window.talus.stage.selected, camera: window.talus.stage.cameraText, paint: document.getElementById("paint").value, open: document.getElementById("measures").open, plots: window.talus.plots.drawn.length, text: document.getElementById("body").innerText }))),
  });
  await page.waitForTimeout(1200);
  const before = await stateOf(page);
  assert.equal(before.frame, 300);
  assert.deepEqual([before.body, before.paint, before.open, before.plots], [5, "speed", false, 1]);
  const address = page.url();
  await page.reload();
  await page.waitForFunction(() => window.talus !== undefined);
  await page.waitForTimeout(300);
  assert.deepEqual(await stateOf(page), before);
  const other = await openPage(address);
  await other.waitForTimeout(300);
  assert.deepEqual(await stateOf(other), before);
  assert.deepEqual([...page.faults, ...other.faults], []);
  for (const each of [page, other]) await each.close();
});

/// Of two colours as a style sheet has them.
function contrast(a, b) {
  const luminance = (colour) => {
    const [red, green, blue] = colour.match(/[\d.]+/g).slice(0, 3).map((part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

test("page, stage and plots have the theme of the system, also when it changes, with readable texts in both", async () => {
  const page = await openAt(flat.url, 400);
  const measured = () =>
    page.evaluate(() => {
      const colour = (selector, property) => getComputedStyle(document.querySelector(selector))[property];
      return { panel: colour("#dock", "backgroundColor"), texts: [["h1", "color"], [".hint", "color"], ["summary", "color"], [".names", "color"]].map(([selector, property]) => colour(selector, property)) };
    });
  for (const [theme, white] of [["light", [0.3, 1]], ["dark", [0, 0.01]], ["light", [0.3, 1]]]) {
    await page.emulateMedia({ colorScheme: theme });
    await page.waitForTimeout(300);
    const share = await colours(page);
    assert.ok(share.white >= white[0] && share.white <= white[1], `${theme}: ${share.white}`);
    assert.ok(share.orange > 0.002, `${theme}: awake bodies, ${share.orange}`);
    const { panel, texts } = await measured();
    for (const text of texts) assert.ok(contrast(panel, text) >= 4.5, `${theme}: ${text} on ${panel}`);
    const axis = await page.evaluate(() => String(window.talus.plots.drawn[0].plot.axes[0].stroke));
    assert.ok(contrast(panel, axis) >= 4.5, `${theme}: ${axis} on ${panel}`);
  }
  assert.deepEqual(page.faults, []);
  await page.close();
});

test("the plots tell values under the pointer, go to a time by a click, and zoom together by a drag", async () => {
  const page = await openAt(flat.url, 0);
  const over = await page.locator(".u-over").last().boundingBox();
  const at = (share) => over.x + share * over.width;
  await page.mouse.move(at(0.5), over.y + 0.7 * over.height);
  const text = await page.locator(".hover").innerText();
  const frame = await page.evaluate(() => window.talus.timeline.frameAt(0.5 * window.talus.timeline.time(449)));
  const { awake, asleep } = await page.evaluate((i) => ({ awake: window.talus.timeline.awake[i], asleep: window.talus.timeline.asleep[i] }), frame);
  assert.match(text, /^7\.\d\d s\n/);
  for (const [name, value] of [["awake", awake], ["asleep", asleep]]) assert.ok(Math.abs(Number(new RegExp(`${name} +(\\d+)`).exec(text)[1]) - value) <= 3, text);
  assert.match(text, /height .* m/);
  await page.mouse.click(at(0.25), over.y + 10);
  assert.ok(Math.abs((await shown(page)).time - 0.25 * 14.97) < 0.15);
  const ranges = () => page.evaluate(() => window.talus.plots.drawn.map(({ plot }) => [plot.scales.x.min, plot.scales.x.max].map((time) => Math.round(10 * time) / 10)));
  const [whole] = await ranges();
  await page.mouse.move(at(0.4), over.y + 10);
  await page.mouse.down();
  await page.mouse.move(at(0.6), over.y + 10, { steps: 4 });
  await page.mouse.up();
  const [a, b] = await ranges();
  assert.deepEqual(a, b, "both plots");
  assert.ok(a[1] - a[0] < 0.3 * (whole[1] - whole[0]), JSON.stringify([whole, a]));
  await page.mouse.dblclick(at(0.5), over.y + 10);
  assert.deepEqual(await ranges(), [whole, whole]);
  assert.deepEqual(page.faults, []);
  await page.close();
});

test("each way of colouring has a legend with all bodies, and colours more than one", async () => {
  const page = await openAt(flat.url, 400);
  const { bodies } = await shown(page);
  for (const way of ["state", "cause", "speed", "age", "layer"]) {
    await page.selectOption("#paint", way);
    const counts = (await page.locator("#counts td.count").allTextContents()).map(Number);
    assert.equal(counts.reduce((sum, count) => sum + count, 0), bodies, way);
    const different = await page.evaluate(() => {
      const { coloured, timeline } = window.talus;
      return new Set(Array.from({ length: timeline.state.bodies }, (_, body) => coloured.paint(body).join())).size;
    });
    assert.ok(different > 1, `${way}: ${different}`);
  }
  const speeds = await page.evaluate(() => {
    const { timeline } = window.talus;
    const at = (frame, body) => (timeline.seek(frame), Array.from(timeline.state.pose.slice(3 * body, 3 * body + 2)));
    const body = timeline.state.asleep.indexOf(0);
    const [a, b] = [at(399, body), at(400, body)];
    return [timeline.speed(body), Math.hypot(b[0] - a[0], b[1] - a[1]) * 30];
  });
  assert.ok(Math.abs(speeds[0] - speeds[1]) < 1e-3, JSON.stringify(speeds));
  await page.close();
});

test("a button gives a picture of what is seen with a caption, another one a film", async () => {
  const page = await openAt(solid.url, 400);
  const [picture] = await Promise.all([page.waitForEvent("download"), page.click("#picture")]);
  assert.match(picture.suggestedFilename(), /_13\.37_s\.png$/);
  const file = join(folder, "seen.png");
  await picture.saveAs(file);
  const bytes = readFileSync(file);
  const stage = await page.evaluate(() => [document.getElementById("bodies").width, document.getElementById("bodies").height]);
  assert.equal(bytes.readUInt32BE(16), stage[0]);
  assert.ok(bytes.readUInt32BE(20) > stage[1] + 40, "below it there is room for time, seed and legend");
  await page.click("#film");
  await page.click("#play");
  await page.waitForTimeout(1500);
  const [film] = await Promise.all([page.waitForEvent("download"), page.click("#film")]);
  assert.match(film.suggestedFilename(), /\.webm$/);
  await film.saveAs(join(folder, "seen.webm"));
  const begin = readFileSync(join(folder, "seen.webm"));
  assert.equal(begin.readUInt32BE(0), 0x1a45dfa3, "Matroska");
  assert.ok(begin.length > 5000, `${begin.length} bytes`);
  assert.deepEqual(page.faults, []);
  await page.close();
});

test("the key ? lists all keys, and panels fold", async () => {
  const page = await openAt(flat.url, 10);
  await page.keyboard.press("?");
  assert.match(await page.locator("#keys").innerText(), /space\s+play, pause/);
  await page.keyboard.press("?");
  assert.ok(await page.isHidden("#keys"));
  const width = async () => (await page.locator("#stage").boundingBox()).width;
  const before = await width();
  await page.keyboard.press("d");
  assert.ok((await width()) > before + 200);
  await page.close();
});

test("in 3D the camera stands where the pictures' does, and turns about the vertical", async () => {
  const page = await openAt(solid.url, 400);
  const angles = () =>
    page.evaluate(() => {
      const { eye, target } = window.talus.stage.view();
      const [x, y, z] = eye.map((part, i) => part - target[i]);
      return { azimuth: Math.atan2(y, x), elevation: Math.atan2(z, Math.hypot(x, y)), first: window.talus.timeline.head.camera };
    });
  const { azimuth, elevation, first } = await angles();
  assert.ok(Math.abs(azimuth - first.azimuth) < 1e-3 && Math.abs(elevation - first.elevation) < 1e-3, `${azimuth}, ${elevation}`);
  const { x, y, width, height } = await page.locator("#bodies").boundingBox();
  await page.mouse.move(x + 0.5 * width, y + 0.2 * height);
  await page.mouse.down();
  await page.mouse.move(x + 0.7 * width, y + 0.2 * height, { steps: 4 });
  await page.mouse.up();
  const turned = await angles();
  assert.ok(Math.abs(turned.azimuth - azimuth) > 0.3 && Math.abs(turned.elevation - elevation) < 0.02, JSON.stringify(turned));
  await page.close();
});

test("every sleeping body is drawn with the outline of sleep", async () => {
  const page = await openAt(flat.url, 449);
  const outlines = await page.evaluate(() => {
    const { stage, timeline } = window.talus;
    return stage.shapes.flatMap(({ bodies, sleeping }) => bodies.map((body, place) => [timeline.state.asleep[body], sleeping.getX(place)]));
  });
  assert.ok(outlines.filter(([asleep]) => asleep === 1).length > 20);
  for (const [asleep, outline] of outlines) assert.equal(outline, asleep);
  await page.close();
});

test("the edges of plots and panels can be dragged", async () => {
  const page = await openAt(flat.url, 10, { viewport: { width: 1280, height: 800 } });
  for (const [edge, dx, dy] of [["#plots-edge", 0, -60], ["#dock-edge", -60, 0]]) {
    const size = async () => {
      const { width, height } = await page.locator("#stage").boundingBox();
      return [width, height];
    };
    const before = await size();
    const { x, y, width, height } = await page.locator(edge).boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + dx, y + height / 2 + dy, { steps: 3 });
    await page.mouse.up();
    const after = await size();
    assert.ok(Math.abs(after[0] - before[0] - dx) < 5 && Math.abs(after[1] - before[1] - dy) < 5, `${before} to ${after}`);
  }
  await page.waitForTimeout(300);
  const [plot, plots] = await page.evaluate(() => [window.talus.plots.drawn[0].plot.height, document.getElementById("plots").clientHeight]);
  assert.ok(plot > 0.35 * plots, `${plot} of ${plots}`);
  await page.close();
});

/// Runs a scene of this text and opens its page.
async function openScene(name, text) {
  const scene = join(folder, `${name}.toml`);
  writeFileSync(scene, text);
  talus("run", scene, "--no-telemetry", "--out", join(folder, name));
  const html = join(folder, `${name}.html`);
  talus("replay", join(folder, name), "--out", html);
  return openPage(pathToFileURL(html));
}

/// Pixels of the stage that are near a colour; those of thin lines are mixed with what is behind.
const pixelsNear = async (page, colour, within = 12) => {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.evaluate(([wanted, within]) => {
    const source = document.getElementById("bodies");
    const canvas = Object.assign(document.createElement("canvas"), { width: source.width, height: source.height });
    const paper = canvas.getContext("2d");
    paper.drawImage(source, 0, 0);
    const { data } = paper.getImageData(0, 0, canvas.width, canvas.height);
    let near = 0;
    for (let i = 0; i < data.length; i += 4) near += wanted.every((part, j) => Math.abs(data[i + j] - part) < within) ? 1 : 0;
    return near;
  }, [colour, within]);
};

test("gates and regions are drawn, and their readings and those of loads plotted", async () => {
  const page = await openScene("measured", `title = "Measured"
dimension = 2
shape.disc = {kind = "ball", radius = 0.5, rolling_friction = 0.2}
source = [{count = 30, rate = 15, position = [0, 8], velocity = [0, -8], spread = [1.5, 0]}]
gate = [{name = "gate", corners = [[-3, 4], [3, 4]]}]
region = [{name = "below", box = [[-6, 0], [6, 3]]}]
load = [{name = "ground", on = "ground"}]
run.frames = 120
`);
  const rows = await page.locator("#rows button").allTextContents();
  for (const row of ["gates", "packing", "slope", "loads"]) assert.ok(rows.includes(row), `${row} among ${rows}`);
  await page.evaluate(() => {
    window.talus.pause();
    window.talus.seek(119);
  });
  const gate = await pixelsNear(page, [0, 140, 128], 135);
  const region = await pixelsNear(page, [191, 89, 26], 70);
  assert.ok(gate > 50 && region > 50, `pixels of the gate ${gate}, of the region ${region}`);
  await page.locator(".plot").nth(1).hover({ position: { x: 200, y: 15 } });
  assert.match(await page.locator(".hover").innerText(), /gate [0-9]+ passed/);
  assert.deepEqual(page.faults, []);
  await page.close();
});

test("an obstacle that an event adds is drawn from then on", async () => {
  const page = await openScene("added", `title = "Added"
dimension = 2
shape.disc = {kind = "ball", radius = 0.5}
source = [{count = 2, rate = 1, position = [0, 8]}]
obstacle = [{name = "lid", kind = "box", size = [6, 2], position = [0, 4]}]
event = [{time = 2, do = "add", obstacle = "lid"}]
run.frames = 120
`);
  const at = async (frame) => {
    await page.evaluate((number) => {
      window.talus.pause();
      window.talus.seek(number);
    }, frame);
    return pixelsNear(page, [178, 184, 189]);
  };
  const after = await at(110);
  assert.ok(after > 1000, `${after} pixels`);
  assert.ok((await at(30)) < after / 4);
  assert.ok((await at(100)) > after / 2);
  await page.close();
});

test("a body that reaches through a periodic side is drawn and chosen at both, and moves on without a jump", async () => {
  const run = join(folder, "flow");
  talus("run", join(import.meta.dirname, "../../scenes/questions/flow_2d.toml"), "--no-telemetry", "--out", run, "--set", "run.frames=450");
  const { url } = await serve(run);
  const page = await openAt(url, 449);
  assert.match(await page.textContent("#drawn"), /periodic sides/);
  const period = 4.8; // [m], as the scene has it
  const found = await page.evaluate((apart) => {
    const { stage, timeline } = window.talus;
    const { metresPerPixel } = stage.view();
    const at = (body, way) => {
      const { x, y } = stage.placeOf(body);
      return stage.bodyAt(x + way / metresPerPixel, y);
    };
    return Array.from({ length: timeline.state.bodies }, (_, body) => ({ x: timeline.state.pose[3 * body], own: at(body, 0) === body, images: [-apart, apart].filter((way) => at(body, way) === body).length }));
  }, period);
  assert.ok(found.every(({ own }) => own));
  const distance = ({ x }) => Math.min(x + period / 2, period / 2 - x); // to the nearest side
  assert.ok(found.some((body) => distance(body) < 0.25) && found.some((body) => distance(body) > 0.35), "balls have a radius of 0.27 to 0.33 m");
  for (const body of found)
    if (distance(body) < 0.25 || distance(body) > 0.35) assert.equal(body.images, distance(body) < 0.25 ? 1 : 0, JSON.stringify(body));
  const fastest = await page.evaluate(() => {
    const { timeline } = window.talus;
    return Math.max(...Array.from({ length: 450 }, (_, frame) => (timeline.seek(frame), Array.from({ length: timeline.state.bodies }, (__, body) => timeline.speed(body) ?? 0))).flat());
  });
  assert.ok(fastest > 1 && fastest < 30, `${fastest} m/s; a jump by a period within a frame of a thirtieth second is 144 m/s`);
  assert.deepEqual(page.faults, []);
  await page.close();
});
