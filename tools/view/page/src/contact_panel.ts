// The choice of how contacts are drawn, and what is said of those shown.

import { type ContactWay, lineWidth } from "./contact_marks";
import { type Contact, magnitude } from "./contacts";
import { element } from "./element";
import type { State } from "./moments";
import { withUnit } from "./scale";
import type { Stage } from "./stage";

export class ContactPanel {
  /// Whether the colours of bodies are those of their forces.
  private coloured = false;
  /// Turns the contacts of a simulation on or off; null: it takes no commands.
  private request: ((wanted: boolean) => void) | null = null;

  constructor(changed: () => void) {
    element("contacts").addEventListener("change", () => {
      this.request?.(this.wanted());
      changed();
    });
  }

  /// Of a simulation that takes commands.
  steer(request: (wanted: boolean) => void): void {
    this.request = request;
    this.offer();
    this.note(null, 0, 0);
  }

  /// There are contacts, or can be.
  offer(): void {
    element<HTMLSelectElement>("contacts").disabled = false;
  }

  get offered(): boolean {
    return !element<HTMLSelectElement>("contacts").disabled;
  }

  private get way(): ContactWay {
    return element<HTMLSelectElement>("contacts").value as ContactWay;
  }

  private wanted(): boolean {
    return this.coloured || this.way !== "none";
  }

  colourBodies(coloured: boolean): void {
    if (this.coloured === coloured) return;
    this.coloured = coloured;
    this.request?.(this.wanted());
  }

  /// Sum of the normal forces on each body [N]; null: not known.
  forces(state: State): Map<number, number> | null {
    const contacts = state.contacts();
    if (!contacts) return null;
    const forces = new Map<number, number>();
    for (const { a, b, normalForce } of contacts)
      for (const body of [a, b]) if (body >= 0) forces.set(body, (forces.get(body) ?? 0) + magnitude(normalForce));
    return forces;
  }

  /// Those of the frame shown, where they are wanted.
  show(state: State, stage: Stage): void {
    if (!this.offered) return;
    const contacts = this.wanted() ? state.contacts() : null;
    const { force, length } = stage.showContacts(this.way === "none" ? [] : (contacts ?? []), this.way);
    this.note(contacts, force, length);
  }

  private note(contacts: Contact[] | null, force: number, length: number): void {
    const text = element("contact-note");
    if (!this.wanted()) text.textContent = this.request ? "Off, they are not computed for the page." : "";
    else if (!contacts) text.textContent = this.request ? "This frame came without contacts: the next step has them." : "This frame has none.";
    else {
      const kept = contacts.filter((contact) => contact.kept).length;
      const scale = this.way === "chains" ? `; a line ${(lineWidth * length).toPrecision(2)} m wide: ${withUnit(force, "N")}` : `; a bar of ${length.toPrecision(3)} m: ${withUnit(force, "N")}`;
      text.textContent = `${contacts.length} points with a force, ${kept} between sleeping bodies, kept since they fell asleep${contacts.length > 0 && this.way !== "none" ? scale : ""}`;
    }
  }
}
