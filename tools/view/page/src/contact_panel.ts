// The switch for contacts, and what is said of those shown.

import { type Contact, Contacts, type ContactsText } from "./contacts";
import type { Head } from "./head";
import { element } from "./element";
import { withUnit } from "./scale";
import type { Stage } from "./stage";

export class ContactPanel {
  private contacts: Contacts;
  private simulates = false;

  constructor(head: Head) {
    this.contacts = new Contacts(head.dimension);
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
    this.contacts = new Contacts(head.dimension);
  }

  private wanted(): boolean {
    return element<HTMLInputElement>("contacts").checked;
  }

  /// Contacts of a frame that is to come.
  add(text: ContactsText): void {
    this.contacts.add(text);
  }

  /// Those of the frame of a step, where they are wanted.
  show(step: number, stage: Stage): void {
    if (!this.simulates) return;
    const contacts = this.wanted() ? this.contacts.of(step) : null;
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
