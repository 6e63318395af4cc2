// Builds dist/vendor.js (three.js and uPlot: changes with their versions only), dist/page.html (all of our own) and
// dist/pair.html (two of these pages side by side), and writes the checksums of sources and results, which a test compares (tests/house/built_page_is_of_its_sources.sh).
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

const ownStyle = readFileSync(join(root, "src/style.css"), "utf8");
const style = readFileSync(join(root, "node_modules/uplot/dist/uPlot.min.css"), "utf8") + ownStyle;

/// src/NAME.html with its style and the script that NAME begins with.
async function page(name, entry, css) {
  const code = await script(entry, "talusPage", false);
  return readFileSync(join(root, "src", `${name}.html`), "utf8")
    .replace("<!-- style -->", () => `<style>\n${css}</style>`)
    .replace("<!-- script -->", () => `<script>\n${code}</script>`);
}

const licence = (name) => `/*! ${name}\n${readFileSync(join(root, "node_modules", name, "LICENSE"), "utf8")}*/\n`;

mkdirSync(dist, { recursive: true });
writeFileSync(join(dist, "vendor.js"), licence("three") + licence("uplot") + (await script("vendor.ts", vendorName, "esbuild")));
writeFileSync(join(dist, "page.html"), await page("page", "main.ts", style));
writeFileSync(join(dist, "pair.html"), await page("pair", "pair.ts", ownStyle));

const sources = ["build.mjs", "package-lock.json", "package.json", "tsconfig.json", ...readdirSync(join(root, "src")).map((name) => `src/${name}`)];
const checksum = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");
const lines = [
  ...["dist/page.html", "dist/pair.html", "dist/vendor.js"].map((name) => `${checksum(join(dist, name.slice(5)))}  ${name}`),
  ...sources.sort().map((name) => `${checksum(join(root, name))}  ${name}`),
];
writeFileSync(join(dist, "checksums.sha256"), `${lines.join("\n")}\n`);
