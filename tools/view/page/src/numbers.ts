// Numbers in a scene's text, for sliders.

export interface SceneNumber {
  /// As "source[0].rate".
  path: string;
  value: number;
  /// The place of its digits in the text.
  begin: number;
  end: number;
}

/// All `key = number` of a scene's text, those within inline tables too.
export function numbersOf(text: string): SceneNumber[] {
  const numbers: SceneNumber[] = [];
  const lists = new Map<string, number>();
  let table = "";
  let at = 0;
  for (const line of text.split("\n")) {
    const code = line.replace(/"[^"]*"/g, (quoted) => "_".repeat(quoted.length)).replace(/#.*/, "");
    const header = /^\s*\[\[?\s*([\w.]+)\s*\]/.exec(code);
    if (header) {
      const [, name] = header;
      const list = code.trimStart().startsWith("[[");
      if (list) lists.set(name, (lists.get(name) ?? -1) + 1);
      table = list ? `${name}[${lists.get(name)}].` : `${name}.`;
    } else {
      const first = /^\s*([\w.]+)\s*=/.exec(code)?.[1] ?? "";
      for (const match of code.matchAll(/([\w.]+)\s*=\s*([-+]?(?:\d[\d_]*)(?:\.\d+)?(?:[eE][-+]?\d+)?)(?=\s*(?:[,}\]]|$))/g)) {
        const begin = at + match.index + match[0].length - match[2].length;
        const key = match[1] === first ? first : `${first}.${match[1]}`;
        numbers.push({ path: table + key, value: Number(match[2].replaceAll("_", "")), begin, end: begin + match[2].length });
      }
    }
    at += line.length + 1;
  }
  return numbers;
}

export const withNumber = (text: string, { begin, end }: SceneNumber, value: number): string => text.slice(0, begin) + String(value) + text.slice(end);

/// Where a slider begins and ends and its step: from 0 to twice the value; whole numbers stay whole.
export function rangeOf(value: number): { low: number; high: number; step: number } {
  const reach = value === 0 ? 1 : 2 * Math.abs(value);
  const step = Number.isInteger(value) && value !== 0 ? 1 : 10 ** Math.floor(Math.log10(reach / 100));
  return { low: value < 0 ? -reach : 0, high: value < 0 ? 0 : reach, step };
}
