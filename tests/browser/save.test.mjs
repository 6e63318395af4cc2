// The present state as a scene file, walls cut away, and a camera that follows a body.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { endless, openPage, pause, serve, shown, talus, temporaryFolder, until } from "./browser.mjs";

/// Position [m], sleep and shape of each body that is there.
const bodiesOf = (page) =>
  page.evaluate(() => {
    const { state, head } = window.talus.timeline;
    const components = head.dimension === 2 ? 3 : 7;
    return Array.from({ length: state.bodies }, (_, i) => i)
      .filter((i) => state.removed[i] === 0)
      .map((i) => ({ asleep: state.asleep[i], shape: head.shapes[state.shape[i]].name, at: Array.from(state.pose.slice(components * i, components * i + head.dimension)) }));
  });

for (const scene of ["drop_in_a_pile_2d", "drop_in_a_pile_3d"]) {
  test(`${scene}: the scene saved begins with the bodies as they are, without the one deleted`, async () => {
    const { url, child } = await serve(scene, "--pace", "16", "--set", "source[0].count=12", ...endless);
    const page = await openPage(url);
    await until(page, ({ bodies, asleep }) => bodies === 12 && asleep === 12, 120);
    await pause(page);
    await page.evaluate(() => window.talus.command({ do: "remove", body: 3 }));
    await until(page, ({ bodies }) => bodies === 11);
    const before = await bodiesOf(page);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
    assert.match(download.suggestedFilename(), /^drop_in_a_pile_.d_step_\d+\.toml$/);
    const file = join(temporaryFolder(), "saved.toml");
    await download.saveAs(file);
    assert.match(readFileSync(file, "utf8"), /^# .* saved by talus view\.\n# Not kept:\n/);
    talus("check", file);
    const again = await serve(file);
    const other = await openPage(again.url);
    await until(other, ({ bodies }) => bodies === 11);
    await pause(other);
    await other.evaluate(() => window.talus.seek(window.talus.timeline.step.findIndex((step) => step > 0)));
    const first = await bodiesOf(other);
    assert.equal(first.length, before.length);
    for (const [i, body] of first.entries()) {
      assert.equal(body.shape, before[i].shape);
      if (before[i].asleep === 0 || body.asleep === 0) continue; // it moves within the step
      for (const [axis, place] of body.at.entries()) assert.ok(Math.abs(place - before[i].at[axis]) <= 1e-4, `body ${i}: ${body.at} from ${before[i].at}`);
    }
    assert.deepEqual(page.faults.concat(other.faults), []);
    await page.close();
    await other.close();
    child.kill();
    again.child.kill();
  });
}

test("a wall is cut away by a click, and the others stay", async () => {
  const { url, child } = await serve("rings_in_a_box_2d", "--set", "source[0].count=4", ...endless);
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 0);
  await pause(page); // else the camera moves on between the search for a place and the click
  const obstacles = () => page.evaluate(() => window.talus.stage.surroundings.obstacles.map(({ mesh }) => mesh.visible));
  const before = await obstacles();
  assert.ok(before.length > 1 && before.every((visible) => visible));
  const place = await page.evaluate(() => {
    const { width, height } = document.getElementById("bodies").getBoundingClientRect();
    for (let y = 10; y < height; y += 4)
      for (let x = 10; x < width; x += 2) {
        const obstacle = window.talus.stage.obstacleAt(x, y);
        if (obstacle >= 0 && window.talus.stage.bodyAt(x, y) < 0) return { x, y, obstacle };
      }
    return null;
  });
  assert.ok(place);
  await page.keyboard.press("x");
  const { x, y } = await page.locator("#bodies").boundingBox();
  await page.mouse.click(x + place.x, y + place.y);
  await page.waitForFunction((k) => !window.talus.stage.surroundings.obstacles[k].mesh.visible, place.obstacle);
  assert.equal((await obstacles()).filter((visible) => visible).length, before.length - 1);
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("s")]);
  const file = join(temporaryFolder(), "cut.toml");
  await download.saveAs(file);
  talus("check", file);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});

test("the camera follows a body", async () => {
  const { url, child } = await serve("drop_in_a_pile_2d", "--set", "source[0].count=40", "--pace", "0.2");
  const page = await openPage(url);
  await until(page, ({ bodies }) => bodies > 0);
  await pause(page);
  const body = (await page.evaluate(() => window.talus.timeline.state.bodies)) - 1;
  await page.evaluate((i) => window.talus.select(i), body);
  await page.click("#follow");
  // From the middle of the view [m]: on the screen it moves too where the plots below take some of the height.
  const placeOf = () =>
    page.evaluate((i) => {
      const [x, height] = window.talus.timeline.state.pose.slice(3 * i, 3 * i + 2);
      const { target } = window.talus.stage.view();
      return { height, right: x - target[0], up: height - target[1] };
    }, body);
  const before = await placeOf();
  const { step } = await shown(page);
  for (let i = 0; i < 10; ++i) await page.evaluate(() => window.talus.command({ do: "step" }));
  await until(page, (now) => now.step === step + 10);
  const after = await placeOf();
  assert.ok(before.height - after.height > 0.1, `it falls from ${before.height} to ${after.height}`);
  assert.ok(Math.hypot(after.right - before.right, after.up - before.up) < 1e-3, "and stays where it is in the view");
  await page.close();
  child.kill();
});

test("enclosed bodies of a large pile are not drawn, and the pile looks the same", async () => {
  const edge = 30;
  const file = join(temporaryFolder(), "cubes.toml");
  const pile = `[[body]]\nposition = [0, 0, 0.5]\nrepeat = [${edge}, ${edge}, ${edge}]\nstep = [1, 1, 1]\nasleep = true\n`;
  const head = `title = "cubes"\ndimension = 3\nshape.cube = {kind = "box", size = [1, 1, 1]}\nrun = {frames = 100000}\n`; // longer than the test
  writeFileSync(file, head + pile);
  const { url, child } = await serve(file);
  const page = await openPage(url);
  await until(page, ({ asleep }) => asleep === edge ** 3, 60);
  await page.waitForFunction(() => document.getElementById("measured").textContent.includes("enclosed bodies not drawn"));
  await pause(page);
  const picture = () =>
    page.evaluate(async () => {
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      const source = document.getElementById("bodies");
      const canvas = Object.assign(document.createElement("canvas"), { width: source.width, height: source.height });
      const paper = canvas.getContext("2d");
      paper.drawImage(source, 0, 0);
      return Array.from(paper.getImageData(0, 0, canvas.width, canvas.height).data);
    });
  const drawn = () => page.evaluate(() => window.talus.stage.shapes.reduce((sum, { bodies }) => sum + bodies.length, 0));
  const few = await drawn();
  assert.ok(few < 0.75 * edge ** 3, `${few} of ${edge ** 3}`);
  const without = await picture();
  await page.evaluate(() => {
    const { timeline, stage } = window.talus;
    stage.enclosed.fewest = Infinity;
    stage.update("all", () => timeline.head.colours.asleep);
  });
  assert.equal(await drawn(), edge ** 3);
  const all = await picture();
  let different = 0;
  // Light that falls through the seams of touching cubes is a little different: by up to 40 levels in single pixels.
  for (let i = 0; i < all.length; i += 4) if (Math.abs(all[i] - without[i]) > 64) ++different;
  assert.ok(different < (1e-4 * all.length) / 4, `${different} of ${all.length / 4} pixels differ`);
  assert.deepEqual(page.faults, []);
  await page.close();
  child.kill();
});
