import { keepAddress, viewOfAddress } from "./address";
import { boxOf, headOf, type Settings } from "./head";
import { connect } from "./live";
import { LogReader } from "./messages";
import { MomentReader } from "./moments";
import { Player } from "./player";
import { Timeline } from "./timeline";

declare global {
  interface Window {
    /// For tests and for the console.
    talus?: Player;
  }
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> {
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

/// What is known of a record: all that its log has.
function timelineOf(log: Uint8Array, settings: Settings, name: string): Timeline {
  const events = new LogReader(log, settings);
  const reader = new MomentReader(settings);
  let timeline: Timeline | null = null;
  let undecodable = 0;
  for (let message = events.next(); message; message = events.next()) {
    try {
      const moment = reader.take(message);
      if (!moment || !reader.ready()) continue;
      timeline ??= new Timeline(headOf(reader, settings, name), settings);
      timeline.add(moment);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      ++undecodable;
    }
  }
  if (!timeline) throw new Error("the record holds no frame");
  if (events.damage + undecodable > 0) timeline.head.damage = `${events.damage} damaged bytes and ${undecodable} messages not decodable: frames may be missing`;
  const { shapes, coloured_shapes, obstacles } = headOf(reader, settings, name); // of a program's world some come later
  Object.assign(timeline.head, { shapes, coloured_shapes, obstacles });
  timeline.head.box = boxOf(timeline.head, timeline.newest);
  return timeline;
}

const dataOf = <Data>(id: string): Data => JSON.parse(document.getElementById(id)!.textContent) as Data;

/// A page that holds its record, else a page of the server.
async function start(): Promise<void> {
  document.body.classList.toggle("half", /^\/[ab]\/$/.test(location.pathname));
  const settings = dataOf<Settings>("settings");
  const { kind, name } = dataOf<{ kind: "run" | "record"; name: string }>("source");
  if (kind === "run") {
    connect(settings, begin);
    return;
  }
  const held = document.getElementById("log")?.textContent;
  const log = held ? await inflated(bytesOf(held)) : await (await fetch(`record${location.search}`)).arrayBuffer();
  const player = new Player(timelineOf(new Uint8Array(log), settings, name));
  player.grown();
  player.seek(0);
  begin(player);
  if (viewOfAddress().t === undefined) player.play();
}

/// Shows what the address says, which follows the user from now on; one of two pages side by side leaves both to that of both.
function begin(player: Player): void {
  window.talus = player;
  if (document.body.classList.contains("half")) return;
  player.restore(viewOfAddress());
  keepAddress(() => player.view());
}

start().catch((error: unknown) => {
  document.getElementById("status")!.textContent = `cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
});
