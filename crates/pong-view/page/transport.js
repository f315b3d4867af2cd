// The bar below: play, step, scrub, speed, time.

import { styleColor } from "#view/theme.js";
import { count, decimalsFor } from "#view/units.js";

/** Duration at speed 1, s, below which a run starts slowed down. */
const COMFORTABLE = 8;
const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];

const byId = (id) => document.getElementById(id);

export class Transport {
    constructor(run, player) {
        Object.assign(this, { run, player });
        this.scrubber = byId("scrubber");
        this.strip = byId("strip");
        this.decimals = run.isByTime ? Math.max(3, decimalsFor((run.end - run.start) / Math.max(1, run.frameCount - 1))) : 0;
        Object.assign(this.scrubber, { min: 0, max: run.frameCount - 1, step: 1, value: 0 });
        this.#speeds();
        this.#listen();
        new ResizeObserver(() => this.drawStrip()).observe(this.strip);
    }

    #speeds() {
        const select = byId("speed");
        const label = (speed) => (speed === 1 ? "1× real time" : `${speed}×`);
        select.replaceChildren(...SPEEDS.map((speed) => new Option(this.run.isByTime ? label(speed) : `${speed * 100} frames/s`, speed)));
        const wanted = this.run.isByTime ? (this.run.end - this.run.start) / COMFORTABLE : 0.2;
        const speed = SPEEDS.findLast((speed) => speed <= Math.min(1, wanted * 1.3)) ?? SPEEDS[0];
        this.#setSpeed(speed);
        select.addEventListener("change", () => this.#setSpeed(Number(select.value)));
    }

    #setSpeed(speed) {
        byId("speed").value = speed;
        this.player.setSpeed(this.run.isByTime ? speed : speed * 100);
    }

    /** Next speed up or down the list. */
    changeSpeed(steps) {
        const select = byId("speed");
        const index = Math.min(Math.max(select.selectedIndex + steps, 0), SPEEDS.length - 1);
        this.#setSpeed(SPEEDS[index]);
    }

    realTime() {
        this.#setSpeed(1);
    }

    #listen() {
        const { player, scrubber, run } = this;
        // The scrubber stops at frames, so that what is shown was computed.
        scrubber.addEventListener("input", () => {
            player.pause();
            player.seekFrame(Number(scrubber.value));
        });
        const actions = {
            play: () => player.toggle(),
            back: () => player.step(-1),
            on: () => player.step(1),
            first: () => player.seekFrame(0),
            last: () => player.seekFrame(run.frameCount - 1),
            before: () => player.stepToChange(-1),
            after: () => player.stepToChange(1),
        };
        for (const [id, action] of Object.entries(actions)) byId(id).addEventListener("click", action);
        byId("loop").addEventListener("change", (event) => (player.isLooping = event.target.checked));
        player.addEventListener("manner", () => this.showManner());
    }

    showManner() {
        const { isPlaying } = this.player;
        const button = byId("play");
        button.dataset.playing = isPlaying;
        button.setAttribute("aria-label", isPlaying ? "Pause" : "Play");
    }

    showMoment() {
        const { player, run, scrubber } = this;
        if (Number(scrubber.value) !== player.frame) scrubber.value = player.frame;
        const time = run.isByTime ? `${player.time.toFixed(this.decimals)} s` : `frame ${player.frame}`;
        scrubber.setAttribute("aria-valuetext", `${time}, frame ${run.frames.number[player.frame]}`);
        byId("time").textContent = time;
        byId("frame").textContent = `frame ${count(run.frames.number[player.frame])}`;
    }

    /** The number of contacts over the run, above the scrubber. */
    drawStrip() {
        const { strip, run } = this, ratio = Math.min(devicePixelRatio, 2);
        const width = Math.round(strip.clientWidth * ratio), height = Math.round(strip.clientHeight * ratio);
        if (width < 2) return;
        Object.assign(strip, { width, height });
        const context = strip.getContext("2d");
        const columns = new Float64Array(width);
        let most = 0;
        for (let frame = 0; frame < run.frameCount; frame++) {
            const column = Math.round((frame / Math.max(1, run.frameCount - 1)) * (width - 1));
            columns[column] = Math.max(columns[column], run.contactCount(frame));
            most = Math.max(most, columns[column]);
        }
        // Few frames leave columns without one: each frame holds until the next.
        const wide = Math.ceil(width / Math.max(1, run.frameCount - 1));
        context.fillStyle = styleColor("--strip");
        columns.forEach((contacts, x) => {
            if (contacts) context.fillRect(x, height * (1 - contacts / most), wide, height);
        });
        strip.title = `Contacts over the run, at most ${most}`;
    }
}
