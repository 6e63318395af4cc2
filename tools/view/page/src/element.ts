// Parts of the page.

export const element = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;

/// Selects a pace in the list, which gets an entry for it where it has none.
export function showPace(list: HTMLSelectElement, pace: number): void {
  const value = String(pace);
  if (document.activeElement === list || list.value === value) return;
  if (![...list.options].some((option) => option.value === value)) list.append(new Option(`${value}x`, value));
  list.value = value;
}
