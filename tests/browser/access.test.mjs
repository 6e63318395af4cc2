// What the server of `talus view` lets in.
import assert from "node:assert/strict";
import { networkInterfaces } from "node:os";
import { test } from "node:test";
import { serve, statusOf, upgrade } from "./browser.mjs";

const { url, token } = await serve("drop_in_a_pile_2d");
const origin = url.origin;
const page = (given) => new URL(`/?token=${given}`, url);
const stream = (given) => new URL(`/stream?token=${given}`, url);
const wrong = "0".repeat(token.length);

test("the token opens the page and the stream", async () => {
  assert.equal(await statusOf(page(token)), 200);
  assert.equal(await statusOf(stream(token), { ...upgrade, Origin: origin }), 101);
});

test("a wrong or missing token is refused", async () => {
  for (const address of [page(wrong), new URL("/", url), page(token.slice(1)), page(`${token}0`)]) assert.equal(await statusOf(address), 403);
  assert.notEqual(await statusOf(stream(wrong), { ...upgrade, Origin: origin }), 101);
});

test("a page of another origin is refused, with the token too", async () => {
  for (const Origin of ["http://example.com", "null", `${origin}1`, origin.replace("http", "https")]) {
    assert.notEqual(await statusOf(stream(token), { ...upgrade, Origin }), 101, Origin);
    assert.equal(await statusOf(page(token), { Origin }), 403, Origin);
  }
});

test("a name that was turned to this machine is refused", async () => {
  assert.equal(await statusOf(page(token), { Host: `example.com:${url.port}` }), 403);
  assert.notEqual(await statusOf(stream(token), { ...upgrade, Host: `example.com:${url.port}`, Origin: `http://example.com:${url.port}` }), 101);
});

test("nothing else is served", async () => {
  for (const path of ["/record", "/etc/passwd", "/../dev", "/page.html"]) assert.ok((await statusOf(new URL(`${path}?token=${token}`, url))) >= 400, path);
});

test("only the loopback interface listens", async () => {
  const others = Object.values(networkInterfaces()).flat().filter(({ internal, family }) => !internal && family === "IPv4");
  for (const { address } of others) await assert.rejects(statusOf(`http://${address}:${url.port}/?token=${token}`), address);
});

test("another interface listens where it is named, and only under its own address", async () => {
  const { url: elsewhere, child } = await serve("drop_in_a_pile_2d", "--listen", "127.0.0.2");
  assert.equal(elsewhere.hostname, "127.0.0.2");
  assert.equal(await statusOf(elsewhere), 200);
  for (const host of ["localhost", "127.0.0.1", "example.com"]) assert.equal(await statusOf(elsewhere, { Host: `${host}:${elsewhere.port}` }), 403, host);
  assert.equal(await statusOf(new URL("/", elsewhere)), 403, "without its token");
  child.kill();
});
