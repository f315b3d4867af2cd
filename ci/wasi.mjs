// Runs a WebAssembly program (wasm32-wasip1) in Node.js: node ci/wasi.mjs PROGRAM ARGUMENTS…
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";

const wasi = new WASI({
  version: "preview1",
  args: process.argv.slice(2),
  env: process.env,
  preopens: { "/": "/" },
  returnOnExit: true,
});
const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]), { wasi_snapshot_preview1: wasi.wasiImport });
// At once: Node.js 20 crashes when it clears up after a program that ran long.
process.exit(wasi.start(instance));
