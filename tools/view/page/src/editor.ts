// The editor of a scene's text, a script of its own: CodeMirror with the keys of a scene file.

import { acceptCompletion, autocompletion, type Completion, type CompletionContext, type CompletionResult, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap, lineNumbers, type Tooltip } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Fault } from "./live";

/// A row of a table of keys.
interface SceneKey {
  name: string;
  type: string;
  standard: string;
  range: string;
  meaning: string;
}

const plain = (markdown: string): string => markdown.replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/[`*]/g, "");

/// Of a table of `talus reference`.
function keysOf(table: string): SceneKey[] {
  const rows = table.split("\n").filter((line) => line.startsWith("| `"));
  return rows.map((row) => {
    const [name, type, standard, range, meaning] = row.slice(2, -2).split(" | ").map((cell) => plain(cell.trim()));
    return { name, type, standard, range, meaning };
  });
}

function describe({ name, type, standard, range, meaning }: SceneKey): HTMLElement {
  const box = document.createElement("div");
  box.className = "key";
  const facts = [type, range && `range ${range}`, standard && (standard === "required" ? standard : `default ${standard}`)].filter(Boolean).join("; ");
  for (const [tag, text] of [["b", name], ["span", facts], ["span", meaning]]) box.append(Object.assign(document.createElement(tag), { textContent: text }));
  return box;
}

/// What a place of the text belongs to: a table as `[[source]]`, and of inline tables the keys before: `[shape.NAME]`.
function tableAt(state: EditorState, position: number): string {
  let header = "root";
  for (let number = state.doc.lineAt(position).number; number >= 1; --number) {
    const found = /^\s*(\[\[?[^\]]+\]\]?)/.exec(state.doc.line(number).text);
    if (!found) continue;
    header = found[1].replace(/\s/g, "");
    break;
  }
  const line = state.doc.lineAt(position);
  const before = line.text.slice(0, position - line.from);
  const outer = /^\s*([\w.]+)\s*=\s*\{[^}]*$/.exec(before)?.[1];
  if (!outer) return header;
  return `[${header === "root" ? "" : `${header.replace(/[[\]]/g, "")}.`}${outer}]`;
}

const style = HighlightStyle.define([
  { tag: [tags.propertyName, tags.atom], color: "var(--accent)" },
  { tag: tags.comment, color: "var(--quiet)" },
  { tag: tags.string, color: "light-dark(#0a6b4f, #7bd3b2)" },
  { tag: tags.number, color: "light-dark(#9a4a00, #ffb875)" },
]);

const theme = EditorView.theme({
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--quiet)", border: "0" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--accent) 9%, transparent)" },
  ".cm-scroller": { fontFamily: 'ui-monospace, "DejaVu Sans Mono", monospace' },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "color-mix(in srgb, var(--accent) 30%, transparent) !important" },
  ".cm-tooltip": { backgroundColor: "var(--card)", color: "var(--text)", border: "1px solid var(--line)", borderRadius: "5px" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--paper)" },
  // The images that CodeMirror has for these are not what the page's content policy allows.
  ".cm-lint-marker": { content: "none", width: "9px", height: "9px", borderRadius: "50%", backgroundColor: "var(--fault)" },
  ".cm-lintRange-error": { backgroundImage: "none", textDecoration: "underline wavy var(--fault)" },
  ".key": { display: "grid", gap: "3px", maxWidth: "320px", padding: "5px 8px", font: "12px/1.4 system-ui, sans-serif", whiteSpace: "normal" },
});

export class Editor {
  private readonly view: EditorView;
  private readonly tables: Map<string, SceneKey[]>;

