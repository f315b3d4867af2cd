// How large pages are and how fast they are drawn here.
//
//     node measure.mjs LOG PAGE.html [LOG PAGE.html ...]

import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { basename, resolve } from "node:path";
import { open, rate } from "./page.mjs";

const dataOf = (html) => html.match(/<script type="text\/plain" id="data">([^<]*)</)[1].length;
const logBytes = (log) => readdirSync(log).filter((name) => name.endsWith(".npy")).reduce((sum, name) => sum + statSync(`${log}/${name}`).size, 0);

for (let i = 2; i + 1 < process.argv.length; i += 2) {
    const [log, file] = process.argv.slice(i, i + 2);
    const html = readFileSync(file, "utf8");
    const { frames } = JSON.parse(readFileSync(`${log}/run.json`, "utf8"));
    const { browser, page, complaints, seconds } = await open(`file://${resolve(file)}`);
    const shown = await page.evaluate(() => pong.frameCount);
    const drawn = await rate(page, 5);
    const triangles = await page.evaluate(() => pong.triangles());
    if (process.env.PICTURES) {
        await page.evaluate(() => { document.getElementById("to-peak").click(); document.activeElement.blur(); });
        await page.waitForTimeout(500);
        writeFileSync(`${process.env.PICTURES}/${basename(log)}.png`, await page.screenshot());
    }
    await browser.close();
    const whole = Buffer.byteLength(html), data = dataOf(html);
    console.log(`  ${basename(log)}: page ${whole} bytes, ${(data / frames).toFixed(1)} bytes of data per frame of the log (tables of the log: ${(logBytes(log) / frames).toFixed(1)}), ${whole - data} bytes for all else; ${shown} of ${frames} frames`);
    console.log(`    ready after ${seconds.toFixed(1)} s, ${drawn.toFixed(1)} pictures per second of ${triangles} triangles${complaints.length ? `; ${complaints[0]}` : ""}`);
    if (complaints.length) process.exitCode = 1;
}
