// A scene that is simulated while `talus view SCENE` shows it.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { endless, openPage, openScene, pause, runScene, sceneText, serve, shown, statusOf, talus, temporaryFolder, until, upgrade } from "./browser.mjs";

test("something moves within three seconds of the command", async () => {
  // In a browser that has shown a page before: without a graphics card its first picture takes a second or two to begin.
  const before = await serve("drop_in_a_pile_2d");
  const page = await openPage(before.url);
  await until(page, ({ bodies }) => bodies > 0);
  before.child.kill();
  const start = Date.now();
  const { url, child } = await serve("drop_in_a_pile_2d");
  await page.goto(String(url));
  await page.waitForFunction(() => window.talus !== undefined);
  const first = await until(page, ({ bodies }) => bodies > 0);
  await until(page, ({ step }) => step > first.step);
  const seconds = (Date.now() - start) / 1000;
  console.log(`moves after ${seconds} s`);
  assert.ok(seconds < 3, `${seconds} s`);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("run, pause, step, restart, pace and policy steer the simulation", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "16", ...endless);
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 30);
  await pause(page);
  const paused = await shown(page);
  await page.click("#forward");
  await until(page, ({ step }) => step === paused.step + 1);
  await page.waitForTimeout(300);
  assert.equal((await shown(page)).step, paused.step + 1, "one step is one step");
  await page.click("#back");
  assert.equal((await shown(page)).step, paused.step, "what came can be scrubbed");
  await page.click("#restart");
  await until(page, ({ step }) => step === 0);
  assert.equal(await page.locator("#plots .uplot").count(), 1, "the plots of the run before have gone, and before there is a pile there are no layers to plot");
  await page.selectOption("#policy", "full");
  await page.selectOption("#rate", "64");
  const full = await until(page, ({ bodies, step }) => bodies > 30 && step > 0);
  assert.equal(full.asleep, 0, "under policy full no body sleeps");
  assert.match(await page.textContent("#subtitle"), /policy full/);
  await page.close();
  child.kill();
});

test("the wall time of a step is drawn over time, and how far the page lies behind the run is told", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "16");
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 30);
  await page.waitForFunction(() => /ms a step, .* x real time, this page \d+ steps behind/.test(document.getElementById("speed").textContent));
  const { times, frames } = await page.evaluate(() => ({ times: window.talus.timeline.msPerStep, frames: window.talus.timeline.frames }));
  assert.equal(times.length, frames, "one for each frame");
  assert.ok(times.some((time) => time > 0), JSON.stringify(times));
  const inside = await page.evaluate(() => [...document.querySelectorAll(".playhead")].every((line) => line.offsetLeft <= line.parentElement.clientWidth));
  assert.ok(inside, "the time shown is marked inside of the plots");
  await page.close();
  child.kill();
});

test("the scene's text is checked and run again", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url);
  await page.waitForFunction(() => window.talus.simulation.editor.text !== "");
  const text = await sceneText(page);
  const line = text.split("\n").findIndex((row) => row.startsWith("dimension")) + 1;
  await runScene(page, text.replace(/^dimension = 2/m, "dimension = 7"));
  await page.waitForFunction(() => document.getElementById("errors").textContent !== "");
  assert.match(await page.textContent("#errors"), new RegExp(`:${line}:\\d+: dimension = 7: must be`));
  assert.equal(await page.evaluate(() => getSelection().toString()), "dimension = 7", "the line of the error is chosen");
  assert.equal(await page.locator(".cm-lintRange-error").first().textContent(), "dimension = 7", "and marked");
  assert.equal(await page.locator(".cm-lint-marker-error").count(), 1);
  const start = Date.now();
  await runScene(page, text.replace(/^title = .*/m, 'title = "Another"'));
  await page.waitForFunction(() => document.getElementById("title").textContent === "Another");
  console.log(`runs again after ${Date.now() - start} ms`);
  assert.equal(await page.textContent("#errors"), "");
  await page.close();
  child.kill();
});

