import { inflate } from "./head";
import { connect } from "./live";
import { Player } from "./player";

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

/// A page that holds its record, else a page of the server: its address says what it shows.
async function start(): Promise<void> {
  document.body.classList.toggle("half", /^\/[ab]\/$/.test(location.pathname));
  const held = document.getElementById("stream")?.textContent;
  if (!held && JSON.parse(document.getElementById("source")!.textContent) === "run") {
    connect((player) => (window.talus = player));
    return;
  }
  const bytes = held ? bytesOf(held) : new Uint8Array(await (await fetch(`record${location.search}`)).arrayBuffer());
  const { head, blocks } = await inflate(bytes);
  const player = new Player(head);
  player.timeline.addAll(blocks);
  player.grown();
  player.seek(0);
  player.play();
  window.talus = player;
}

start().catch((error: unknown) => {
  document.getElementById("status")!.textContent = `cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
});
