// Parts of the page.

export const element = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;
