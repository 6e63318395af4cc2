// Builds dist/vendor.js (three.js and uPlot: changes with their versions only), dist/editor.js (CodeMirror and what we make
// of it), dist/page.html (all else of our own) and dist/pair.html (two of these pages side by side), and writes the checksums of sources and results, which a test compares (tests/house/built_page_is_of_its_sources.sh).
import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "vite";

const root = import.meta.dirname;
const dist = process.argv[2] ?? join(root, "dist");
const vendorName = "talusVendor";

// One entry as a script that needs no module loader.
async function script(entry, name, minify) {
  const result = await build({
    root,
    configFile: false,
    logLevel: "warn",
    build: {
      write: false,
      target: "es2022",
      minify,
      lib: { entry: join(root, "src", entry), name, formats: ["iife"], fileName: "out" },
      rollupOptions: {
        external: (id) => entry !== "vendor.ts" && id.endsWith("/vendor"),
        output: { globals: () => vendorName },
      },
    },
  });
  // The end tag of a script must not occur within it.
  return result[0].output[0].code.replaceAll("</script", "<\\/script");
}

const source = (name) => readFileSync(join(root, "src", name), "utf8");
const style = readFileSync(join(root, "node_modules/uplot/dist/uPlot.min.css"), "utf8") + source("style.css");

/// src/NAME.html with its style, its icons and the script that NAME begins with.
async function page(name, entry) {
  const code = await script(entry, "talusPage", false);
  return source(`${name}.html`)
    .replace("<!-- style -->", () => `<style>\n${style}</style>`)
    .replace("<!-- icons -->", () => source("icons.html"))
    .replace("<!-- script -->", () => `<script>\n${code}</script>`);
}

const licence = (name) => `/*! ${name}\n${readFileSync(join(root, "node_modules", name, "LICENSE"), "utf8")}*/\n`;

mkdirSync(dist, { recursive: true });
writeFileSync(join(dist, "vendor.js"), licence("three") + licence("uplot") + (await script("vendor.ts", vendorName, "esbuild")));
const editorParts = ["autocomplete", "commands", "language", "legacy-modes", "lint", "state", "view"].map((name) => `@codemirror/${name}`);
writeFileSync(join(dist, "editor.js"), [...editorParts, "@lezer/highlight"].map(licence).join("") + (await script("editor.ts", "talusEditor", "esbuild")));
writeFileSync(join(dist, "page.html"), await page("page", "main.ts"));
writeFileSync(join(dist, "pair.html"), await page("pair", "pair.ts"));

const sources = ["build.mjs", "package-lock.json", "package.json", "tsconfig.json", ...readdirSync(join(root, "src")).map((name) => `src/${name}`)];
const checksum = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");
const lines = [
  ...["dist/editor.js", "dist/page.html", "dist/pair.html", "dist/vendor.js"].map((name) => `${checksum(join(dist, name.slice(5)))}  ${name}`),
  ...sources.sort().map((name) => `${checksum(join(root, name))}  ${name}`),
];
writeFileSync(join(dist, "checksums.sha256"), `${lines.join("\n")}\n`);
