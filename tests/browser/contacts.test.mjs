// Contacts and their forces in the page.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { colours, endless, openPage, serve, talus, temporaryFolder, until } from "./browser.mjs";

/// As points, as force chains, and not.
async function drawEachWay(page) {
  await page.uncheck("#layers");
  assert.equal((await colours(page)).contact, 0);
  for (const [way, scale] of [["points", "a bar of"], ["chains", "a line"]]) {
    await page.selectOption("#contacts", way);
    await page.waitForFunction((text) => new RegExp(`^\\d{2,} points .* ${text} .*N$`).test(document.getElementById("contact-note").textContent), scale);
    let contact = 0; // of a run that goes on, in which bodies lie on each other more and more
    for (let tries = 0; tries < 20 && contact <= 2e-4; ++tries) ({ contact } = await colours(page));
    assert.ok(contact > 2e-4, `${way}, share of pixels: ${contact}`);
  }
  await page.selectOption("#contacts", "none");
  assert.equal((await colours(page)).contact, 0);
}

for (const [scene, ...options] of [["drop_in_a_pile_2d"], ["drop_in_a_pile_2d", "--backend", "bullet-planar"], ["drop_in_a_pile_3d"]]) {
  test(`${[scene, ...options].join(" ")}: contacts are drawn while they are wanted`, async () => {
    const { url, child } = await serve(scene, ...options, "--pace", "2", ...endless);
    const page = await openPage(url);
    await until(page, ({ bodies }) => bodies > 30, 60); // at this pace bodies still fall when a slow page is here
    assert.match(await page.textContent("#contact-note"), /not computed/);
    await drawEachWay(page);
    assert.deepEqual(page.faults, []);
    await page.close();
    child.kill();
  });
}

const folder = temporaryFolder();

async function openRecord(...options) {
  const run = join(folder, String(options.length));
  talus("run", "drop_in_a_pile_3d", "--no-telemetry", "--out", run, "--set", "run.frames=120", ...options);
  const { url } = await serve(run);
  const page = await openPage(url);
  await page.evaluate(() => (window.talus.pause(), window.talus.seek(119)));
  return page;
}

test("of a record whose run told them, contacts are drawn, and give bodies their colours", async () => {
  const page = await openRecord("--set", "run.contacts=true");
  await drawEachWay(page);
  await page.selectOption("#paint", "force");
  await page.waitForFunction(() => /[1-9]\d* *contact force/.test(document.getElementById("counts").textContent));
  assert.deepEqual(page.faults, []);
  await page.close();
});

test("of a record without contacts the page says so", async () => {
  const page = await openRecord();
  assert.ok(await page.isDisabled("#contacts"));
  assert.match(await page.textContent("#contact-note"), /^This run tells none/);
  await page.close();
});