test("a scene of the other dimension can follow", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url);
  await runScene(page, 'title = "Cubes"\ndimension = 3\nshape.cube = {kind = "box", size = [1.0, 1.0, 1.0]}\n[[source]]\ncount = 9\n[[pile]]\n');
  await page.waitForFunction(() => document.getElementById("title").textContent === "Cubes");
  await until(page, ({ bodies }) => bodies > 0);
  assert.equal(await page.textContent("#errors"), "");
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("a body is thrown by shift and drag, and removed by Delete", async () => {
  // Few bodies, so that none falls onto the one thrown.
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8", "--set", "source[0].count=12", ...endless);
  const page = await openPage(url);
  await until(page, ({ bodies, asleep }) => bodies === 12 && asleep === 12, 60);
  await pause(page);
  const before = await shown(page);
  // The highest one that sleeps: nothing lies on it.
  const body = await page.evaluate(() => {
    const { state } = window.talus.timeline;
    let best = null;
    for (let i = 0; i < state.bodies; ++i) {
      const [{ x, y }, height] = [window.talus.stage.placeOf(i), state.pose[3 * i + 1]];
      if (state.asleep[i] !== 0 && window.talus.stage.bodyAt(x, y) === i && height > (best?.height ?? 0)) best = { i, x, y, height };
    }
    return best;
  });
  assert.ok(body);
  const { x, y } = await page.locator("#bodies").boundingBox();
  await page.keyboard.down("Shift");
  await page.mouse.move(x + body.x, y + body.y);
  await page.mouse.down();
  await page.mouse.move(x + body.x, y + body.y - 120, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  for (let i = 0; i < 12; ++i) await page.click("#forward");
  await until(page, ({ step }) => step >= before.step + 12);
  const now = await page.evaluate((i) => ({ height: window.talus.timeline.state.pose[3 * i + 1], asleep: window.talus.timeline.state.asleep[i], extent: window.talus.timeline.head.shapes[0].extent }), body.i);
  assert.equal(now.asleep, 0, "a thrown body wakes");
  assert.ok(now.height > body.height + 0.5 * now.extent, `${now.height} m from ${body.height} m`);
  await page.keyboard.press("Delete");
  await until(page, ({ bodies }) => bodies < before.bodies + 2 && bodies > 0);
  await page.waitForFunction((i) => window.talus.timeline.state.removed[i] === 1, body.i);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

for (const [policy, wanted] of [
  ["adaptive", /Rests on .*At rest for|Rests on .*Asleep|Asleep.*Cause: rest.*Layer.*Rests on/s],
  ["paper", /Asleep.*Cause: score.*Score [\d.]+ when it fell asleep, threshold 0\.5.*Rests on .*Density of its layer: [\d.e-]+ \(above 0\.8/s],
]) {
  test(`a click under policy ${policy} names cause, score, supports and thresholds`, async () => {
    const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8", "--policy", policy, ...endless);
    const page = await openPage(url);
    for (;;) {
      await until(page, ({ asleep }) => asleep > 3, 60);
      await pause(page);
      if ((await shown(page)).asleep > 3) break;
      await page.click("#play"); // the pile has woken meanwhile
    }
    const place = await page.evaluate(() => {
      const { state } = window.talus.timeline;
      const { stage } = window.talus;
      for (let i = 0; i < state.bodies; ++i) {
        const { x, y } = stage.placeOf(i);
        if (state.asleep[i] !== 0 && stage.bodyAt(x, y) === i) return { x, y };
      }
    });
    const { x, y } = await page.locator("#bodies").boundingBox();
    await page.mouse.click(x + place.x, y + place.y);
    await page.waitForFunction(() => document.getElementById("body").textContent.includes("Rests on"));
    assert.match((await page.locator("#body p").allTextContents()).join("\n"), wanted);
    await page.click("#back");
    assert.ok(!(await page.textContent("#body")).includes("Rests on"), "of an older frame this is not known");
    assert.deepEqual(page.faults, []);
    await page.close();
    child.kill();
  });
}

test("commands for bodies that are not there are refused", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url);
  for (const command of [{ do: "remove", body: 1e6 }, { do: "kick", body: 0, velocity: [1] }, { do: "kick", body: 0.5, velocity: [1, 1] }, { do: "kick", body: -1, velocity: [1, 1] }]) {
    await page.evaluate((text) => (document.getElementById("errors").replaceChildren(), window.talus.command(text)), command);
    await page.waitForFunction(() => document.getElementById("errors").textContent !== "");
  }
  await page.close();
  child.kill();
});

test("a slider changes a number of the scene, which runs again", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8");
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 5);
  await openScene(page);
  await page.selectOption("#number", "source[0].count");
  assert.equal(await page.inputValue("#slider"), "400");
  await page.locator("#slider").fill("7");
  await page.waitForFunction(() => window.talus.simulation.editor.text.includes("count = 7"));
  await until(page, ({ bodies }) => bodies === 7, 60);
  await page.locator("#value").fill("-3");
  await page.locator("#value").press("Enter");
  await page.waitForFunction(() => document.getElementById("errors").textContent.includes("count"));
  assert.equal((await shown(page)).bodies, 7, "the run goes on as it was");
  const text = await page.evaluate(() => window.talus.simulation.editor.text);
  await page.evaluate(() => window.talus.command({ do: "remove", body: 0 }));
  await until(page, ({ bodies }) => bodies === 6);
  assert.match(await page.textContent("#errors"), /count/, "what is done by hand mends no text");
  await page.locator("#value").fill("");
  await page.locator("#value").press("Enter");
  assert.equal(await page.evaluate(() => window.talus.simulation.editor.text), text, "an empty field is no number");
  await page.close();
  child.kill();
});

