// Contacts and their forces in the page.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { colours, endless, openPage, pause, serve, talus, temporaryFolder, until } from "./browser.mjs";

for (const [scene, ...options] of [["drop_in_a_pile_2d"], ["drop_in_a_pile_2d", "--backend", "bullet-planar"], ["drop_in_a_pile_3d"]]) {
  test(`${[scene, ...options].join(" ")}: contacts are drawn as points and as force chains, and taken away`, async () => {
    const { url, child } = await serve(scene, ...options, "--pace", "1", ...endless);
    const page = await openPage(url);
    await page.uncheck("#layers");
    await until(page, ({ bodies }) => bodies > 20, 60); // at this pace bodies still fall when a slow page is here
    assert.equal((await colours(page)).contact, 0);
    assert.match(await page.textContent("#contact-note"), /not computed/);
    await page.selectOption("#contacts", "points");
    await until(page, ({ awake }) => awake > 0); // while contacts are on: of bodies that slept before there are none
    await pause(page); // contacts come with the newest frame, so that a slow page has none of a run that goes on
    await page.waitForFunction(() => /^[1-9]\d* points .* a bar of .*N$/.test(document.getElementById("contact-note").textContent));
    const { contact } = await colours(page);
    assert.ok(contact > 2e-4, `share of pixels: ${contact}`);
    await page.selectOption("#contacts", "chains");
    await page.waitForFunction(() => /a line [\d.]+ m wide: .*N$/.test(document.getElementById("contact-note").textContent));
    assert.ok((await colours(page)).contact > 2e-4, "force chains are drawn");
    await page.selectOption("#contacts", "none");
    assert.equal((await colours(page)).contact, 0);
    assert.deepEqual(page.faults, []);
    await page.close();
    child.kill();
  });
}

test("of a record the page says that it has none", async () => {
  const folder = join(temporaryFolder(), "run");
  talus("run", "drop_in_a_pile_2d", "--no-telemetry", "--out", folder, "--set", "run.frames=60");
  const { url, child } = await serve(folder);
  const page = await openPage(url);
  assert.ok(await page.isDisabled("#contacts"));
  assert.match(await page.textContent("#contact-note"), /^Records .* have none/);
  await page.close();
  child.kill();
});
