// Plotted quantities of a body over time.

/** Force, moment and depth of a body in every frame; computed once. */
export class Series {
    #cache = new Map();
    #depths;

    constructor(run) {
        this.run = run;
    }

    /** `{ force, moment, depth }`, each `{ components, size, peak }`. */
    of(body) {
        if (!this.#cache.has(body)) this.#cache.set(body, this.#build(body));
        return this.#cache.get(body);
    }

    #build(body) {
        const { frames } = this.run;
        return {
            force: { ...this.#vector(frames.force, body), peak: this.#peak(body, 0) },
            moment: { ...this.#vector(frames.moment, body), peak: this.#peak(body, 1) },
            depth: { components: [], size: this.#depth(body), peak: this.#peak(body, 2) },
        };
    }

    #vector(column, body) {
        const { frameCount: count, bodies } = this.run;
        const components = [0, 1, 2].map(() => new Float32Array(count));
        const size = new Float32Array(count);
        for (let frame = 0; frame < count; frame++) {
            const at = 3 * (frame * bodies.length + body);
            for (let axis = 0; axis < 3; axis++) components[axis][frame] = column[at + axis];
            size[frame] = Math.hypot(column[at], column[at + 1], column[at + 2]);
        }
        return { components, size };
    }

    // For frames left out of the page the largest value is known.
    #peak(body, which) {
        const { peaks } = this.run.frames;
        if (!peaks) return null;
        const { frameCount: count, bodies } = this.run;
        return Float32Array.from({ length: count }, (_, frame) => peaks[3 * (frame * bodies.length + body) + which]);
    }

    #depth(body) {
        this.#depths ??= this.#allDepths();
        return this.#depths[body];
    }

    #allDepths() {
        const { run } = this, { contacts, frameCount: count } = run;
        const depths = run.bodies.map(() => new Float32Array(count));
        for (let frame = 0; frame < count; frame++) {
            const [from, to] = run.contactsOf(frame);
            for (let row = from; row < to; row++) {
                for (const primitive of [contacts.primitive_a[row], contacts.primitive_b[row]]) {
                    const depth = depths[run.about.primitives[primitive][0]];
                    depth[frame] = Math.max(depth[frame], contacts.depth[row]);
                }
            }
        }
        return depths;
    }
}
