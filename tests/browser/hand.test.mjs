// Bodies pulled along and added with the pointer.
import assert from "node:assert/strict";
import { test } from "node:test";
import { endless, openPage, pause, serve, shown, until } from "./browser.mjs";

/// Pauses, and finds the highest body that the pointer reaches, with its place on the page.
async function highest(page) {
  await pause(page);
  const body = await page.evaluate(() => {
    const { state, head } = window.talus.timeline;
    const { stage } = window.talus;
    const components = head.dimension === 2 ? 3 : 7;
    let best = null;
    for (let i = 0; i < state.bodies; ++i) {
      const [{ x, y }, height] = [stage.placeOf(i), state.pose[components * i + head.dimension - 1]];
      if (state.asleep[i] !== 0 && stage.bodyAt(x, y) === i && height > (best?.height ?? 0)) best = { i, x, y, height };
    }
    return best;
  });
  assert.ok(body);
  const { x, y } = await page.locator("#bodies").boundingBox();
  return { number: body.i, x: x + body.x, y: y + body.y };
}

const count = 20; // bodies

const onScreen = (page, body) => page.evaluate((i) => window.talus.stage.placeOf(i), body);

for (const scene of ["drop_in_a_pile_2d", "drop_in_a_pile_3d"]) {
  test(`${scene}: a body is pulled along by the pointer, and stays awake`, async () => {
    const { url, child } = await serve(scene, "--pace", "8", "--set", `source[0].count=${count}`, ...endless);
    const page = await openPage(url);
    await until(page, ({ asleep }) => asleep === count, 60); // before, an impact may wake all again
    const body = await highest(page);
    const before = await onScreen(page, body.number);
    await page.click("[data-tool=pull]");
    await page.mouse.move(body.x, body.y);
    await page.mouse.down();
    await page.mouse.move(body.x + 40, body.y - 60, { steps: 4 });
    await page.waitForTimeout(200);
    const { step } = await shown(page);
    for (let i = 0; i < 4; ++i) {
      for (let k = 0; k < 30; ++k) await page.evaluate(() => window.talus.command({ do: "step" }));
      await until(page, (now) => now.step >= step + 30 * (i + 1), 60);
    }
    const after = await onScreen(page, body.number);
    assert.ok(after.x - before.x > 20 && before.y - after.y > 30, `${JSON.stringify(before)} to ${JSON.stringify(after)}`);
    assert.equal(await page.evaluate((i) => window.talus.timeline.state.asleep[i], body.number), 0);
    await page.mouse.up();
    for (let k = 0; k < 120; ++k) await page.evaluate(() => window.talus.command({ do: "step" }));
    await until(page, (now) => now.step >= step + 240, 60);
    assert.ok((await onScreen(page, body.number)).y > after.y + 20, "released, it falls");
    assert.deepEqual(page.faults, []);
    await page.close();
    child.kill();
  });

  test(`${scene}: a click adds a body of the shape chosen`, async () => {
    const { url, child } = await serve(scene, "--pace", "8", "--set", `source[0].count=${count}`, ...endless);
    const page = await openPage(url);
    await until(page, ({ asleep }) => asleep === count, 60); // before, an impact may wake all again
    const body = await highest(page);
    assert.ok(await page.isHidden("#shape"));
    await page.click("[data-tool=add]");
    assert.deepEqual(await page.locator("#shape option").allTextContents(), await page.evaluate(() => window.talus.timeline.head.shapes.map(({ name }) => name)));
    const before = await shown(page);
    await page.mouse.click(body.x, body.y);
    await until(page, ({ bodies }) => bodies === before.bodies + 1);
    const height = (i) => page.evaluate((k) => window.talus.stage.placeOf(k).y, i);
    assert.ok((await height(before.bodies)) < (await height(body.number)), "it appears above the body clicked");
    assert.equal(await page.textContent("#errors"), "");
    assert.deepEqual(page.faults, []);
    await page.close();
    child.kill();
  });
}
