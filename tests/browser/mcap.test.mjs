// `talus export --mcap` read by the format's own reader, with the types that the file describes.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { test } from "node:test";
import { awakeBySteps, talus, temporaryFolder } from "./browser.mjs";

const require = createRequire(new URL("../../tools/view/page/package.json", import.meta.url));
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const protobuf = require("protobufjs");
require("protobufjs/ext/descriptor");

const folder = temporaryFolder();

/// A file in memory as the reader needs it.
const readable = (bytes) => ({ size: async () => BigInt(bytes.length), read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)) });

/// All types of the file read last.
let types;

async function read(file, options = {}) {
  const reader = await McapIndexedReader.Initialize({ readable: readable(readFileSync(file)) });
  for (const schema of reader.schemasById.values()) {
    assert.equal(schema.encoding, "protobuf");
    types = protobuf.Root.fromDescriptor(protobuf.descriptor.FileDescriptorSet.decode(schema.data));
  }
  const messages = [];
  for await (const message of reader.readMessages({ validateCrcs: true, ...options })) {
    const { topic, schemaId } = reader.channelsById.get(message.channelId);
    const type = types.lookupType(reader.schemasById.get(schemaId).name);
    messages.push({ topic, time: Number(message.logTime) / 1e9, data: type.toObject(type.decode(message.data), { defaults: true, longs: Number }) });
  }
  return { reader, messages };
}

for (const scene of ["drop_in_a_pile_2d", "drop_in_a_pile_3d"]) {
  const run = join(folder, scene);
  const file = `${run}.mcap`;

  test(`${scene}: the reader of the format reads all messages, and their checksums hold`, async () => {
    talus("run", scene, "--no-telemetry", "--out", run, "--set", "run.frames=300");
    talus("export", run, "--mcap", file);
    const { reader, messages } = await read(file);
    assert.equal(messages.length, Number(reader.statistics.messageCount));
    const stream = new McapStreamReader({ validateCrcs: true });
    stream.append(readFileSync(file));
    const kinds = [];
    for (let record; (record = stream.nextRecord()); ) kinds.push(record.type);
    assert.ok(stream.done());
    assert.equal(kinds.filter((kind) => kind === "Message").length, messages.length);
  });

  test(`${scene}: counts are those of the run, and the bodies drawn are as many`, async () => {
    const { messages } = await read(file);
    const steps = awakeBySteps(run);
    const of = (topic) => messages.filter((message) => message.topic === topic);
    assert.equal(of("/counts").length, 300);
    for (const { time, data } of of("/counts")) {
      const { awake, bodies } = steps.get(Math.round(time * 60));
      assert.deepEqual([data.awake, data.awake + data.asleep], [awake, bodies]);
    }
    const shown = new Map();
    const places = new Map();
    for (const { data } of of("/bodies")) for (const entity of data.entities) shown.set(entity.id, entity);
    for (const { data } of of("/tf")) for (const transform of data.transforms) places.set(transform.child_frame_id, transform);
    assert.equal(shown.size, steps.get(600).bodies);
    for (const { frame_id: frameId, triangles } of shown.values()) {
      const { translation, rotation } = places.get(frameId);
      assert.ok(translation.z > -0.5 && translation.z < 100);
      assert.ok(Math.abs(Math.hypot(rotation.x, rotation.y, rotation.z, rotation.w) - 1) < 1e-3);
      for (const { points, indices } of triangles) assert.ok(points.length >= 6 && indices.every((index) => index < points.length) && indices.length % 3 === 0);
    }
    assert.ok(of("/sleep").some(({ data }) => data.events.some(({ woke, cause }) => !woke && cause === "rest")));
    const [pile] = of("/layers").at(-1).data.entities;
    assert.equal(pile.frame_id, "world");
    assert.ok(pile.cubes.length + pile.cylinders.length > 0);
  });

  test(`${scene}: every second has a message of all bodies, to begin at`, async () => {
    const { messages } = await read(file, { topics: ["/bodies"], startTime: 5_000_000_000n });
    const steps = awakeBySteps(run);
    const whole = messages.filter(({ time, data }) => data.entities.length === steps.get(Math.round(time * 60)).bodies);
    assert.ok(whole.length >= 5, `${whole.length} of five seconds`);
  });
}

test("each field of our own messages is documented", () => {
  const page = readFileSync(new URL("../../docs/files.md", import.meta.url), "utf8");
  const documented = (type) => [...page.split(`| field of \`${type}\` |`)[1].split("\n\n")[0].matchAll(/^\| `(\w+)`/gm)].map((row) => row[1]);
  assert.ok(types, "a file has been read");
  for (const type of ["talus.Counts", "talus.SleepEvent"]) assert.deepEqual(documented(type), types.lookupType(type).fieldsArray.map(({ name }) => name));
});
