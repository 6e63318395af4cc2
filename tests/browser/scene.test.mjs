// A scene that is simulated while `talus view SCENE` shows it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openPage, serve, shown, statusOf, until, upgrade } from "./browser.mjs";

test("something moves within three seconds of the command", async () => {
  await (await openPage("about:blank", { talus: false })).close(); // the browser is running
  const start = Date.now();
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url);
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
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "16");
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 30);
  await page.click("#run");
  await page.waitForFunction(() => document.getElementById("speed").textContent === "paused");
  await page.waitForTimeout(300);
  const paused = await shown(page);
  await page.click("#single");
  await until(page, ({ step }) => step === paused.step + 1);
  await page.waitForTimeout(300);
  assert.equal((await shown(page)).step, paused.step + 1, "one step is one step");
  await page.click("#back");
  assert.equal((await shown(page)).step, paused.step, "what came can be scrubbed");
  await page.click("#restart");
  await until(page, ({ step }) => step === 0);
  await page.selectOption("#policy", "full");
  await page.selectOption("#pace", "64");
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
  await page.waitForFunction(() => document.getElementById("text").value !== "");
  const text = await page.inputValue("#text");
  const line = text.split("\n").findIndex((row) => row.startsWith("dimension")) + 1;
  await page.fill("#text", text.replace(/^dimension = 2/m, "dimension = 7"));
  await page.click("#apply");
  await page.waitForFunction(() => document.getElementById("errors").textContent !== "");
  assert.match(await page.textContent("#errors"), new RegExp(`:${line}:\\d+: dimension = 7: must be`));
  const selected = await page.evaluate(() => {
    const area = document.getElementById("text");
    return area.value.slice(area.selectionStart, area.selectionEnd);
  });
  assert.equal(selected, "dimension = 7", "the line of the error is marked");
  const start = Date.now();
  await page.fill("#text", text.replace(/^title = .*/m, 'title = "Another"'));
  await page.click("#apply");
  await page.waitForFunction(() => document.getElementById("title").textContent === "Another");
  console.log(`runs again after ${Date.now() - start} ms`);
  assert.equal(await page.textContent("#errors"), "");
  await page.close();
  child.kill();
});

test("a scene of the other dimension can follow", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d");
  const page = await openPage(url);
  await page.waitForFunction(() => document.getElementById("text").value !== "");
  await page.fill("#text", 'title = "Cubes"\ndimension = 3\nshape.cube = {kind = "box", size = [1.0, 1.0, 1.0]}\n[[source]]\ncount = 9\n[[pile]]\n');
  await page.click("#apply");
  await page.waitForFunction(() => document.getElementById("title").textContent === "Cubes");
  await until(page, ({ bodies }) => bodies > 0);
  assert.equal(await page.textContent("#errors"), "");
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("a body is thrown by shift and drag, and removed by Delete", async () => {
  // Few bodies, so that none falls onto the one thrown.
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8", "--set", "source[0].count=12");
  const page = await openPage(url);
  await until(page, ({ bodies, asleep }) => bodies === 12 && asleep > 8, 60);
  await page.click("#run");
  await page.waitForFunction(() => document.getElementById("speed").textContent === "paused");
  await page.waitForTimeout(500);
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
  await page.mouse.move(x + body.x, y + body.y - 60, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  for (let i = 0; i < 12; ++i) await page.click("#single");
  await until(page, ({ step }) => step >= before.step + 12);
  const now = await page.evaluate((i) => ({ height: window.talus.timeline.state.pose[3 * i + 1], asleep: window.talus.timeline.state.asleep[i] }), body.i);
  assert.equal(now.asleep, 0, "a thrown body wakes");
  assert.ok(now.height > body.height + 500, `${now.height} from ${body.height} thousandths of a body`);
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
    const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8", "--policy", policy);
    const page = await openPage(url);
    await until(page, ({ asleep }) => asleep > 3, 60);
    await page.click("#run");
    await page.waitForFunction(() => document.getElementById("speed").textContent === "paused");
    await page.waitForTimeout(500);
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
  await page.selectOption("#number", "source[0].count");
  assert.equal(await page.inputValue("#slider"), "400");
  await page.locator("#slider").fill("7");
  await page.waitForFunction(() => document.getElementById("text").value.includes("count = 7"));
  await until(page, ({ bodies }) => bodies === 7, 60);
  await page.locator("#value").fill("-3");
  await page.locator("#value").press("Enter");
  await page.waitForFunction(() => document.getElementById("errors").textContent.includes("count"));
  assert.equal((await shown(page)).bodies, 7, "the run goes on as it was");
  await page.close();
  child.kill();
});

test("two pages show the same run", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--pace", "8");
  const pages = [await openPage(url)];
  await until(pages[0], ({ bodies }) => bodies > 10);
  pages.push(await openPage(url));
  await until(pages[1], ({ bodies }) => bodies > 10);
  await pages[1].click("#run");
  for (const page of pages) await page.waitForFunction(() => document.getElementById("speed").textContent === "paused");
  await pages[0].waitForTimeout(500);
  const [a, b] = await Promise.all(pages.map(shown));
  assert.deepEqual([a.step, a.awake, a.asleep], [b.step, b.awake, b.asleep]);
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
