// Parts of the page.

export const element = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;

/// A new element with these properties and children.
export function make<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, properties: Partial<HTMLElementTagNameMap[Tag]>, ...children: (Node | string)[]): HTMLElementTagNameMap[Tag] {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

export const onClick = (id: string, action: () => void): void => element(id).addEventListener("click", action);

/// Selects a pace in the list, which gets an entry for it where it has none.
export function showPace(list: HTMLSelectElement, pace: number): void {
  const value = String(pace);
  if (document.activeElement === list || list.value === value) return;
  if (![...list.options].some((option) => option.value === value)) list.append(new Option(`${value}\u00d7`, value));
  list.value = value;
}

/// Times real time; 0: as fast as possible, which only a simulation can be.
export const paces = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];
export const simulationPaces = [...paces, 64, 0];

export function offerPaces(list: HTMLSelectElement, paces: number[]): void {
  list.replaceChildren(...paces.map((pace) => new Option(pace === 0 ? "fastest" : `${pace}\u00d7`, String(pace), false, pace === 1)));
}

/// Whether a button that plays or pauses shows that something goes on.
export function showGoing(button: HTMLElement, going: boolean): void {
  button.classList.toggle("going", going);
  button.setAttribute("aria-label", going ? "Pause" : "Play");
}

/// Lets the user drag an edge; `moved`: where the pointer is [CSS pixels]. A double click gives back the usual size.
export function draggable(edge: HTMLElement, moved: (x: number, y: number) => void, usual: () => void): void {
  edge.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    edge.setPointerCapture(event.pointerId);
  });
  edge.addEventListener("pointermove", (event) => edge.hasPointerCapture(event.pointerId) && moved(event.clientX, event.clientY));
  edge.addEventListener("dblclick", usual);
}

/// Lets the user drag the upper edge of the plots.
export function dragPlots(): void {
  const plots = element("plots");
  draggable(
    element("plots-edge"),
    (_, y) => (plots.style.height = `${Math.max(40, plots.getBoundingClientRect().bottom - y)}px`),
    () => (plots.style.height = ""),
  );
}

/// Gives the user a file.
export function download(name: string, content: Blob): void {
  const link = make("a", { href: URL.createObjectURL(content), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000); // a browser reads the file some time later
}
