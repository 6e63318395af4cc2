// What the pointer does to the bodies of a simulation: it throws, pulls or adds them, and cuts walls away.

import { element } from "./element";
import type { Stage } from "./stage";

const throwRate = 4; // [1/s] speed of a throw over the length of the drag

/// What the tools act upon.
export interface Hands {
  stage(): Stage;
  /// Whether the simulation takes commands.
  steered(): boolean;
  command(command: object): void;
  select(body: number): void;
}

type Place = [number, number];

export class PointerTools {
  private thrown: { body: number; from: Place } | null = null;
  private pulled: { body: number; point: number[]; grabbed: number[]; to: Place } | null = null;
  private moved = false;
  private tool = "camera";

  constructor(private readonly hands: Hands) {
    const area = element("stage");
    // Before the camera takes the event.
    area.addEventListener("pointerdown", (event) => this.press(event), true);
    const placeOf = ({ clientX, clientY }: PointerEvent): Place => {
      const { left, top } = area.getBoundingClientRect();
      return [clientX - left, clientY - top];
    };
    area.addEventListener("pointermove", (event) => this.move(placeOf(event)));
    window.addEventListener("pointerup", (event) => this.letGo(placeOf(event)));
    window.addEventListener("pointercancel", () => this.release());
    window.addEventListener("blur", () => this.release());
    for (const button of this.buttons) button.addEventListener("click", () => this.choose(button.dataset.tool!));
  }

  private get buttons(): NodeListOf<HTMLElement> {
    return document.querySelectorAll<HTMLElement>("[data-tool]");
  }

  /// camera, pull, add or cut.
  choose(tool: string): void {
    this.tool = tool;
    for (const button of this.buttons) button.setAttribute("aria-checked", String(button.dataset.tool === tool));
    element("shape").hidden = tool !== "add";
  }

  /// Those that can be added.
  setShapes(names: string[]): void {
    element("shape").replaceChildren(...names.map((name) => new Option(name)));
  }

  /// A click that is no drag; whether a tool has taken it.
  click(x: number, y: number): boolean {
    if (!this.hands.steered()) return false;
    if (this.tool === "cut") {
      const obstacle = this.hands.stage().obstacleAt(x, y);
      if (obstacle >= 0) this.hands.command({ do: "cut", obstacle });
      return true;
    }
    if (this.tool !== "add") return false;
    const position = this.hands.stage().placeAt(x, y);
    if (position) this.hands.command({ do: "add", shape: element<HTMLSelectElement>("shape").value, position });
    return true;
  }

  private press(event: PointerEvent): void {
    const throws = event.shiftKey;
    if (event.button !== 0 || (event.target as HTMLElement).id !== "bodies" || !this.hands.steered() || !(throws || this.tool === "pull")) return;
    const at: Place = [event.offsetX, event.offsetY];
    const stage = this.hands.stage();
    const grab = stage.grabAt(...at);
    if (!grab) return;
    event.stopPropagation();
    this.hands.select(grab.body);
    if (throws) {
      this.thrown = { body: grab.body, from: at };
      return;
    }
    stage.follows = false;
    this.pulled = { ...grab, to: at };
    this.moved = true;
    this.pull();
  }

  private move(to: Place): void {
    const stage = this.hands.stage();
    if (this.thrown) stage.arrow = [...this.thrown.from, ...to];
    if (this.pulled) {
      this.pulled.to = to;
      this.moved = true;
    }
    if (this.thrown || this.pulled) stage.redraw();
  }

  /// Sends where to, at most once for each picture of the browser.
  private pull(): void {
    if (!this.pulled) return;
    const { body, point, grabbed, to } = this.pulled;
    const stage = this.hands.stage();
    if (this.moved) this.hands.command({ do: "pull", body, point, to: stage.across(grabbed, ...to) });
    this.moved = false;
    stage.tether = { body, point, to };
    requestAnimationFrame(() => this.pull());
  }

  private release(): void {
    if (this.pulled) this.hands.command({ do: "release" });
    this.pulled = this.thrown = null;
    const stage = this.hands.stage();
    stage.arrow = stage.tether = null;
    stage.redraw();
  }

  private letGo(to: Place): void {
    if (!this.thrown && !this.pulled) return;
    if (this.thrown) {
      const { body, from } = this.thrown;
      const velocity = this.hands.stage().inWorld(body, to[0] - from[0], to[1] - from[1]).map((way) => throwRate * way);
      this.hands.command({ do: "kick", body, velocity });
    }
    this.release();
  }
}
