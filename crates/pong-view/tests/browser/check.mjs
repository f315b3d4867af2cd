// Opens the page of a log in a browser and compares what it shows with the tables of the log.
//
//     node check.mjs LOG PAGE.html [PICTURE.png]

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { differing, drawn, hasColor, open, pixels } from "./page.mjs";
import { readTable } from "./npy.mjs";

const STICK = [0x1f, 0xb6, 0xa3], SLIP = [0xf4, 0x62, 0x2e];
const [log, file, picture] = process.argv.slice(2);
const frames = readTable(`${log}/frames.npy`);
const states = readTable(`${log}/states.npy`);
const contacts = readTable(`${log}/contacts.npy`);
const { browser, page, complaints, seconds } = await open(`file://${resolve(file)}`);
const bodies = await page.evaluate(() => pong.bodies);
const stateOf = (frame, body) => states[frame * bodies.length + body];
const moved = bodies.map((_, body) => {
    const [first, last] = [stateOf(0, body), stateOf(frames.length - 1, body)].map((state) => state.position);
    return Math.hypot(...first.map((x, axis) => last[axis] - x));
});
const mover = moved.indexOf(Math.max(...moved));
const busiest = frames.reduce((best, frame, index) => (frame.contacts > frames[best].contacts ? index : best), 0);
const positions = () => page.evaluate(() => pong.bodies.map((body) => pong.position(body)));
const isNear = (a, b) => a.every((x, axis) => Math.abs(x - b[axis]) <= 1e-6 * Math.max(1, moved[mover]));

const isCell = ({ end }) => [4, 5].includes(end >>> 29);

