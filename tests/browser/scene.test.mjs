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
