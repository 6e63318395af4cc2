// The switch for contacts, and what is said of those shown.

import { type Contact, Contacts } from "./contacts";
import type { Head } from "./head";
import { element } from "./element";
import { withUnit } from "./scale";
import type { Stage } from "./stage";

export class ContactPanel {
  private contacts: Contacts;
  private simulates = false;

  constructor(head: Head) {
    this.contacts = new Contacts(head);
  }

  /// Of a simulation that takes commands; `ask`: for contacts, or for none any more; `changed`: to draw what is wanted.
  listen(ask: (wanted: boolean) => void, changed: () => void): void {
    this.simulates = true;
    const box = element<HTMLInputElement>("contacts");
    box.disabled = false;
    box.addEventListener("change", () => {
      ask(box.checked);
      changed();
    });
    this.note(null, 0, 0);
  }

  /// Another run.
  replace(head: Head): void {
    this.contacts = new Contacts(head);
  }

  private wanted(): boolean {
    return element<HTMLInputElement>("contacts").checked;
  }

  /// Contacts that came with a frame; no bytes: it has none.
  add(frame: number, bytes: Uint8Array): void {
    if (bytes.length > 0) this.contacts.add(frame, bytes);
  }

  /// Of a frame, where they are shown; else null.
  of(frame: number): Contact[] | null {
    return this.wanted() ? this.contacts.of(frame) : null;
  }

  show(frame: number, stage: Stage): void {
    if (!this.simulates) return;
    const contacts = this.of(frame);
    const { force, length } = stage.showContacts(contacts ?? []);
    this.note(contacts, force, length);
  }

  private note(contacts: Contact[] | null, force: number, length: number): void {
    const text = element("contact-note");
    if (!this.wanted()) text.textContent = "Off, they are not computed for the page.";
    else if (!contacts) text.textContent = "This frame came without contacts: the next step has them.";
    else {
      const kept = contacts.filter((contact) => contact.kept).length;
      const bar = contacts.length > 0 ? `; a bar of ${length.toPrecision(3)} m: ${withUnit(force, "N")}` : "";
      text.textContent = `${contacts.length} points with a force, ${kept} between sleeping bodies, as it was before they slept${bar}`;
    }
  }
}
