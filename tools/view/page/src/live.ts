// A run that goes on: its messages come over a WebSocket, commands go back (tools/serve/run_loop.h).

import type { Account } from "./body_panel";
import type { Editor } from "./editor";
import { download, element, make, onClick, showPace } from "./element";
import { type Box, boxOf, headOf, obstaclesOf, type Settings } from "./head";
import { LogReader } from "./messages";
import { type Moment, MomentReader } from "./moments";
import { numbersOf, rangeOf, withNumber, type SceneNumber } from "./numbers";
import { Player, type Simulation } from "./player";
import { Timeline } from "./timeline";

interface Status {
  kind: "status";
  running: boolean;
  finished: boolean;
  at_rest?: boolean; // and finished since the world came to rest
  reason: string;
  pace: number;
  policy: string;
  policies: string[];
  step: number; // of the run
  ms_per_step: number;
  mean_ms_per_step: number;
  real_time_factor: number;
  live?: boolean; // a run of another process, which takes no commands
  // Of such a run:
  channels?: [string, number, number][]; // name, messages that came, messages lost
  undecodable?: number; // messages of all runs
  slept?: number; // times that a body fell asleep
  woken?: number;
}

/// At a line and column counted from 1; 0: at none.
export interface Fault {
  line: number;
  column: number;
  text: string;
}

/// A run begins; `box`: what is to be seen at first, none where the page sees to it.
type Begin = { kind: "begin"; box: Box | null };

/// The server left frames out: those that are left lie at most so many steps apart.
interface Thinned {
  kind: "thinned";
  steps: number;
  mebibytes: number;
}

type Message = Status | Begin | { kind: "scene"; text: string } | { kind: "errors"; of_text: boolean; errors: Fault[] } | Thinned | { kind: "saved"; name: string; text: string } | (Account & { kind: "body" });

declare global {
  interface Window {
    /// The script of the editor, which pages of runs have.
    talusEditor: { Editor: typeof Editor };
  }
}

/// Parts of the page that a run of another process has not.
const commands = ["scene", "by-hand", "restart", "steering"];

class Live implements Simulation {
  private player: Player | null = null;
  private status: Status | null = null;
  private behind = 0; // steps that the newest frame here lay behind the run when the last status came
  private readonly socket: WebSocket;

  private reader: MomentReader;
  private box: Box | null = null;
  /// Whether the player shows another run, since frames of this one have not come yet.
  private begun = false;
  /// Of this run, once frames were left out.
  private thinned: Thinned | null = null;
  /// Of the scene's text as it was sent last.
  private ofText: Fault[] = [];
  private form = 0;
  /// Of the scene's text.
  readonly editor: Editor;

