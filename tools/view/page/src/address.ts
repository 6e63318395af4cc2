// What the page shows, in the fragment of its address: a page that is loaded again or opened elsewhere shows the same.

const mostOften = 400; // [ms] between two changes of the address: browsers refuse more than some a second

/// `t`: time [s], none: the newest; `camera`; `colours`; `body`; `panels`: that are folded, or open, otherwise than usual; `plots`: those shown; `layers`, `contacts`.
export type View = Partial<Record<"t" | "camera" | "colours" | "body" | "panels" | "plots" | "layers" | "contacts", string>>;

export const viewOfAddress = (): View => Object.fromEntries(new URLSearchParams(location.hash.slice(1))) as View;

/// Keeps the address what `view` says.
export function keepAddress(view: () => View): void {
  setInterval(() => {
    const hash = Object.entries(view()).map(([name, value]) => `${name}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
    if (hash !== location.hash.slice(1)) history.replaceState(null, "", `${location.pathname}${location.search}${hash ? `#${hash}` : ""}`);
  }, mostOften);
}
