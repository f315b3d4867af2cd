// The run as the page holds it: a description in JSON, and columns of numbers packed as text.

const ARRAYS = { f64: Float64Array, f32: Float32Array, u32: Uint32Array, u8: Uint8Array };

/** Bits 29 to 31 of the `end` of cells (docs/c_api.md). */
const CELL_OF_B = 4, CELL_OF_A = 5;

async function unpacked(text) {
    const letters = atob(text);
    const bytes = new Uint8Array(letters.length);
    for (let i = 0; i < bytes.length; i++) bytes[i] = letters.charCodeAt(i);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A column is stored as the first bytes of all its numbers, then the second ones, and so on.
function column(bytes, { type, offset, length }) {
    const numbers = new ARRAYS[type](length);
    const out = new Uint8Array(numbers.buffer);
    const width = numbers.BYTES_PER_ELEMENT;
    for (let place = 0; place < width; place++) {
        const from = offset + place * length;
        for (let i = 0; i < length; i++) out[i * width + place] = bytes[from + i];
    }
    return numbers;
}

function columns(bytes, described) {
    const isColumn = (value) => value !== null && typeof value === "object" && "offset" in value;
    return Object.fromEntries(
        Object.entries(described).map(([name, value]) => [name, isColumn(value) ? column(bytes, value) : value]),
    );
}

/** Reads the run out of the document. */
export async function load() {
    const about = JSON.parse(document.getElementById("run").textContent);
    const element = document.getElementById("data");
    const bytes = await unpacked(element.textContent.trim());
    element.remove();
    return new Run(about, bytes);
}

/** A run. Positions are relative to the origin of their frame; `absolute` adds it. */
export class Run {
    constructor(about, bytes) {
        this.about = about;
        this.bodies = about.bodies;
        this.shapes = about.shapes.map((shape) => columns(bytes, shape));
        this.frames = columns(bytes, about.frames);
        this.contacts = columns(bytes, about.contacts);
        this.origin = column(bytes, about.origin);
        this.frameCount = this.frames.time.length;
        this.isByTime = about.axis === "time";
        this.times = this.isByTime ? this.frames.time : Float64Array.from(this.frames.time, (_, index) => index);
        this.#shortenNames();
    }

    get start() {
        return this.times[0];
    }

    get end() {
        return this.times[this.frameCount - 1];
    }

    /** The last frame that is not later than a time. */
    frameAt(time) {
        let low = 0, high = this.frameCount - 1;
        while (low < high) {
            const middle = (low + high + 1) >> 1;
            if (this.times[middle] <= time) low = middle;
            else high = middle - 1;
        }
        return low;
    }

    /** The frame whose time is nearest. */
    nearestFrame(time) {
        const frame = this.frameAt(time);
        const next = Math.min(frame + 1, this.frameCount - 1);
        return this.times[next] - time < time - this.times[frame] ? next : frame;
    }

    /** True if frames of the log are missing after a frame, beyond those left out by thinning. */
    isGapAfter(frame) {
        const { number } = this.frames;
        return number[frame + 1] - number[frame] > this.about.every;
    }

    /** Rows of the contacts of a frame: from, to (exclusive). */
    contactsOf(frame) {
        return [this.frames.first_contact[frame], this.frames.first_contact[frame + 1]];
    }

    /** True for the row of a cell of solids, whose weight is an area, m². */
    isCell(row) {
        const part = this.contacts.end[row] >>> 29;
        return part === CELL_OF_B || part === CELL_OF_A;
    }

    /** True for one of the two rows with the friction of solids, or with rolling or spinning resistance. */
    isFriction(row) {
        const part = this.contacts.end[row] >>> 29;
        return part !== 0 && !this.isCell(row);
    }

    contactCount(frame) {
        return this.frames.first_contact[frame + 1] - this.frames.first_contact[frame];
    }

    /** Body and part of a primitive. */
    primitive(index) {
        const [body, part] = this.about.primitives[index];
        return { body, part, info: this.shapes[this.bodies[body].shape].parts[part] };
    }

    /** The frame's origin in the common frame, m. */
    originOf(frame) {
        const at = this.origin.length > 3 ? 3 * frame : 0;
        return [this.origin[at], this.origin[at + 1], this.origin[at + 2]];
    }

    /** Position of a body in the common frame, m. */
    absolute(frame, body) {
        const at = 3 * (frame * this.bodies.length + body);
        return this.originOf(frame).map((origin, axis) => origin + this.frames.position[at + axis]);
    }

    /** Name of a primitive below its body: the body's own path in front is left out. */
    partName(index) {
        return this.names[index];
    }

    #shortenNames() {
        this.names = this.about.primitives.map(([body, part]) => {
            const { path } = this.shapes[this.bodies[body].shape].parts[part];
            const below = path.split("/");
            const depth = this.#depth(body);
            return below.slice(Math.min(depth, below.length - 1)).join("/");
        });
    }

    // Names in the body's path: the root's name, and those behind the object's name.
    #depth(body) {
        const object = this.about.objects[this.bodies[body].object];
        const behind = this.bodies[body].name.slice(object.length).split("/").filter(Boolean);
        return 1 + behind.length;
    }
}
