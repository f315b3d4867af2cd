// A page in a headless browser, and its picture as numbers.

import { chromium } from "playwright-core";

const ARGUMENTS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
const SIZE = { width: 1400, height: 860 };

/** Opens a page; `complaints` gathers whatever a clean page does not do. */
export async function open(url, options = {}) {
    const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
    const browser = await chromium.launch({ executablePath, args: ARGUMENTS });
    const page = await browser.newPage({ viewport: SIZE, colorScheme: "dark", ...options });
    const complaints = [];
    page.on("console", (message) => complaints.push(`console ${message.type()}: ${message.text().slice(0, 300)}`));
    page.on("pageerror", (error) => complaints.push(`error: ${error.stack.slice(0, 800)}`));
    page.on("request", (request) => {
        const address = request.url();
        if (address !== url && !/^(data|blob):/.test(address)) complaints.push(`request: ${address}`);
    });
    const begin = performance.now();
    await page.goto(url);
    await page.waitForFunction(() => window.pong, null, { timeout: 120_000 }).catch(async (error) => {
        throw new Error([`the page does not come up: ${await page.textContent("#wait")}`, ...complaints, error].join("\n"));
    });
    // Ready is what has been drawn.
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    return { browser, page, complaints, seconds: (performance.now() - begin) / 1000 };
}

/** Pictures per second while the run plays from its start. */
export async function rate(page, seconds = 3) {
    const count = () => page.evaluate(() => [pong.picturesDrawn(), performance.now()]);
    await page.evaluate(() => { pong.seekFrame(0); pong.play(); });
    const [before] = [await count(), await page.waitForTimeout(1000 * seconds)];
    const after = await count();
    await page.evaluate(() => pong.pause());
    return ((after[0] - before[0]) / (after[1] - before[1])) * 1000;
}

/** The picture of the run alone, as `{ width, height, at(x, y) }`; bars and labels over it are left out. */
export async function pixels(page) {
    const bars = "#tools, #legend, #label { visibility: hidden }";
    const png = await page.locator("#view").screenshot({ style: bars });
    const { width, height, text } = await page.evaluate(decode, png.toString("base64"));
    const data = Buffer.from(text, "latin1");
    return { png, width, height, at: (x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)] };
}

async function decode(base64) {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
    return { width: image.width, height: image.height, text };
}

const RIM = 2;
const far = (a, b) => Math.max(...a.map((x, i) => Math.abs(x - b[i])));

/** Centre and number of the pixels that are not background; at the rim the page around it may show. */
export function drawn(picture) {
    const background = picture.at(2, 2);
    let [count, x, y] = [0, 0, 0];
    for (let row = RIM; row < picture.height - RIM; row++) {
        for (let column = RIM; column < picture.width - RIM; column++) {
            if (far(picture.at(column, row), background) > 12) [count, x, y] = [count + 1, x + column, y + row];
        }
    }
    return { count, center: [x / count, y / count] };
}

/** Number of pixels that differ between two pictures of one size. */
export function differing(a, b) {
    let count = 0;
    for (let row = RIM; row < a.height - RIM; row++) {
        for (let column = RIM; column < a.width - RIM; column++) count += far(a.at(column, row), b.at(column, row)) > 12;
    }
    return count;
}

/** Whether a colour is found within some pixels of a place. */
export function hasColor(picture, [x, y], color, reach = 8) {
    for (let row = Math.max(0, Math.round(y) - reach); row <= Math.min(picture.height - 1, y + reach); row++) {
        for (let column = Math.max(0, Math.round(x) - reach); column <= Math.min(picture.width - 1, x + reach); column++) {
            if (far(picture.at(column, row), color) < 24) return true;
        }
    }
    return false;
}