  constructor(
    private readonly settings: Settings,
    private readonly ready: (player: Player) => void,
  ) {
    this.reader = new MomentReader(settings);
    this.editor = new window.talusEditor.Editor(element("text"), JSON.parse(element("keys-data").textContent) as [string, string][], {
      changed: () => this.listNumbers(),
      run: () => this.apply(),
    });
    this.socket = new WebSocket(`ws://${location.host}${location.pathname}stream${location.search}`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === "string") this.take(JSON.parse(event.data) as Message);
      else this.show(new Uint8Array(event.data));
    };
    this.socket.onclose = () => {
      element("status").textContent = "The server has gone, or has too many pages. What came can still be played.";
      for (const id of ["restart", "save", "apply", "policy"]) element<HTMLButtonElement>(id).disabled = true;
    };
    this.prepare();
  }

  private prepare(): void {
    for (const id of commands) element(id).hidden = false;
    onClick("save", () => this.send({ do: "save" }));
    onClick("apply", () => this.apply());
    element("policy").addEventListener("change", () => this.send({ do: "policy", value: element<HTMLSelectElement>("policy").value }));
    element("number").addEventListener("change", () => this.showNumber());
    element("slider").addEventListener("input", () => (element<HTMLInputElement>("value").value = element<HTMLInputElement>("slider").value));
    for (const id of ["slider", "value"]) element(id).addEventListener("change", () => this.setNumber(element<HTMLInputElement>(id).valueAsNumber));
  }

  send(command: object): void {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  private apply(): void {
    this.send({ do: "scene", text: this.editor.text });
  }

  private numbers: SceneNumber[] = [];

  /// The numbers that the text has now; the one chosen stays chosen.
  private listNumbers(): void {
    const list = element<HTMLSelectElement>("number");
    const chosen = list.value;
    this.numbers = numbersOf(this.editor.text).filter(({ path }) => path !== "dimension");
    list.replaceChildren(...this.numbers.map(({ path }) => new Option(path)));
    const first = this.numbers.find(({ path }) => /\bfriction$/.test(path)) ?? this.numbers.find(({ path }) => path.startsWith("source"));
    const kept = this.numbers.find(({ path }) => path === chosen) ?? first;
    if (kept) list.value = kept.path;
    this.showNumber();
  }

  private chosenNumber(): SceneNumber | undefined {
    return this.numbers[element<HTMLSelectElement>("number").selectedIndex];
  }

  private showNumber(): void {
    const number = this.chosenNumber();
    if (!number) return;
    const { low, high, step } = rangeOf(number.value);
    Object.assign(element<HTMLInputElement>("slider"), { min: String(low), max: String(high), step: String(step), value: String(number.value) });
    element<HTMLInputElement>("value").value = String(number.value);
  }

  /// Writes the number into the text and runs the scene.
  private setNumber(value: number): void {
    const number = this.chosenNumber();
    if (!number || Number.isNaN(value)) return;
    this.editor.text = withNumber(this.editor.text, number, value);
    this.apply();
  }

  private take(message: Message): void {
    switch (message.kind) {
      case "status":
        this.showStatus(message);
        break;
      case "begin":
        this.reader = new MomentReader(this.settings);
        this.box = message.box;
        this.begun = false;
        this.thinned = null;
        break;
      case "scene":
        this.editor.text = message.text;
        break;
      case "thinned":
        this.thinned = message;
        if (this.begun) this.player!.thin(message.steps, message.mebibytes);
        break;
      case "body":
        this.player?.takeAccount(message);
        break;
      case "saved":
        download(`${message.name}_step_${this.player?.shown().step ?? 0}.toml`, new Blob([message.text], { type: "application/toml" }));
        break;
      case "errors":
        if (message.of_text) this.markText(message.errors);
        this.listErrors(message.of_text ? message.errors : [...this.ofText, ...message.errors]);
    }
  }

  private begin(moment: Moment): void {
    const { reader } = this;
    const name = this.status?.live ? reader.id : reader.run!.scene;
    const timeline = new Timeline(headOf(reader, this.settings, name), this.settings);
    timeline.add(moment);
    timeline.head.box = this.box ?? boxOf(timeline.head, timeline.newest);
    this.form = reader.form;
    this.begun = true;
    if (this.player) {
      this.player.replace(timeline);
    } else {
      this.player = new Player(timeline);
      this.player.attach(this);
      if (this.steered()) this.player.steer();
      this.ready(this.player);
    }
    if (this.thinned) this.player.thin(this.thinned.steps, this.thinned.mebibytes);
    if (this.status) this.showStatus(this.status); // times in it are in steps of this run
  }

  private add(moment: Moment): void {
    if (!this.begun) return this.begin(moment);
    const { timeline, stage } = this.player!;
    timeline.add(moment);
    if (this.form === this.reader.form) return;
    this.form = this.reader.form;
    timeline.head.obstacles = obstaclesOf(this.reader);
    stage.surround();
  }

  /// Messages of frames: of all that this page lacks, or of as many as are sent at once. The next ones are sent once the
  /// last of these has been drawn.
  private show(bytes: Uint8Array): void {
    const events = new LogReader(bytes, this.settings);
    for (let message = events.next(); message; message = events.next()) {
      const moment = this.reader.take(message);
      if (moment && this.reader.ready()) this.add(moment);
    }
    this.player?.grown();
    const acknowledge = (): void => {
      if (this.socket.readyState === WebSocket.OPEN) this.socket.send("shown");
    };
    // A hidden page draws nothing.
    if (document.hidden) setTimeout(acknowledge, 200);
    else requestAnimationFrame(acknowledge);
  }

  private showStatus(status: Status): void {
    this.status = status;
    const steps = this.player?.timeline.step ?? [];
    this.behind = Math.max(0, status.step - (steps.at(-1) ?? 0));
    if (status.live) this.hideCommands();
    if (status.channels) showMessages(status.channels, status);
    const policies = element<HTMLSelectElement>("policy");
    if (policies.options.length === 0) policies.append(...status.policies.map((name) => new Option(name)));
    policies.value = status.policy;
    if (!status.live) showPace(element<HTMLSelectElement>("rate"), status.pace);
    const speed = `${status.ms_per_step.toFixed(2)} ms a step, ${status.real_time_factor.toPrecision(3)} x real time, this page ${this.behind} steps behind`;
    const time = (status.step * (this.player?.timeline.head.dt ?? 0)).toFixed(2);
    const end = status.at_rest ? `finished: all at rest after ${time} s` : "finished";
    element("speed").textContent = status.reason || (status.finished ? end : status.running ? speed : "paused");
    this.player?.showPlaying();
  }

  private hideCommands(): void {
    for (const id of commands) element(id).hidden = true;
  }

  private listErrors(errors: Fault[]): void {
    element("errors").replaceChildren(...errors.map(({ line, text }) => make("li", { textContent: text, onclick: () => this.editor.goTo(line) })));
    if (errors.length > 0) element<HTMLDetailsElement>("scene").open = true;
  }

  private markText(errors: Fault[]): void {
    this.ofText = errors;
    this.editor.mark(errors);
    const first = errors.find(({ line }) => line > 0);
    if (first) this.editor.goTo(first.line);
  }

  toggle(): void {
    this.send({ do: this.status?.running ? "pause" : "run" });
  }

  step(): void {
    this.send({ do: "step" });
  }

  restart(): void {
    this.send({ do: this.ended() ? "run" : "restart" });
  }

  steered(): boolean {
    return this.status !== null && !this.status.live;
  }

  running(): boolean {
    return (this.status?.running ?? false) && !this.ended();
  }

  ended(): boolean {
    return this.status !== null && (this.status.finished || this.status.reason !== "");
  }

  pace(): number {
    return this.status?.pace ?? 1;
  }

  msPerStep(): number {
    return this.status?.mean_ms_per_step ?? 0;
  }
}

/// What came of a run of another process, and what was lost.
function showMessages(channels: [string, number, number][], { undecodable = 0, slept = 0, woken = 0 }: Status): void {
  const section = element("messages");
  section.hidden = false;
  section.querySelector("table")!.replaceChildren(
    ...[["channel", "came", "lost"], ...channels].map((cells, row) => {
      const line = make("tr", {}, ...cells.map((text, i) => make(row > 0 ? "td" : "th", { textContent: String(text), className: i > 0 ? "count" : "" })));
      if (row > 0 && Number(cells[2]) > 0) line.lastElementChild!.classList.add("fault");
      return line;
    }),
  );
  const lost = channels.some(([, , count]) => count > 0);
  const lines = [`Bodies fell asleep ${slept} times and woke ${woken} times.`];
  if (undecodable > 0) lines.push(`${undecodable} messages could not be decoded.`);
  if (lost) lines.push("Against loss, as root: sysctl -w net.core.rmem_max=4194304");
  section.querySelector("p")!.textContent = lines.join(" ");
}

export function connect(settings: Settings, ready: (player: Player) => void): void {
  new Live(settings, ready);
}