test("the sliders begin with a number that is worth to change, and have no dimension", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url);
  await page.waitForFunction(() => window.talus.simulation.editor.text !== "");
  assert.match(await page.inputValue("#number"), /friction$/);
  const paths = await page.locator("#number option").allTextContents();
  assert.ok(paths.length > 3 && !paths.includes("dimension"), paths.join(" "));
  await page.close();
  child.kill();
});

const rests = 'title = "rests"\ndimension = 2\nrun = {until = "rest", frames = 3000}\nshape.disc = {kind = "ball", radius = 0.5, rolling_friction = 0.2}\n[[source]]\nposition = [0, 4]\ncount = 3\n[[pile]]\n';

test("a run until rest ends when talus run does, with its estimate of drift, and can be replayed and run again", async () => {
  const folder = temporaryFolder();
  const scene = join(folder, "rests.toml");
  writeFileSync(scene, rests);
  talus("run", scene, "--no-telemetry", "--out", join(folder, "run"));
  const summary = JSON.parse(readFileSync(join(folder, "run", "summary.json"), "utf8"));
  assert.ok(summary.at_rest && summary.steps < 3000 && summary.estimate);
  const { url, child } = await serve(scene, "--pace", "0");
  const page = await openPage(url);
  await page.waitForFunction(() => document.getElementById("speed").textContent.startsWith("finished: all at rest after"), null, { timeout: 60_000 });
  const end = await until(page, ({ step }) => step === summary.steps);
  assert.equal(end.asleep, summary.asleep_at_end);
  const drift = await page.evaluate(() => window.talus.timeline.state.drift);
  assert.ok(Math.abs(drift - summary.estimate.drift_D) <= 1e-6 * summary.estimate.drift_D, `${drift}, not ${summary.estimate.drift_D}`);
  assert.equal(await page.getAttribute("#play", "aria-label"), "Play");
  await page.click("#play");
  await page.waitForFunction(() => window.talus.shown().playing && window.talus.shown().frame > 3 && window.talus.shown().frame < window.talus.timeline.frames - 1);
  assert.equal(await page.getAttribute("#play", "aria-label"), "Pause");
  await page.click("#play");
  await page.waitForFunction(() => !window.talus.shown().playing);
  await page.click("#restart");
  await page.waitForFunction(() => window.talus.shown().step === 0 || window.talus.timeline.frames < 100);
  await page.waitForFunction(() => document.getElementById("speed").textContent.startsWith("finished"), null, { timeout: 60_000 });
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("the record of a run has at its end the estimate of drift that the run told", async () => {
  const folder = temporaryFolder();
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "source[0].count=40", "--set", "run.frames=450", "--out", join(folder, "run"));
  const { estimate } = JSON.parse(readFileSync(join(folder, "run", "summary.json"), "utf8"));
  assert.ok(estimate.probed_s > 0, JSON.stringify(estimate));
  const { url, child } = await serve(join(folder, "run"));
  const page = await openPage(url);
  await page.click("#last");
  const drift = await page.evaluate(() => window.talus.timeline.state.drift);
  assert.ok(Math.abs(drift - estimate.drift_D) <= 1e-6 * estimate.drift_D, `${drift}, not ${estimate.drift_D}`);
  assert.match(await page.textContent("#measured"), new RegExp(`Drift estimated ${estimate.drift_D.toPrecision(2)} D`));
  await page.close();
  child.kill();
});

test("after a resize the line of the time shown and the cursor are where they should be", async () => {
  const run = join(temporaryFolder(), "run");
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--set", "run.frames=90", "--out", run);
  const { url, child } = await serve(run);
  const page = await openPage(url, { viewport: { width: 1280, height: 800 } });
  await page.evaluate(() => (window.talus.pause(), window.talus.seek(45)));
  for (const width of [1280, 700, 1000, 390]) {
    await page.setViewportSize({ width, height: 800 });
    await page.waitForTimeout(300);
    const [line, expected] = await page.evaluate(() => {
      const { plot, head } = window.talus.plots.drawn[0];
      return [parseFloat(head.style.left), plot.valToPos(window.talus.shown().time, "x")];
    });
    assert.ok(Math.abs(line - expected) < 1.5, `${line} for ${expected} at ${width}`);
    const over = page.locator(".u-over").first();
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.25 * box.width, box.y + 0.5 * box.height);
    await page.waitForTimeout(100);
    const cursor = await page.locator(".u-cursor-x").first().boundingBox();
    assert.ok(Math.abs(cursor.x - box.x - 0.25 * box.width) < 2.5, `${cursor.x} at ${width}`);
  }
  await page.close();
  child.kill();
});

