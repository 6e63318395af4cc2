// The talus command and a browser for the tests beside this file. Environment: TALUS, the command; CHROMIUM, the browser.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import http from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after } from "node:test";
import { chromium } from "../../tools/view/page/node_modules/playwright-core/index.mjs";

const quiet = ["--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const software = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/// A folder that goes when the tests of a file have ended.
export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), "talus-browser-"));
  after(() => rmSync(folder, { recursive: true }));
  return folder;
}

/// Runs `talus ARGUMENTS` to its end; what it printed.
export function talus(...args) {
  const outcome = spawnSync(process.env.TALUS, args, { encoding: "utf8", maxBuffer: 64e6 });
  if (outcome.status !== 0) throw new Error(`talus ${args.join(" ")}: ${outcome.stderr}`);
  return outcome.stdout;
}

/// Starts `talus view ARGUMENTS`; resolves once it has printed its address.
export async function serve(...args) {
  const child = spawn(process.env.TALUS, ["view", ...args], { stdio: ["ignore", "pipe", "inherit"] });
  after(() => child.kill("SIGKILL"));
  for await (const line of createInterface({ input: child.stdout })) {
    const url = new URL(line);
    return { url, child, token: url.searchParams.get("token") };
  }
  throw new Error("talus view ended without an address");
}

let browser;
after(() => browser?.close());

/// A new page, of talus unless `talus` is false; what goes wrong in it is in `faults`.
export async function openPage(url, { offline = false, talus = true, viewport = { width: 900, height: 640 }, colorScheme = "light" } = {}) {
  browser ??= await chromium.launch({ executablePath: process.env.CHROMIUM, args: ["--no-sandbox", ...software, ...quiet] });
  const context = await browser.newContext({ viewport, offline, colorScheme });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  page.faults = [];
  page.on("pageerror", (error) => page.faults.push(error.message));
  page.on("console", (message) => message.type() === "error" && page.faults.push(message.text()));
  await page.goto(String(url));
  if (talus) await page.waitForFunction(() => window.talus !== undefined);
  return page;
}

export const shown = (page) => page.evaluate(() => window.talus.shown());

/// Share of the stage's pixels near each colour.
export async function colours(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.evaluate(() => {
    const source = document.getElementById("bodies");
    const canvas = Object.assign(document.createElement("canvas"), { width: source.width, height: source.height });
    const paper = canvas.getContext("2d");
    paper.drawImage(source, 0, 0);
    const { data } = paper.getImageData(0, 0, canvas.width, canvas.height);
    const share = { orange: 0, dark: 0, white: 0, contact: 0 };
    for (let i = 0; i < data.length; i += 4) {
      const [red, green, blue] = [data[i], data[i + 1], data[i + 2]];
      if (red > 1.4 * blue && red > green && red > 120) ++share.orange;
      else if (red < 90 && green < 90 && blue < 110) ++share.dark;
      else if (red > 250 && green > 250 && blue > 250) ++share.white;
      else if ((red > 180 && green < 120 && blue > 100) || (green > 150 && red < 140 && blue > 140 && green >= blue)) ++share.contact;
    }
    for (const name of Object.keys(share)) share[name] /= data.length / 4;
    return share;
  });
}

/// Awake bodies by step, from frames.csv of a run folder.
export function awakeBySteps(folder) {
  const [head, ...rows] = readFileSync(join(folder, "frames.csv"), "utf8").trim().split("\n");
  const columns = head.split(",");
  const [step, bodies, awake] = ["step", "bodies", "awake"].map((name) => columns.indexOf(name));
  return new Map(rows.map((row) => row.split(",")).map((cells) => [Number(cells[step]), { bodies: Number(cells[bodies]), awake: Number(cells[awake]) }]));
}

/// Status of an answer; 101: the connection is upgraded to a WebSocket, and stays open until the tests end.
export function statusOf(url, headers = {}) {
  return new Promise((done, failed) => {
    const request = http.request(url, { headers });
    request.on("response", (response) => done(response.resume().statusCode));
    request.on("upgrade", (response, socket) => {
      after(() => socket.destroy());
      done(response.statusCode);
    });
    request.on("error", (error) => (error.code === "ECONNRESET" ? done(0) : failed(error)));
    request.end();
  });
}

export const upgrade = { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==" };

/// Of a run that is paused: it lasts longer than the test, however slow the machine is.
export const endless = ["--set", "run.frames=20000", "--set", "run.until=frames"];

/// Pauses a run; resolves once the page shows where it stands.
export async function pause(page) {
  await page.click("#play");
  await page.waitForFunction(() => document.getElementById("speed").textContent === "paused");
  await page.waitForFunction(() => window.talus.shown().step >= window.talus.simulation.status.step);
  await page.waitForTimeout(500); // a step that the pause met half-way
}

/// Opens the panel with the scene's text.
export const openScene = (page) => page.evaluate(() => void (document.getElementById("scene").open = true));

/// The scene's text in the editor, and to write another one.
export const sceneText = (page) => page.evaluate(() => window.talus.simulation.editor.text);
export const writeScene = (page, text) => page.evaluate((written) => void (window.talus.simulation.editor.text = written), text);

/// Writes a scene into the editor and runs it.
export async function runScene(page, text) {
  await openScene(page);
  await writeScene(page, text);
  await page.click("#apply");
}

/// Waits until `holds` of what is shown, at most so many seconds.
export async function until(page, holds, seconds = 20) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const state = await shown(page);
    if (holds(state)) return state;
    if (Date.now() > end) throw new Error(`not within ${seconds} s; shown: ${JSON.stringify(state)}`);
    await page.waitForTimeout(50);
  }
}
