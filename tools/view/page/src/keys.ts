// Keys of the page, and the list of them that `?` shows.

import { element, make } from "./element";

export interface Key {
  key: string;
  /// As people call it.
  name?: string;
  does: string;
  action: () => void;
}

/// Whether typing goes elsewhere.
function typing(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  return event.ctrlKey || event.altKey || event.metaKey || target.isContentEditable || target.tagName === "SELECT" || (target as HTMLInputElement).type === "number";
}

export class Keys {
  private readonly help = element<HTMLDialogElement>("keys");

  constructor(
    private readonly keys: () => Key[],
    pages: Document[] = [document],
  ) {
    for (const page of pages) page.addEventListener("keydown", (event) => this.press(event));
    this.help.addEventListener("click", () => this.help.close());
  }

  private press(event: KeyboardEvent): void {
    if (typing(event)) return;
    if (event.key === "?") return this.toggle();
    const { action } = this.keys().find(({ key }) => key === event.key || key === event.key.toLowerCase()) ?? {};
    if (!action) return;
    event.preventDefault();
    action();
  }

  toggle(): void {
    if (this.help.open) return this.help.close();
    const rows = [...this.keys(), { key: "?", does: "this list" }] as Key[];
    this.help.querySelector("table")!.replaceChildren(...rows.map(({ key, name, does }) => make("tr", {}, make("td", {}, make("kbd", { textContent: name ?? key.toUpperCase() })), make("td", { textContent: does }))));
    this.help.showModal();
  }
}