test("two pages show the same run", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8", ...endless);
  const pages = [await openPage(url)];
  await until(pages[0], ({ bodies }) => bodies > 10);
  pages.push(await openPage(url));
  await until(pages[1], ({ bodies }) => bodies > 10);
  await pause(pages[1]);
  await pages[0].waitForFunction(() => document.getElementById("speed").textContent === "paused");
  const b = await shown(pages[1]);
  const a = await until(pages[0], ({ step }) => step === b.step);
  assert.deepEqual([a.awake, a.asleep], [b.awake, b.asleep]);
  for (const page of pages) await page.close();
  child.kill();
});

test("a page that acknowledges nothing slows neither the run nor another page", async () => {
  const { url, child, token } = await serve("drop_in_a_pile_2d", "--pace", "0", "--set", "run.frames=600");
  assert.equal(await statusOf(new URL(`/stream?token=${token}`, url), upgrade), 101);
  const page = await openPage(url);
  const end = await until(page, ({ step }) => step === 1200, 60);
  assert.ok(end.bodies > 50);
  await page.close();
  child.kill();
});

test("a page says that the server has gone, and still plays what came", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8");
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 5);
  child.kill("SIGKILL");
  await page.waitForFunction(() => document.getElementById("status").textContent.includes("has gone"));
  await page.evaluate(() => window.talus.seek(0));
  assert.equal((await shown(page)).frame, 0);
  await page.close();
});

test("the editor completes keys and values with range and meaning from the program's reference", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url, { viewport: { width: 1280, height: 800 } });
  await page.waitForFunction(() => window.talus.simulation.editor.text !== "");
  await openScene(page);
  const type = async (text) => {
    const lines = (await sceneText(page)).split("\n");
    await page.evaluate((line) => window.talus.simulation.editor.goTo(line), lines.findIndex((line) => line.startsWith("[shape.L]")) + 1);
    await page.keyboard.press("End");
    await page.keyboard.press("Enter");
    await page.keyboard.type(text);
    await page.waitForSelector(".cm-tooltip-autocomplete");
  };
  await type("rolling_f");
  assert.match(await page.locator(".cm-completionInfo").innerText(), /rolling_friction[\s\S]*range \[0, 10\][\s\S]*default 0[\s\S]*does not roll/);
  await page.waitForTimeout(200); // CodeMirror takes no key until the list has stood for some time
  await page.keyboard.press("Enter");
  await page.keyboard.type("0.25");
  assert.match(await sceneText(page), /\[shape\.L\]\nrolling_friction = 0\.25\n/);
  await type("kind = \"ba");
  await page.waitForSelector(".cm-tooltip-autocomplete li:has-text('ball')");
  await page.keyboard.press("Escape");
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("a page of a simulation that is loaded again shows the time that was chosen, while the run goes on", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "4", ...endless);
  const page = await openPage(url);
  await until(page, ({ time }) => time > 3);
  await page.evaluate(() => window.talus.seekTime(2));
  const { step } = await shown(page);
  await page.waitForTimeout(1000);
  assert.match(page.url(), /#.*t=2/);
  await page.reload();
  await page.waitForFunction(() => window.talus !== undefined);
  await until(page, (now) => now.step === step);
  await page.click("#last");
  await until(page, ({ time }) => time > 3);
  await page.waitForTimeout(600);
  assert.doesNotMatch(page.url(), /#.*t=/);
  await page.close();
  child.kill();
});

test("the time of a step is plotted where the user switches it on, while the run goes on", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "4", ...endless);
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 10);
  await page.waitForFunction(() => document.querySelectorAll("#rows button").length === 3);
  const drawn = () => page.evaluate(() => window.talus.plots.drawn.map(({ row }) => row.name));
  assert.deepEqual(await drawn(), ["bodies", "layers"]);
  await page.click("#rows button:last-child");
  assert.deepEqual(await drawn(), ["bodies", "layers", "step time"]);
  const { max } = await page.evaluate(() => window.talus.plots.drawn[2].plot.scales.y);
  assert.ok(max > 0, `${max}`);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});