  /// `tables`: of the program's reference, by the name of the table of a scene file; `run`: to run the text.
  constructor(parent: HTMLElement, tables: [string, string][], on: { changed: () => void; run: () => void }) {
    this.tables = new Map(tables.map(([name, table]) => [name, keysOf(table)]));
    const run = (): boolean => (on.run(), true);
    this.view = new EditorView({
      parent,
      extensions: [
        lineNumbers(),
        highlightActiveLineGutter(),
        highlightActiveLine(),
        history(),
        drawSelection(),
        bracketMatching(),
        StreamLanguage.define(toml),
        syntaxHighlighting(style),
        lintGutter(),
        autocompletion({ override: [(context) => this.complete(context)], icons: false }),
        hoverTooltip((view, position) => this.hover(view, position)),
        keymap.of([{ key: "Ctrl-Enter", run }, { key: "Tab", run: acceptCompletion }, ...completionKeymap, ...defaultKeymap, ...historyKeymap, indentWithTab]),
        EditorView.contentAttributes.of({ "aria-label": "Text of the scene" }),
        EditorView.updateListener.of((update) => update.docChanged && on.changed()),
        theme,
      ],
    });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  set text(text: string) {
    if (text !== this.text) this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
  }

  /// Marks errors at their lines.
  mark(faults: Fault[]): void {
    const { doc } = this.view.state;
    const placed = faults.filter(({ line }) => line > 0 && line <= doc.lines);
    this.view.dispatch(
      setDiagnostics(
        this.view.state,
        placed.map(({ line, text }) => ({ from: doc.line(line).from, to: doc.line(line).to, severity: "error" as const, message: text })),
      ),
    );
  }

  /// Chooses a line and brings it into sight.
  goTo(line: number): void {
    const { doc } = this.view.state;
    if (line < 1 || line > doc.lines) return;
    const { from, to } = doc.line(line);
    this.view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
    this.view.focus();
  }

  /// Keys of a table, those of its kind with those of all kinds.
  private keysIn(table: string): SceneKey[] {
    const name = table.replace(/^(\[+shape\.)[^.\]]+/, "$1NAME");
    const inner = name.replace(/[[\]]/g, "");
    const known = [...this.tables].filter(([each]) => each.replace(/\].*/, "").replace(/\[/g, "") === inner);
    return [...new Map(known.flatMap(([, keys]) => keys).map((key) => [key.name, key])).values()];
  }

  private complete(context: CompletionContext): CompletionResult | null {
    const { state, pos } = context;
    const line = state.doc.lineAt(pos);
    const before = line.text.slice(0, pos - line.from);
    if (/^[^"]*#/.test(before)) return null;
    const header = /^\s*(\[\[?[\w.]*)$/.exec(before);
    if (header) return { from: pos - header[1].length, options: this.headers(), validFor: /^\[\[?[\w.]*$/ };
    const value = /(?:^|[{,])\s*([\w.]+)\s*=\s*("?)([\w-]*)$/.exec(before);
    if (value) return this.completeValue(context, value);
    const word = /(?:^\s*|[{,]\s*)([\w]*)$/.exec(before);
    if (!word || (word[1] === "" && !context.explicit)) return null;
    const options = this.keysIn(tableAt(state, pos)).map((key): Completion => ({ label: key.name, detail: key.type, type: "property", apply: `${key.name} = `, info: () => describe(key) }));
    return { from: pos - word[1].length, options, validFor: /^\w*$/ };
  }

  private headers(): Completion[] {
    const names = new Set([...this.tables.keys()].map((name) => name.replace(/\] .*/, "]").replace(/^(\[\[[^\]]+)\]$/, "$1]]")).filter((name) => name !== "root"));
    return [...names].map((label) => ({ label, type: "namespace" }));
  }

  /// Texts that a key may have.
  private completeValue({ state, pos, explicit }: CompletionContext, [, name, quote, typed]: RegExpExecArray): CompletionResult | null {
    const key = this.keysIn(tableAt(state, pos)).find((each) => each.name === name);
    const texts = [...(key?.range.matchAll(/"([^"]+)"/g) ?? [])].map(([, text]) => text);
    if (!key || texts.length === 0 || (quote === "" && typed === "" && !explicit)) return null;
    return { from: pos - typed.length - quote.length, options: texts.map((text) => ({ label: `"${text}"`, info: () => describe(key) })), validFor: /^"?[\w-]*$/ };
  }

  private hover(view: EditorView, position: number): Tooltip | null {
    const word = view.state.wordAt(position);
    if (!word) return null;
    const name = view.state.sliceDoc(word.from, word.to);
    const key = this.keysIn(tableAt(view.state, word.from)).find((each) => each.name === name);
    return key ? { pos: word.from, end: word.to, above: true, create: () => ({ dom: describe(key) }) } : null;
  }
}