const checks = {
    async "all frames are there, without a complaint"() {
        assert.equal(await page.evaluate(() => pong.frameCount), frames.length);
        assert.deepEqual(complaints, []);
    },

    async "the scrubber puts the bodies where the log has them"() {
        await page.focus("#scrubber");
        for (const [key, frame] of [["End", frames.length - 1], ["Home", 0], ["ArrowRight", 1]]) {
            await page.keyboard.press(key);
            const shown = await positions();
            bodies.forEach((name, body) => assert.ok(isNear(shown[body], stateOf(frame, body).position), `${name} ${shown}`));
        }
        const track = await page.locator("#scrubber").boundingBox();
        await page.mouse.click(track.x + track.width / 2, track.y + track.height / 2);
        const frame = await page.evaluate(() => pong.frame());
        assert.ok(Math.abs(frame - frames.length / 2) < 0.02 * frames.length, `frame ${frame}`);
        const shown = await positions();
        bodies.forEach((name, body) => assert.ok(isNear(shown[body], stateOf(frame, body).position), name));
    },

    async "the pixels move as the body does"() {
        const others = bodies.map((_, body) => body).filter((body) => body !== mover);
        const toggles = page.locator("#bodies input");
        const overlays = ["normals", "frictions", "highlight", ...(contacts.some(isCell) ? ["patches"] : [])];
        for (const body of others) await toggles.nth(body).uncheck();
        for (const id of overlays) await page.locator(`#${id}`).uncheck();
        const seen = [];
        for (const frame of [0, frames.length - 1]) {
            await page.evaluate(([frame, name]) => { pong.seekFrame(frame); pong.select(null); pong.pick(name); }, [frame, bodies[mover]]);
            const at = await page.evaluate((name) => pong.projected(name), bodies[mover]);
            seen.push({ at, ...drawn(await pixels(page)) });
        }
        for (const body of others) await toggles.nth(body).check();
        for (const id of overlays) await page.locator(`#${id}`).check();
        const way = (of) => [0, 1].map((axis) => seen[1][of][axis] - seen[0][of][axis]);
        const [expected, found] = [way("at"), way("center")];
        const off = Math.hypot(found[0] - expected[0], found[1] - expected[1]);
        assert.ok(seen[0].count > 50 && seen[1].count > 50, "hardly a pixel is drawn");
        assert.ok(off < 4 + 0.3 * Math.hypot(...expected), `${found} instead of ${expected}`);
    },

    async "contacts are listed, marked and have arrows"() {
        await page.evaluate((frame) => pong.seekFrame(frame), busiest);
        const { first_contact: first, contacts: count } = frames[busiest];
        const logged = contacts.slice(first, first + count);
        assert.ok(count > 0, "the run has no contact");
        assert.equal(await page.locator("#contacts tr").count(), Math.min(count, 200));
        assert.ok((await page.textContent("#contact-count")).startsWith(count.toLocaleString("en")));
        const strongest = Math.max(...logged.map((contact) => contact.normal_force));
        const listed = await page.locator("#contacts tr").first().locator("td").nth(2).textContent();
        assert.ok(Math.abs(Number(listed) - strongest) <= 1e-3 * strongest, `${listed} N instead of ${strongest} N`);
        const pushing = logged.filter((contact) => contact.normal_force > 0 && !isCell(contact));
        assert.ok((await page.evaluate(() => pong.arrows())) >= pushing.length);
        assert.ok((await page.evaluate(() => pong.highlighted())) > 0);
        const { key, sticks, at } = await page.evaluate(() => {
            const [contact] = [...pong.contacts()].sort((a, b) => b.normalForce - a.normalForce);
            // Cells of solids have a patch in place of a dot.
            const marked = contact.isCell ? pong.contacts().find((other) => other.isFriction) : contact;
            return { key: contact.key, sticks: marked.sticks, at: pong.project(marked.point) };
        });
        assert.ok(hasColor(await pixels(page), at, sticks ? STICK : SLIP), "no mark at the contact");
        await page.locator("#contacts tr").first().click();
        assert.equal(await page.locator("#contacts tr.picked").getAttribute("data-key"), key);
        await page.locator("#label").waitFor({ timeout: 10_000 });
    },

    async "cells of solids are patches with their area, force and pressure"() {
        await page.evaluate((frame) => { pong.seekFrame(frame); pong.select(null); }, busiest);
        const { first_contact: first, contacts: count } = frames[busiest];
        const cells = contacts.slice(first, first + count).filter((contact) => isCell(contact) && contact.weight > 0);
        const patches = await page.evaluate(() => pong.patches());
        assert.equal(await page.locator("#patches-legend").isVisible(), contacts.some(isCell));
        assert.equal(patches.reduce((sum, patch) => sum + patch.cells, 0), cells.length);
        assert.equal(new Set(await page.evaluate(() => pong.contacts().map((contact) => contact.key))).size, count);
        if (!cells.length) return;
        assert.ok(patches.length < cells.length, "cells of both fields at one face are one patch");
        for (const [ours, logged] of [["normalForce", "normal_force"], ["area", "weight"]]) {
            const [shown, sum] = [patches, cells].map((list, index) => list.reduce((sum, each) => sum + each[index ? logged : ours], 0));
            assert.ok(Math.abs(shown - sum) <= 1e-5 * sum, `${ours} ${shown} instead of ${sum}`);
        }
        const largest = patches.reduce((a, b) => (b.area > a.area ? b : a));
        assert.ok(Math.abs(largest.pressure - largest.normalForce / largest.area) <= 1e-6 * largest.pressure);
        assert.match(await page.textContent("#pressure-scale"), /^0 … [\d.]+ [kM]?Pa$/);
        const seen = [];
        for (const wanted of [true, false]) {
            await page.locator("#patches").setChecked(wanted);
            seen.push(await pixels(page));
        }
        await page.locator("#patches").check();
        assert.ok(differing(...seen) > 100, "no patch is drawn");
    },

    async "contacts are never made up between frames"() {
        const [a, b] = [busiest, Math.min(busiest + 1, frames.length - 1)];
        const found = await page.evaluate(([from, to]) => {
            pong.seek(0.3 * from + 0.7 * to);
            return [pong.frame(), JSON.stringify(pong.contacts())];
        }, [frames[a].time, frames[b].time]);
        const exact = await page.evaluate((frame) => (pong.seekFrame(frame), JSON.stringify(pong.contacts())), a);
        assert.deepEqual(found, [a, exact]);
    },

    async "a click in a plot shows that time"() {
        const time = frames[Math.round(0.7 * (frames.length - 1))].time;
        const x = await page.evaluate((time) => pong.xOfTime(time), time);
        const box = await page.locator("#plot").boundingBox();
        await page.mouse.click(box.x + x, box.y + box.height / 2);
        const off = Math.abs((await page.evaluate(() => pong.time())) - time);
        assert.ok(off <= (2 * (frames.at(-1).time - frames[0].time)) / box.width + (frames[1].time - frames[0].time), `${off} s off`);
    },

    async "space plays and pauses"() {
        await page.evaluate(() => pong.seekFrame(0));
        await page.focus("#picture");
        await page.keyboard.press("Space");
        // However slow the machine draws.
        await page.waitForFunction((start) => pong.time() > start, frames[0].time, { timeout: 30_000 });
        if (await page.evaluate(() => pong.isPlaying())) {
            await page.keyboard.press("Space");
        }
        assert.equal(await page.evaluate(() => pong.isPlaying()), false);
    },

    async "after a click on a button, a box or a choice Space still plays and pauses"() {
        const playing = () => page.evaluate(() => pong.isPlaying());
        const stand = async () => { if (await playing()) await page.evaluate(() => document.querySelector("#play").click()); };
        await page.evaluate(() => pong.seekFrame(0));
        const box = () => page.locator("#normals").isChecked();
        const before = await box();
        const choose = async () => {
            await page.locator("#side").dispatchEvent("pointerdown");
            await page.selectOption("#side", "front");
        };
        for (const press of [() => page.click("#play"), () => page.click("#first"), () => page.click("#normals"), choose]) {
            await stand();
            await press();
            if (await playing()) {
                await page.keyboard.press("Space");
                assert.equal(await playing(), false, "Space pressed the button again");
            }
            await page.keyboard.press("Space");
            assert.equal(await playing(), true, "Space does not play");
        }
        assert.equal(await box(), !before, "Space pressed the box again");
        await page.click("#normals");
        await stand();
        await page.locator("#normals").focus();
        await page.keyboard.press("Tab");
        await page.keyboard.press("Shift+Tab");
        await page.keyboard.press("Space");
        assert.equal(await box(), !before, "who walks by Tab presses with Space");
        await page.keyboard.press("Space");
        assert.equal(await playing(), false);
    },

    async "bodies differ in colour, and names stand as they are in the log"() {
        assert.equal(new Set(await page.evaluate(() => pong.colors())).size, bodies.length);
        const run = JSON.parse(readFileSync(`${log}/run.json`, "utf8"));
        assert.equal(await page.textContent("#name"), run.name);
        assert.deepEqual(await page.locator("#bodies .name").allTextContents(), run.bodies.map((body) => body.name));
    },

    async "at the start every body that moves is in the picture, wherever it goes"() {
        await page.selectOption("#side", "front");
        await page.selectOption("#side", "oblique");
        const { width, height } = await page.locator("#view").boundingBox();
        for (const frame of [0, busiest, frames.length - 1]) {
            await page.evaluate((frame) => pong.seekFrame(frame), frame);
            const [x, y] = await page.evaluate((name) => pong.projected(name), bodies[mover]);
            assert.ok(x > 0 && x < width && y > 0 && y < height, `${x} ${y} in frame ${frame}`);
        }
    },

    async "on a phone nothing sticks out at the side and the contacts can be reached"() {
        for (const [width, height] of [[390, 844], [844, 390]]) {
            await page.setViewportSize({ width, height });
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} × ${height}`);
            for (const id of ["#bodies li:last-child", "#more, #contacts tr:last-child"]) {
                const place = page.locator(id).last();
                await place.scrollIntoViewIfNeeded();
                const box = await place.boundingBox();
                assert.ok(box && box.y < height, `${id} at ${width} × ${height}`);
            }
        }
        await page.setViewportSize({ width: 1400, height: 860 });
    },

    async "every control has a name, and a thing that was drawn stays drawn in the light theme"() {
        const nameless = await page.evaluate(() =>
            [...document.querySelectorAll("button, input, select, canvas")]
                .filter((e) => !(e.getAttribute("aria-label") || e.labels?.[0]?.textContent || e.textContent.trim() || e.ariaHidden))
                .map((e) => e.outerHTML));
        assert.deepEqual(nameless, []);
        await page.keyboard.press("t");
        assert.ok(drawn(await pixels(page)).count > 500);
        await page.keyboard.press("t");
    },
};

console.log(`  ${file}: ready after ${seconds.toFixed(1)} s`);
let failed = 0;
for (const [name, check] of Object.entries(checks)) {
    const fault = await check().then(() => null, (error) => error);
    console.log(`  ${fault ? "FAILED" : "ok"}  ${name}${fault ? `\n${fault.stack}` : ""}`);
    failed += fault ? 1 : 0;
}
if (picture) {
    await page.evaluate((frame) => { pong.seekFrame(frame); pong.select(null); document.activeElement.blur(); }, busiest);
    await page.waitForTimeout(500);
    writeFileSync(picture, await page.screenshot());
}
if (complaints.length) console.log(complaints.join("\n"));
await browser.close();
process.exit(failed || complaints.length ? 1 : 0);
