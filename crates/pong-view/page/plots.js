// Force, moment and depth of a body over time, under one axis. A click or a drag shows that time.

import { AXES, styleColor } from "#view/theme.js";
import { decimalsFor, digits, niceStep, scaleFor } from "#view/units.js";

const PANES = [
    { name: "force", title: "Force", unit: "N" },
    { name: "moment", title: "Moment", unit: "N·m" },
    { name: "depth", title: "Depth", unit: "m" },
];
const LEFT = 64, RIGHT = 22, TOP = 20, GAP = 20, BOTTOM = 20;
const ZOOM = 1.25;

export class Plots {
    constructor(canvas, run, series, player) {
        Object.assign(this, { canvas, run, series, player, body: 0, hasComponents: true });
        this.window = [run.start, run.end];
        this.picture = document.createElement("canvas");
        this.isStale = true;
        this.width = 1;
        new ResizeObserver(() => this.refresh()).observe(canvas.parentElement);
        this.#listen();
    }

    setBody(body) {
        this.body = body;
        this.refresh();
    }

    refresh() {
        this.isStale = true;
        this.draw();
    }

    #listen() {
        const { canvas, player } = this;
        const seek = (event) => player.seekFrame(this.run.nearestFrame(this.#timeAt(event.offsetX)));
        canvas.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            canvas.setPointerCapture(event.pointerId);
            player.pause();
            seek(event);
        });
        canvas.addEventListener("pointermove", (event) => {
            if (event.buttons & 1) seek(event);
        });
        canvas.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.#zoom(this.#timeAt(event.offsetX), event.deltaY < 0 ? 1 / ZOOM : ZOOM);
        }, { passive: false });
        canvas.addEventListener("dblclick", () => this.showAll());
    }

    showAll() {
        this.window = [this.run.start, this.run.end];
        this.refresh();
    }

    #zoom(time, factor) {
        const [from, to] = this.window, { start, end } = this.run;
        const least = (end - start) / Math.max(1, this.run.frameCount - 1) * 4;
        if (factor < 1 && (to - from) * factor < least) return;
        const window = [time - (time - from) * factor, time + (to - time) * factor];
        this.window = [Math.max(start, window[0]), Math.min(end, window[1])];
        this.refresh();
    }

    #timeAt(x) {
        const [from, to] = this.window;
        return from + ((x - LEFT) / this.width) * (to - from);
    }

    #x(time) {
        const [from, to] = this.window;
        return LEFT + (to > from ? (time - from) / (to - from) : 0) * this.width;
    }

    /** Horizontal position of a time, px from the left of the plots. */
    xOf(time) {
        return this.#x(time);
    }

    /** Draws the curves if they have changed, and the line at the moment that is shown. */
    draw() {
        const { canvas, picture } = this, ratio = Math.min(devicePixelRatio, 2);
        const { clientWidth: width, clientHeight: height } = canvas;
        if (width < LEFT + RIGHT + 1 || height < 40) return;
        // Size of the curves, kept because reading it while drawing thousands of points would be slow.
        this.width = width - LEFT - RIGHT;
        const wide = Math.round(width * ratio), high = Math.round(height * ratio);
        if (canvas.width !== wide || canvas.height !== high) {
            Object.assign(canvas, { width: wide, height: high });
            this.isStale = true;
        }
        if (this.isStale) {
            Object.assign(picture, { width: wide, height: high });
            // Software rendering draws curves of thousands of points in milliseconds; a graphics card does not.
            const context = picture.getContext("2d", { willReadFrequently: true });
            context.scale(ratio, ratio);
            this.#drawAll(context, width, height);
            this.isStale = false;
        }
        const context = canvas.getContext("2d");
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.clearRect(0, 0, wide, high);
        context.drawImage(picture, 0, 0);
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        this.#drawMoment(context);
    }

    #drawAll(context, width, height) {
        const paneHeight = (height - TOP - BOTTOM - GAP * (PANES.length - 1)) / PANES.length;
        context.font = "11px system-ui, sans-serif";
        this.#drawTimes(context, width, height);
        const series = this.series.of(this.body);
        this.panes = PANES.map((pane, index) => {
            const top = TOP + index * (paneHeight + GAP);
            return this.#drawPane(context, pane, series[pane.name], top, paneHeight);
        });
    }

    #drawTimes(context, width, height) {
        const [from, to] = this.window;
        const step = niceStep(to - from || 1, width / 110);
        const decimals = this.run.isByTime ? decimalsFor(step) : 0;
        context.strokeStyle = styleColor("--grid");
        context.fillStyle = styleColor("--quiet");
        context.textAlign = "center";
        context.lineWidth = 1;
        for (let k = Math.ceil(from / step); k * step <= to; k++) {
            const x = Math.round(this.#x(k * step)) + 0.5;
            line(context, x, TOP, x, height - BOTTOM);
            context.fillText((k * step).toFixed(decimals) + (this.run.isByTime ? " s" : ""), x, height - 6);
        }
    }

    #drawPane(context, { title, unit }, { components, size, peak }, top, height) {
        const shown = this.hasComponents ? components : [];
        const [low, high] = this.#range([...shown, size, ...(peak ? [peak] : [])]);
        const scale = scaleFor(Math.max(Math.abs(low), Math.abs(high)), unit);
        const y = (value) => top + height - ((value - low) / (high - low)) * height;
        this.#drawValues(context, scale, low, high, y, height);
        context.save();
        context.beginPath();
        context.rect(LEFT, top - 1, this.width, height + 2);
        context.clip();
        shown.forEach((values, axis) => this.#curve(context, values, y, AXES[axis], 1));
        if (peak) this.#curve(context, peak, y, styleColor("--quiet"), 1);
        this.#curve(context, size, y, styleColor("--curve"), 1.6);
        context.restore();
        caption(context, `${title}, ${scale.unit}`, LEFT, top - 6, "left");
        return { top, height, scale };
    }

    #drawValues(context, scale, low, high, y, height) {
        const span = (high - low) / scale.factor, labels = Math.max(3, height / 15);
        // Of few labels only one may fall inside: then use twice as many.
        const isSparse = (step) => Math.floor(high / scale.factor / step) + Math.floor(-low / scale.factor / step) < 1;
        const few = niceStep(span, labels);
        const step = (isSparse(few) ? niceStep(span, 2 * labels) : few) * scale.factor;
        context.fillStyle = styleColor("--quiet");
        context.strokeStyle = styleColor("--grid");
        context.textAlign = "right";
        for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9) + 1e-300; k++) {
            const at = Math.round(y(k * step)) + 0.5;
            line(context, LEFT, at, LEFT + this.width, at);
            const text = ((k * step) / scale.factor).toFixed(decimalsFor(step / scale.factor));
            context.fillText(text.replace("-", "−"), LEFT - 7, at + 4);
        }
    }

    #range(all) {
        const [first, last] = this.window.map((time) => this.run.frameAt(time));
        let low = 0, high = 0;
        for (const values of all) {
            for (let frame = first; frame <= last; frame++) {
                if (values[frame] < low) low = values[frame];
                if (values[frame] > high) high = values[frame];
            }
        }
        if (low === high) return [0, 1];
        return [low < 0 ? low * 1.08 : 0, high > 0 ? high * 1.08 : 0];
    }

    // Where several frames fall on one column of pixels, their least and largest value are drawn.
    #curve(context, values, y, color, width) {
        const { run } = this;
        const first = Math.max(0, run.frameAt(this.window[0]) - 1);
        const last = Math.min(run.frameCount - 1, run.frameAt(this.window[1]) + 1);
        context.strokeStyle = color;
        context.lineWidth = width;
        context.beginPath();
        let column = NaN, low = 0, high = 0, end = 0;
        const flush = () => {
            if (Number.isNaN(column)) return;
            if (low < high) {
                context.lineTo(column, y(low));
                context.lineTo(column, y(high));
            }
            context.lineTo(column, y(end));
        };
        for (let frame = first; frame <= last; frame++) {
            const value = values[frame], x = Math.round(this.#x(run.times[frame]) * 2) / 2;
            if (x !== column) {
                flush();
                column = x;
                low = high = value;
                context.lineTo(x, y(value));
            }
            low = Math.min(low, value);
            high = Math.max(high, value);
            end = value;
        }
        flush();
        context.stroke();
    }

    #drawMoment(context) {
        const { player, run } = this;
        const x = Math.round(this.#x(player.time)) + 0.5;
        if (x >= LEFT - 1 && x <= LEFT + this.width + 1) {
            context.strokeStyle = styleColor("--accent");
            context.lineWidth = 1;
            for (const pane of this.panes) line(context, x, pane.top, x, pane.top + pane.height);
        }
        const series = this.series.of(this.body);
        PANES.forEach(({ name }, index) => {
            const { top, scale } = this.panes[index];
            const value = digits(series[name].size[player.frame] / scale.factor);
            const text = name === "depth" ? value : `|${name === "force" ? "F" : "M"}| ${value}`;
            caption(context, `${text} ${scale.unit}`, LEFT + this.width, top - 6, "right");
        });
        const spoken = PANES.map(({ name, title, unit }) => `${title} ${digits(series[name].size[player.frame])} ${unit}`);
        this.canvas.setAttribute("aria-label", `${run.bodies[this.body].name} over time. Now: ${spoken.join(", ")}`);
    }
}

function line(context, x0, y0, x1, y1) {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
}

// Above the plot area.
function caption(context, text, x, y, align) {
    context.font = "600 11px system-ui, sans-serif";
    context.textAlign = align;
    context.fillStyle = styleColor("--text");
    context.fillText(text, x, y);
    context.font = "11px system-ui, sans-serif";
}
