// The choice of how contacts are drawn, and what is said of those shown.

import { type ContactWay, lineWidth } from "./contact_marks";
import { type Contact, Contacts, type ContactsText, magnitude } from "./contacts";
import type { Head } from "./head";
import { element } from "./element";
import { withUnit } from "./scale";
import type { Stage } from "./stage";

export class ContactPanel {
  private contacts: Contacts;
  private simulates = false;
  /// Whether the colours of bodies are those of their forces.
  private coloured = false;
  private ask: (wanted: boolean) => void = () => undefined;

  constructor(head: Head) {
    this.contacts = new Contacts(head.dimension);
  }

  /// Of a simulation that takes commands; `ask`: for contacts, or for none any more; `changed`: to draw what is wanted.
  listen(ask: (wanted: boolean) => void, changed: () => void): void {
    this.simulates = true;
    this.ask = ask;
    element<HTMLSelectElement>("contacts").disabled = false;
    element("contacts").addEventListener("change", () => {
      ask(this.wanted());
      changed();
    });
    this.note(null, 0, 0);
  }

  /// Whether there can be any.
  get known(): boolean {
    return this.simulates;
  }

  /// Another run.
  replace(head: Head): void {
    this.contacts = new Contacts(head.dimension);
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
    this.ask(this.wanted());
  }

  /// Contacts of a frame that is to come.
  add(text: ContactsText): void {
    this.contacts.add(text);
  }

  /// Sum of the normal forces on each body in the frame of a step [N]; null: not known.
  forces(step: number): Map<number, number> | null {
    const contacts = this.contacts.of(step);
    if (!contacts) return null;
    const forces = new Map<number, number>();
    for (const { a, b, normalForce } of contacts)
      for (const body of [a, b]) if (body >= 0) forces.set(body, (forces.get(body) ?? 0) + magnitude(normalForce));
    return forces;
  }

  /// Those of the frame of a step, where they are wanted.
  show(step: number, stage: Stage): void {
    if (!this.simulates) return;
    const contacts = this.wanted() ? this.contacts.of(step) : null;
    const { force, length } = stage.showContacts(this.way === "none" ? [] : (contacts ?? []), this.way);
    this.note(contacts, force, length);
  }

  private note(contacts: Contact[] | null, force: number, length: number): void {
    const text = element("contact-note");
    if (!this.wanted()) text.textContent = "Off, they are not computed for the page.";
    else if (!contacts) text.textContent = "This frame came without contacts: the next step has them.";
    else {
      const kept = contacts.filter((contact) => contact.kept).length;
      const scale = this.way === "chains" ? `; a line ${(lineWidth * length).toPrecision(2)} m wide: ${withUnit(force, "N")}` : `; a bar of ${length.toPrecision(3)} m: ${withUnit(force, "N")}`;
      text.textContent = `${contacts.length} points with a force, ${kept} between sleeping bodies, as it was before they slept${contacts.length > 0 && this.way !== "none" ? scale : ""}`;
    }
  }
}
